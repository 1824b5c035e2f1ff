#include "tests/oracle/occt_summary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include <BRepBndLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Surface.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>

#include "tests/oracle/occt_flux.h"

namespace trimloop::test {
namespace {

std::string text_of(Point p) {
  const auto tidy = [](double x) { return std::abs(x) < 1e-6 ? 0.0 : x; };
  return fmt::format("({:.6g} {:.6g} {:.6g})", tidy(p.x), tidy(p.y), tidy(p.z));
}

TopoDS_Shape read_shape(const std::filesystem::path& path) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw Standard_Failure();
  reader.TransferRoots();
  return reader.OneShape();
}

Summary summary_of(const TopoDS_Shape& shape) {
  Summary s;
  if (shape.IsNull()) return s;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    const TopoDS_Face& face = TopoDS::Face(e.Current());
    ++s.faces;
    s.area += face_flux(face).area;
    if (s.has_middle) continue;
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const gp_Pnt p = BRep_Tool::Surface(face)->Value(0.5 * (u0 + u1), 0.5 * (v0 + v1));
    s.middle = {p.X(), p.Y(), p.Z()};
    s.has_middle = true;
  }
  for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next()) ++s.curves, s.length += edge_length(TopoDS::Edge(e.Current()));
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  if (box.IsVoid()) return s;
  box.SetGap(0);
  box.Get(s.box.lo.x, s.box.lo.y, s.box.lo.z, s.box.hi.x, s.box.hi.y, s.box.hi.z);
  return s;
}

std::string in_a_process_of_its_own(const std::function<std::string()>& ask) {
  constexpr unsigned patience_s = 20;
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child < 0) return "no process";
  if (child == 0) {
    for (const int s : {SIGSEGV, SIGFPE, SIGABRT, SIGALRM}) signal(s, SIG_DFL);  // Boost.Test's would report the crash as ours
    alarm(patience_s);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    std::string answer = "refused";
    try {
      answer = ask();
    } catch (const Standard_Failure&) {
    }
    _exit(write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string answer;
  char part[512];
  for (ssize_t n = 0; (n = read(ends[0], part, sizeof part)) > 0;) answer.append(part, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? "no end" : "crash";
  return answer;
}

}  // namespace

std::string text_of(const Summary& s, bool with_middle) {
  std::string out;
  const auto also = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  const auto number_of = [](int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
  if (s.failed) also(number_of(s.failed, "failed face"));
  if (s.faces > s.failed) also(number_of(s.faces - s.failed, "face") + (with_middle ? "" : fmt::format(", area {:.6g}", s.area)));
  if (s.curves) also(number_of(s.curves, "curve"));
  if (s.unbounded) also("without end");
  if (s.curves && !s.unbounded) also(fmt::format("length {:.6g}", s.length));
  if (with_middle && s.has_middle) {
    also("middle " + text_of(s.middle));
  } else if (!s.box.empty()) {
    also(text_of(s.box.lo) + " to " + text_of(s.box.hi));
  }
  return out.empty() ? "nothing" : out;
}

std::string occt_summary(const std::filesystem::path& path, bool with_middle) {
  return in_a_process_of_its_own([&] { return text_of(summary_of(read_shape(path)), with_middle); });
}

std::string occt_rewritten_point(const std::filesystem::path& path) {
  return in_a_process_of_its_own([&]() -> std::string {
    const std::filesystem::path out = std::filesystem::temp_directory_path() / fmt::format("trimloop_occt_{}.igs", getpid());
    IGESControl_Writer writer;
    writer.AddShape(read_shape(path));
    writer.ComputeModel();
    const bool written = writer.Write(out.c_str());
    std::ifstream in(out);
    std::string answer = "nothing";
    for (std::string line; std::getline(in, line);)
      if (line.rfind("116,", 0) == 0) answer = line.substr(4, line.find(',', 4) - 4);
    std::filesystem::remove(out);
    return written ? answer : "nothing";
  });
}

}  // namespace trimloop::test
