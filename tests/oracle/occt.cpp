#include "tests/oracle/occt.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Reader.hxx>
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

bool examine(const char* path, bool with_box, OcctReading& out) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  IGESControl_Reader reader;
  if (reader.ReadFile(path) != IFSelect_RetDone) return false;
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) return true;  // read, and nothing in it
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) ++out.faces;
  GProp_GProps plain, adaptive;
  BRepGProp::SurfaceProperties(shape, plain);
  BRepGProp::SurfaceProperties(shape, adaptive, with_box ? 1e-10 : 1e-7);
  out.area_plain = plain.Mass();
  out.area = adaptive.Mass();
  if (!with_box) return true;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    const FaceFlux flux = face_flux(TopoDS::Face(e.Current()));
    out.area_fine = flux.measured && out.area_fine >= 0 ? out.area_fine + flux.area : -1;
  }
  for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next()) out.length += edge_length(TopoDS::Edge(e.Current()));
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  if (box.IsVoid()) return true;
  box.SetGap(0);
  box.Get(out.lo.x, out.lo.y, out.lo.z, out.hi.x, out.hi.y, out.hi.z);
  out.has_box = true;
  return true;
}

}  // namespace

std::optional<OcctReading> read_with_occt(const std::filesystem::path& path, bool with_box, unsigned patience_s) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    signal(SIGSEGV, SIG_DFL);  // Boost.Test's handlers would report the crash as ours
    signal(SIGFPE, SIG_DFL);
    signal(SIGABRT, SIG_DFL);
    signal(SIGALRM, SIG_DFL);
    alarm(patience_s);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    OcctReading reading;
    bool done = false;
    try {
      done = examine(path.c_str(), with_box, reading);
    } catch (const Standard_Failure&) {
    }
    if (done && write(ends[1], &reading, sizeof reading) != sizeof reading) _exit(1);
    _exit(done ? 0 : 1);
  }
  close(ends[1]);
  OcctReading reading;
  std::size_t got = 0;
  while (got < sizeof reading) {
    const ssize_t n = read(ends[0], reinterpret_cast<char*>(&reading) + got, sizeof reading - got);
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (got != sizeof reading) return std::nullopt;
  return reading;
}

}  // namespace trimloop::test
