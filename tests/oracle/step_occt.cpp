#include "tests/oracle/step_occt.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DimTolTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include "tests/oracle/occt_flux.h"

namespace trimloop::test {
namespace {

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void put(std::string& out, const std::string& text) {
  put(out, text.size());
  out += text;
}
template <class T>
void take(std::string_view& in, T& value) {
  if (in.size() < sizeof value) return;
  std::memcpy(&value, in.data(), sizeof value);
  in.remove_prefix(sizeof value);
}
void take(std::string_view& in, std::string& text) {
  std::size_t size = 0;
  take(in, size);
  size = std::min(size, in.size());
  text = in.substr(0, size);
  in.remove_prefix(size);
}

std::string encode(const OcctStep& r) {
  std::string out;
  put(out, r.faces.size());
  for (const OcctFace& f : r.faces) {
    put(out, f.area), put(out, f.error), put(out, f.area_plain), put(out, f.name), put(out, f.has_colour), put(out, f.colour);
  }
  put(out, r.volumes.size());
  for (const double v : r.volumes) put(out, v);
  put(out, r.length);
  put(out, r.tree.size());
  for (const OcctOccurrence& o : r.tree) put(out, o.path), put(out, o.lo), put(out, o.hi), put(out, o.has_box);
  put(out, r.pmi);
  return out + "whole";
}

std::optional<OcctStep> decode(std::string_view in) {
  if (in.size() < 5 || in.substr(in.size() - 5) != "whole") return std::nullopt;
  OcctStep r;
  std::size_t n = 0;
  take(in, n);
  for (std::size_t i = 0; i < n; ++i) {
    OcctFace f;
    take(in, f.area), take(in, f.error), take(in, f.area_plain), take(in, f.name), take(in, f.has_colour), take(in, f.colour);
    r.faces.push_back(std::move(f));
  }
  take(in, n);
  for (std::size_t i = 0; i < n; ++i) take(in, r.volumes.emplace_back());
  take(in, r.length);
  take(in, n);
  for (std::size_t i = 0; i < n; ++i) {
    OcctOccurrence o;
    take(in, o.path), take(in, o.lo), take(in, o.hi), take(in, o.has_box);
    r.tree.push_back(std::move(o));
  }
  take(in, r.pmi);
  return r;
}

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  std::string out(static_cast<std::size_t>(name->Get().LengthOfCString()), '\0');
  Standard_PCharacter text = out.data();
  name->Get().ToUTF8CString(text);
  return out;
}

class Reader {
 public:
  Reader(const Handle(TDocStd_Document) & document, bool with_boxes, OcctStep& out)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())), with_boxes_(with_boxes), out_(out) {}

  void run() {
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    for (int i = 1; i <= roots.Length(); ++i) visit(roots.Value(i), TopLoc_Location(), "", 0);
  }

 private:
  void visit(const TDF_Label& label, const TopLoc_Location& at, const std::string& above, int depth) {
    if (depth > 64) return;
    TDF_Label definition = label;
    TopLoc_Location here = at;
    if (XCAFDoc_ShapeTool::IsReference(label)) {
      XCAFDoc_ShapeTool::GetReferredShape(label, definition);
      here = at * XCAFDoc_ShapeTool::GetLocation(label);
    }
    OcctOccurrence o;
    o.path = above.empty() ? name_of(definition) : above + "/" + name_of(definition);
    const std::string path = o.path;
    const std::size_t self = out_.tree.size();
    out_.tree.push_back(std::move(o));
    if (XCAFDoc_ShapeTool::IsAssembly(definition)) {
      TDF_LabelSequence children;
      XCAFDoc_ShapeTool::GetComponents(definition, children, false);
      for (int i = 1; i <= children.Length(); ++i) {
        const std::size_t child = out_.tree.size();
        visit(children.Value(i), here, path, depth + 1);
        if (child < out_.tree.size()) add_box(out_.tree[self], out_.tree[child]);
      }
      return;
    }
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(definition).Located(here, false);
    if (with_boxes_) measure_box(shape, out_.tree[self]);
    measure(definition, shape);
  }

  static void measure_box(const TopoDS_Shape& shape, OcctOccurrence& o) {
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, false, false);
    if (box.IsVoid()) return;
    box.SetGap(0);
    box.Get(o.lo.x, o.lo.y, o.lo.z, o.hi.x, o.hi.y, o.hi.z);
    o.has_box = true;
  }

  static void add_box(OcctOccurrence& to, const OcctOccurrence& part) {
    if (!part.has_box) return;
    Box both;
    if (to.has_box) both.add(to.lo), both.add(to.hi);
    both.add(part.lo), both.add(part.hi);
    to.lo = both.lo, to.hi = both.hi, to.has_box = true;
  }

  // A face's own colour, else that of the shell, the solid or the definition around it.
  std::optional<std::array<double, 3>> colour_of(const TopoDS_Shape& shape) {
    Quantity_Color colour;
    const TopoDS_Shape unplaced = shape.Located(TopLoc_Location(), false);
    if (!colours_->GetColor(unplaced, XCAFDoc_ColorSurf, colour) && !colours_->GetColor(unplaced, XCAFDoc_ColorGen, colour)) return std::nullopt;
    std::array<double, 3> out{};  // it keeps them linear; files hold sRGB
    colour.Values(out[0], out[1], out[2], Quantity_TOC_sRGB);
    return out;
  }

  void measure(const TDF_Label& definition, const TopoDS_Shape& shape) {
    const auto whole = colour_of(shape);
    for (TopExp_Explorer s(shape, TopAbs_SOLID); s.More(); s.Next()) {
      const auto solid = colour_of(s.Current());
      for (TopExp_Explorer h(s.Current(), TopAbs_SHELL); h.More(); h.Next()) {
        const auto shell = colour_of(h.Current());
        for (TopExp_Explorer f(h.Current(), TopAbs_FACE); f.More(); f.Next())
          measure_face(definition, TopoDS::Face(f.Current()), shell ? shell : solid ? solid : whole);
      }
    }
    for (TopExp_Explorer h(shape, TopAbs_SHELL, TopAbs_SOLID); h.More(); h.Next()) {
      const auto shell = colour_of(h.Current());
      for (TopExp_Explorer f(h.Current(), TopAbs_FACE); f.More(); f.Next())
        measure_face(definition, TopoDS::Face(f.Current()), shell ? shell : whole);
    }
    for (TopExp_Explorer f(shape, TopAbs_FACE, TopAbs_SHELL); f.More(); f.Next()) measure_face(definition, TopoDS::Face(f.Current()), whole);
    for (TopExp_Explorer e(shape, TopAbs_SOLID); e.More(); e.Next()) {
      double volume = 0;
      for (TopExp_Explorer f(e.Current(), TopAbs_FACE); f.More(); f.Next()) {
        volume += face_flux(TopoDS::Face(f.Current())).volume;
      }
      out_.volumes.push_back(volume);
    }
    for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next()) {
      out_.length += edge_length(TopoDS::Edge(e.Current()));
    }
  }

  void measure_face(const TDF_Label& definition, const TopoDS_Face& face, const std::optional<std::array<double, 3>>& around) {
    OcctFace f;
    GProp_GProps plain;
    BRepGProp::SurfaceProperties(face, plain);
    const FaceFlux flux = face_flux(face);
    f.area_plain = plain.Mass();
    f.area = flux.measured ? flux.area : plain.Mass();
    f.error = flux.measured ? flux.change * flux.area : 0;
    TDF_Label sub;
    // The face is a sub-shape of the definition or, in a compound, of one of its parts.
    const TopoDS_Shape unplaced = face.Located(TopLoc_Location(), false);
    if (shapes_->FindSubShape(definition, unplaced, sub) || shapes_->Search(unplaced, sub, false, false, true)) f.name = name_of(sub);
    const auto own = colour_of(face);
    if (const auto& shown = own ? own : around) {
      f.has_colour = true;
      f.colour = *shown;
    }
    out_.faces.push_back(f);
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colours_;
  bool with_boxes_;
  OcctStep& out_;
};

void count_pmi(const Handle(TDocStd_Document) & document, OcctStep& out) {
  const Handle(XCAFDoc_DimTolTool) tool = XCAFDoc_DocumentTool::DimTolTool(document->Main());
  TDF_LabelSequence labels[3];
  tool->GetDimensionLabels(labels[0]);
  tool->GetGeomToleranceLabels(labels[1]);
  tool->GetDatumLabels(labels[2]);
  for (std::size_t kind = 0; kind < 3; ++kind) {
    out.pmi[kind] = static_cast<std::size_t>(labels[kind].Length());
    for (int i = 1; i <= labels[kind].Length(); ++i) {
      TDF_LabelSequence first, second;
      if (!tool->GetRefShapeLabel(labels[kind].Value(i), first, second)) continue;
      out.pmi[3] += static_cast<std::size_t>(first.Length() + second.Length());
    }
  }
}

bool examine(const char* path, bool with_boxes, OcctStep& out) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader;
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  // Else it moves a shape by the placement that its representation lists among the items, which says no such thing.
  Interface_Static::SetIVal("read.step.root.transformation", 0);
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  if (reader.ReadFile(path) != IFSelect_RetDone) return false;
  if (!reader.Transfer(document)) return true;  // read, and nothing in it
  Reader(document, with_boxes, out).run();
  count_pmi(document, out);
  return true;
}

}  // namespace

double OcctStep::area() const {
  double sum = 0;
  for (const OcctFace& f : faces) sum += f.area;
  return sum;
}
double OcctStep::area_error() const {
  double sum = 0;
  for (const OcctFace& f : faces) sum += f.error;
  return sum;
}
double OcctStep::area_plain() const {
  double sum = 0;
  for (const OcctFace& f : faces) sum += f.area_plain;
  return sum;
}
double OcctStep::volume() const {
  double sum = 0;
  for (const double v : volumes) sum += v;
  return sum;
}

std::optional<OcctStep> read_step_with_occt(const std::filesystem::path& path, bool with_boxes, unsigned patience_s) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    for (const int signal_number : {SIGSEGV, SIGFPE, SIGABRT, SIGALRM, SIGXCPU}) signal(signal_number, SIG_DFL);
    // Processor time: on a busy machine the clock says little.
    const rlimit most{patience_s, patience_s + 1};
    setrlimit(RLIMIT_CPU, &most);
    alarm(20 * patience_s);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    OcctStep reading;
    bool done = false;
    try {
      done = examine(path.c_str(), with_boxes, reading);
    } catch (const Standard_Failure&) {
    }
    const std::string bytes = done ? encode(reading) : std::string();
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t n = write(ends[1], bytes.data() + sent, bytes.size() - sent);
      if (n <= 0) break;
      sent += static_cast<std::size_t>(n);
    }
    _exit(done ? 0 : 1);
  }
  close(ends[1]);
  std::string bytes;
  char buffer[65536];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;) bytes.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return decode(bytes);
}

}  // namespace trimloop::test
