// Time of reading and meshing, ours and OpenCASCADE's, alternating in one process; processor time, the least of some runs.
// A program of its own for tests/corpus/mesh_speed.py; it is not part of the tests.
//
// usage: mesh_peer FILE DEFLECTION_MM [ANGLE_DEG=28.65]   one line of JSON
//        mesh_peer --faces                               single NURBS faces; a line each

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include "io/io.h"
#include "kernel/mesh/tessellate.h"
#include "tests/bench/occt_surface.h"
#include "tests/bench/surfaces.h"
#include "tests/kernel/mesh/bodies.h"

using namespace trimloop;

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double timed(Work work) {
  const double start = processor_seconds();
  work();
  return processor_seconds() - start;
}

struct Times {
  double ours = infinity, theirs = infinity;
};

// Runs both in turn until a second has gone, at least twice and at most ten times.
template <class Ours, class Theirs>
Times alternate(Ours ours, Theirs theirs) {
  Times best;
  double spent = 0;
  for (int run = 0; run < 10 && (run < 2 || spent < 1); ++run) {
    const double a = timed(ours), b = timed(theirs);
    best.ours = std::min(best.ours, a), best.theirs = std::min(best.theirs, b);
    spent += a + b;
    if (spent > 20) break;
  }
  return best;
}

bool is_step(const std::string& path) {
  const std::string::size_type dot = path.rfind('.');
  return dot != std::string::npos && (path.compare(dot, 3, ".st") == 0 || path.compare(dot, 3, ".ST") == 0 || path.compare(dot, 3, ".p2") == 0);
}

TopoDS_Shape load(const std::string& path) {
  if (is_step(path)) {
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

void mesh_theirs(const TopoDS_Shape& shape, double deflection, double angle) {
  BRepTools::Clean(shape);
  BRepMesh_IncrementalMesh mesher(shape, deflection, Standard_False, angle, Standard_False);
}

int triangles(const TopoDS_Shape& shape) {
  int n = 0;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    TopLoc_Location where;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(TopoDS::Face(e.Current()), where);
    if (!mesh.IsNull()) n += mesh->NbTriangles();
  }
  return n;
}

struct OurMesh {
  std::size_t faces = 0, triangles = 0, not_met = 0, proven = 0;
};
OurMesh mesh_ours(const Model& model, const mesh::TessellationOptions& options) {
  OurMesh sum;
  for (const Part& part : model.parts)
    for (const Body& body : part.bodies) {
      const auto made = mesh::tessellate(body, options);
      if (!made) continue;
      sum.triangles += made->triangle_count();
      for (const mesh::FaceMesh& face : made->faces) {
        ++sum.faces;
        sum.not_met += !face.triangles.empty() && !face.deflection_met;
        sum.proven += face.bound_kind == mesh::BoundKind::Proven;
      }
    }
  return sum;
}

int of_file(const std::string& path, const mesh::TessellationOptions& options) {
  Model model;
  TopoDS_Shape shape;
  const Times read = alternate([&] { model = io::read(path.c_str()).model; }, [&] { shape = load(path); });
  if (shape.IsNull()) return 1;
  OurMesh ours;
  const Times mesh = alternate([&] { ours = mesh_ours(model, options); },
                               [&] { mesh_theirs(shape, options.deflection_mm, options.angle_rad); });
  std::printf("{\"faces\":%zu,\"triangles\":%zu,\"not_met\":%zu,\"proven\":%zu,\"mesh_s\":%.6f,\"read_s\":%.6f,\"occt_triangles\":%d,"
              "\"occt_mesh_s\":%.6f,\"occt_read_s\":%.6f}\n",
              ours.faces, ours.triangles, ours.not_met, ours.proven, mesh.ours, read.ours, triangles(shape), mesh.theirs, read.theirs);
  return 0;
}

// Largest distance of a fine grid of the surface from the mesh's triangles in the parameter plane, by the flat triangle there.
template <class Vertex>
double measured(const NurbsSurface& s, std::size_t count, Vertex vertex) {
  constexpr int n = 8;
  double worst = 0;
  for (std::size_t t = 0; t < count; ++t) {
    Uv uv[3];
    Point p[3];
    for (int i = 0; i < 3; ++i) vertex(t, i, uv[i], p[i]);
    const Vector normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const double a = i / double{n}, b = j / double{n};
        worst = std::max(worst, std::abs(dot(evaluate(s, a * uv[0] + b * uv[1] + (1 - a - b) * uv[2]) - p[0], normal)));
      }
  }
  return worst;
}

int of_face(const char* name, const NurbsSurface& surface, double deflection, double angle) {
  const Body body = test::patch({surface}, surface.range_u(), surface.range_v());
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(bench::to_occt(surface), 1e-7).Shape();
  const mesh::TessellationOptions options{.deflection_mm = deflection, .angle_rad = angle};
  mesh::BodyMesh mine;
  const Times time = alternate([&] { mine = *mesh::tessellate(body, options); }, [&] { mesh_theirs(face, deflection, angle); });
  const mesh::FaceMesh& m = mine.faces[0];
  const double ours = measured(surface, m.triangles.size(), [&](std::size_t t, int i, Uv& uv, Point& p) {
    const mesh::FaceVertex& v = m.vertices[m.triangles[t][static_cast<std::size_t>(i)]];
    uv = v.uv, p = mine.points[v.point];
  });
  TopLoc_Location where;
  const Handle(Poly_Triangulation) o = BRep_Tool::Triangulation(TopoDS::Face(face), where);
  const double theirs = measured(surface, static_cast<std::size_t>(o->NbTriangles()), [&](std::size_t t, int i, Uv& uv, Point& p) {
    const int node = o->Triangle(static_cast<int>(t) + 1).Value(i + 1);
    const gp_Pnt2d q = o->UVNode(node);
    const gp_Pnt x = o->Node(node);
    uv = {q.X(), q.Y()}, p = {x.X(), x.Y(), x.Z()};
  });
  std::printf("{\"face\":\"%s\",\"deflection\":%g,\"triangles\":%zu,\"met\":%s,\"worst\":%.4f,\"mesh_s\":%.6f,\"occt_triangles\":%d,"
              "\"occt_worst\":%.4f,\"occt_mesh_s\":%.6f}\n",
              name, deflection, m.triangles.size(), m.deflection_met ? "true" : "false", ours / deflection, time.ours,
              o->NbTriangles(), theirs / deflection, time.theirs);
  std::fflush(stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("usage: mesh_peer FILE DEFLECTION_MM [ANGLE_DEG] | --faces\n", stderr), 2;
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    if (argc > 2) {
      mesh::TessellationOptions options;
      options.deflection_mm = std::atof(argv[2]);
      options.angle_rad = (argc > 3 ? std::atof(argv[3]) : 0.5 * 180 / pi) * pi / 180;
      return of_file(argv[1], options);
    }
    int bad = 0;
    bad += of_face("wavy 40x40", bench::wavy(40, 4, 1), 0.002, 0.5);
    bad += of_face("wavy 100x100", bench::wavy(100, 4, 2), 0.005, 0.5);
    bad += of_face("ball", test::nurbs_torus(0, 10, true), 0.001, 0.5);
    bad += of_face("torus 10/3", test::nurbs_torus(10, 3), 0.001, 0.5);
    bad += of_face("thin torus 100/1", test::nurbs_torus(100, 1), 0.1, 0.5);
    bad += of_face("thin torus 100/1, no angle", test::nurbs_torus(100, 1), 0.1, 3.1);
    bad += of_face("thin torus 100/1", test::nurbs_torus(100, 1), 0.01, 0.5);
    return bad != 0;
  } catch (const Standard_Failure&) {
    return 1;
  }
}
