// What OpenCASCADE's own sewing makes of a file: `sew_peer FILE TOLERANCE_MM`, one line of JSON. A program of its own for
// tests/corpus/sewing.py; it is not part of the tests, as OpenCASCADE needs minutes on some files.

#include <cstdio>
#include <cstdlib>
#include <string>

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Tool.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>

namespace {

TopoDS_Shape load(const std::string& path) {
  const bool step = path.size() > 3 && (path.rfind(".st") != std::string::npos || path.rfind(".STE") != std::string::npos ||
                                        path.rfind(".STP") != std::string::npos);
  if (step) {
    STEPControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return {};
    reader.TransferRoots();
    return reader.OneShape();
  }
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return {};
  reader.TransferRoots();
  return reader.OneShape();
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  int n = 0;
  for (TopExp_Explorer e(shape, kind); e.More(); e.Next()) ++n;
  return n;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: sew_peer FILE TOLERANCE_MM\n", stderr), 2;
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    const TopoDS_Shape shape = load(argv[1]);
    if (shape.IsNull()) return 1;
    BRepBuilderAPI_Sewing sewing(std::atof(argv[2]));
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) sewing.Add(e.Current());
    sewing.Perform();
    const TopoDS_Shape sewn = sewing.SewedShape();
    int closed = 0, in_closed = 0;
    for (TopExp_Explorer e(sewn, TopAbs_SHELL); e.More(); e.Next())
      if (BRep_Tool::IsClosed(e.Current())) ++closed, in_closed += count(e.Current(), TopAbs_FACE);
    std::printf("{\"faces\":%d,\"shells\":%d,\"closed\":%d,\"faces_in_closed\":%d,\"free_edges\":%d,\"multiple_edges\":%d}\n",
                count(shape, TopAbs_FACE), count(sewn, TopAbs_SHELL), closed, in_closed, sewing.NbFreeEdges(),
                sewing.NbMultipleEdges());
  } catch (const Standard_Failure&) {
    return 1;
  }
  return 0;
}
