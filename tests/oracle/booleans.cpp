// Scores of this library and of OpenCASCADE on Booleans of random primitives, with times.
// Not a test: run build/dev/tests/oracle/score_booleans [pairs]; docs/results.md has its output.
//
// Each pair runs in a process of its own. An operation is right when the identities of the volumes hold to 1e-6: V(A or
// B) + V(A and B) = V(A) + V(B) and V(A - B) + V(A and B) = V(A).

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <array>
#include <cstdlib>
#include <ctime>
#include <gp_Ax3.hxx>
#include <gp_GTrsf.hxx>

#include "kernel/boolean/boolean.h"
#include "kernel/check/measure.h"
#include "tests/kernel/boolean/primitives.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

double processor_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Outcome {  // of union, intersection, difference
  std::array<bool, 3> done{};
  std::array<int, 3> faces{};
  std::array<double, 3> volume{}, ms{};
};

Outcome ours(const Primitive& p, const Primitive& q) {
  const Body a = *body_of(p), b = *body_of(q);
  Outcome out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double start = processor_ms();
    const auto r = combine(a, b, static_cast<BooleanOperation>(i));
    out.ms[i] = processor_ms() - start;
    out.done[i] = r.has_value();
    if (!r) continue;
    for (const Body& body : r->bodies) {
      out.faces[i] += static_cast<int>(body.faces.size());
      for (std::uint32_t s = 0; s < body.shells.size(); ++s) out.volume[i] += volume(body, ShellId{s}, 1e-10)->value;
    }
  }
  return out;
}

TopoDS_Shape occt(const Primitive& p) {
  const Frame& f = p.frame;
  const gp_Ax2 at(gp_Pnt(f.origin.x, f.origin.y, f.origin.z), gp_Dir(f.z.x, f.z.y, f.z.z), gp_Dir(f.x.x, f.x.y, f.x.z));
  switch (p.kind) {
    case PrimitiveKind::Block: return BRepPrimAPI_MakeBox(at, p.a, p.b, p.c).Shape();
    case PrimitiveKind::Cylinder: return BRepPrimAPI_MakeCylinder(at, p.a, p.b).Shape();
    case PrimitiveKind::Cone: return BRepPrimAPI_MakeCone(at, p.a, p.b, p.c).Shape();
    case PrimitiveKind::Sphere: return BRepPrimAPI_MakeSphere(at, p.a).Shape();
    case PrimitiveKind::Torus: return BRepPrimAPI_MakeTorus(at, p.a, p.b).Shape();
    default: break;
  }
  gp_GTrsf stretch;
  stretch.SetValue(1, 1, p.a), stretch.SetValue(2, 2, p.b), stretch.SetValue(3, 3, p.c);
  gp_Trsf place;
  place.SetTransformation(gp_Ax3(at), gp_Ax3());
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  return BRepBuilderAPI_Transform(BRepBuilderAPI_GTransform(ball, stretch, true).Shape(), place, true).Shape();
}

int faces_of(const TopoDS_Shape& s) {
  int n = 0;
  for (TopExp_Explorer e(s, TopAbs_FACE); e.More(); e.Next()) ++n;
  return n;
}
double volume_of(const TopoDS_Shape& s) {
  GProp_GProps props;
  BRepGProp::VolumeProperties(s, props, 1e-9);
  return props.Mass();
}

Outcome theirs(const Primitive& p, const Primitive& q) {
  const TopoDS_Shape a = occt(p), b = occt(q);
  Outcome out;
  for (std::size_t i = 0; i < 3; ++i) {
    try {
      const double start = processor_ms();
      TopoDS_Shape r;
      if (i == 0) r = BRepAlgoAPI_Fuse(a, b).Shape();
      if (i == 1) r = BRepAlgoAPI_Common(a, b).Shape();
      if (i == 2) r = BRepAlgoAPI_Cut(a, b).Shape();
      out.ms[i] = processor_ms() - start;
      out.done[i] = !r.IsNull();
      if (r.IsNull()) continue;
      out.faces[i] = faces_of(r);
      out.volume[i] = volume_of(r);
    } catch (const Standard_Failure&) {
      out.done[i] = false;
    }
  }
  return out;
}

// In a process of its own; nothing done when it crashes or takes longer than `patience_s`.
template <class Run>
Outcome apart(Run run, unsigned patience_s = 60) {
  int ends[2];
  Outcome out;
  if (pipe(ends) != 0) return out;
  const pid_t child = fork();
  if (child == 0) {
    alarm(patience_s);
    const Outcome found = run();
    if (write(ends[1], &found, sizeof found) != sizeof found) _exit(1);
    _exit(0);
  }
  close(ends[1]);
  Outcome found;
  if (read(ends[0], &found, sizeof found) == sizeof found) out = found;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return out;
}

bool is_right(const Outcome& o, double va, double vb) {
  if (!o.done[0] || !o.done[1] || !o.done[2]) return false;
  const double off = std::max(std::abs(o.volume[0] + o.volume[1] - va - vb), std::abs(o.volume[2] + o.volume[1] - va));
  return off <= 1e-6 * (va + vb);
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned pairs = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 200;
  int both = 0, only_ours = 0, only_theirs = 0, neither = 0, faces_differ = 0, volumes_differ = 0;
  double ms_ours = 0, ms_theirs = 0;
  for (unsigned seed = 0; seed < pairs; ++seed) {
    std::mt19937 bits(seed);
    const Primitive p = random_primitive(bits), q = random_primitive(bits);
    const double va = volume(*body_of(p), ShellId{0}, 1e-10)->value, vb = volume(*body_of(q), ShellId{0}, 1e-10)->value;
    const Outcome a = apart([&] { return ours(p, q); }), b = apart([&] { return theirs(p, q); });
    const bool right_a = is_right(a, va, vb), right_b = is_right(b, va, vb);
    ++(right_a && right_b ? both : right_a ? only_ours : right_b ? only_theirs : neither);
    if (!right_a || !right_b)
      fmt::print("pair {}: kinds {} {}; volumes ours {:.9g} {:.9g} {:.9g}, theirs {:.9g} {:.9g} {:.9g}; operands {:.9g} {:.9g}\n",
                 seed, static_cast<int>(p.kind), static_cast<int>(q.kind), a.volume[0], a.volume[1], a.volume[2], b.volume[0],
                 b.volume[1], b.volume[2], va, vb);
    if (right_a && right_b) {
      bool same_volume = true;
      for (std::size_t i = 0; i < 3; ++i) same_volume = same_volume && std::abs(a.volume[i] - b.volume[i]) <= 1e-6 * (va + vb);
      volumes_differ += !same_volume;
      faces_differ += a.faces != b.faces;
    }
    for (std::size_t i = 0; i < 3; ++i) ms_ours += a.ms[i], ms_theirs += b.ms[i];
  }
  fmt::print("{} pairs, union, intersection and difference of each\n", pairs);
  fmt::print("right (identities of the volumes to 1e-6): both {}, ours alone {}, OpenCASCADE alone {}, neither {}\n", both, only_ours,
             only_theirs, neither);
  fmt::print("of those right in both: {} differ in a volume, {} in the number of faces\n", volumes_differ, faces_differ);
  fmt::print("processor time: ours {:.0f} ms, OpenCASCADE {:.0f} ms, ratio {:.2f}\n", ms_ours, ms_theirs, ms_ours / ms_theirs);
}
