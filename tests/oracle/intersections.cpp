// Scores of this library and of OpenCASCADE on the intersection corpus (tests/kernel/intersect/corpus.h), with times.
// Not a test: run build/dev/tests/oracle/score_intersections; docs/results.md has its output.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <GCPnts_AbscissaPoint.hxx>
#include <Geom2dAPI_InterCurveCurve.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI.hxx>
#include <GeomAPI_ExtremaCurveCurve.hxx>
#include <GeomAPI_IntCS.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomInt_IntSS.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <numeric>

#include "kernel/intersect/intersect.h"
#include "tests/kernel/intersect/corpus.h"

using namespace trimloop;

namespace {

// ---- To OpenCASCADE

gp_Pnt to_occt(Point p) { return {p.x, p.y, p.z}; }
gp_Ax3 to_occt(const Frame& f) { return {to_occt(f.origin), gp_Dir(f.z.x, f.z.y, f.z.z), gp_Dir(f.x.x, f.x.y, f.x.z)}; }

struct Knots {
  std::vector<double> values;
  std::vector<int> times;
  explicit Knots(const std::vector<double>& flat) {
    for (const double k : flat)
      if (values.empty() || k != values.back())
        values.push_back(k), times.push_back(1);
      else
        ++times.back();
  }
  TColStd_Array1OfReal reals() const {
    TColStd_Array1OfReal a(1, static_cast<int>(values.size()));
    for (int i = 0; i < a.Length(); ++i) a(i + 1) = values[static_cast<std::size_t>(i)];
    return a;
  }
  TColStd_Array1OfInteger multiplicities() const {
    TColStd_Array1OfInteger a(1, static_cast<int>(times.size()));
    for (int i = 0; i < a.Length(); ++i) a(i + 1) = times[static_cast<std::size_t>(i)];
    return a;
  }
};

Handle(Geom_Curve) to_occt(const Curve& c) {
  if (const auto* circle = std::get_if<Circle>(&c.shape)) {
    const Handle(Geom_Curve) whole = new Geom_Circle(to_occt(circle->frame).Ax2(), circle->radius);
    if (circle->range.length() >= two_pi - 1e-12) return whole;
    return new Geom_TrimmedCurve(whole, circle->range.lo, circle->range.hi);
  }
  if (const auto* e = std::get_if<Ellipse>(&c.shape); e && e->a >= e->b) {
    const Handle(Geom_Curve) whole = new Geom_Ellipse(to_occt(e->frame).Ax2(), e->a, e->b);
    if (e->range.length() >= two_pi - 1e-12) return whole;
    return new Geom_TrimmedCurve(whole, e->range.lo, e->range.hi);
  }
  Curve bounded = c;
  if (auto* line = std::get_if<Line>(&bounded.shape); line && !line->range.is_bounded()) line->range = {-100, 100};
  const NurbsCurve n = to_nurbs(bounded)->curve;
  const Knots knots(n.knots());
  TColgp_Array1OfPnt poles(1, static_cast<int>(n.poles().size()));
  TColStd_Array1OfReal weights(1, poles.Length());
  for (int i = 1; i <= poles.Length(); ++i) {
    const Hpoint& h = n.poles()[static_cast<std::size_t>(i - 1)];
    poles(i) = to_occt(project(h));
    weights(i) = h.w;
  }
  return new Geom_BSplineCurve(poles, weights, knots.reals(), knots.multiplicities(), n.degree());
}

Handle(Geom_Surface) to_occt(const Surface& s) {
  if (const auto* x = std::get_if<Plane>(&s.shape)) return new Geom_Plane(to_occt(x->frame));
  if (const auto* x = std::get_if<Sphere>(&s.shape)) return new Geom_SphericalSurface(to_occt(x->frame), x->radius);
  if (const auto* x = std::get_if<Cylinder>(&s.shape)) return new Geom_CylindricalSurface(to_occt(x->frame), x->radius);
  if (const auto* x = std::get_if<Torus>(&s.shape))
    return new Geom_ToroidalSurface(to_occt(x->frame), x->major_radius, x->minor_radius);
  if (const auto* x = std::get_if<Cone>(&s.shape)) {
    // One nappe, as here; its V runs along the generatrix.
    const Handle(Geom_Surface) whole = new Geom_ConicalSurface(to_occt(x->frame), x->half_angle_rad, x->radius);
    const double apex = -x->radius / std::sin(x->half_angle_rad);
    return new Geom_RectangularTrimmedSurface(whole, apex, 100.0, Standard_False);
  }
  if (const auto* x = std::get_if<Extrusion>(&s.shape)) {
    const Circle& c = std::get<Circle>(x->directrix->shape);
    const Handle(Geom_Surface) whole = new Geom_CylindricalSurface(to_occt(c.frame), c.radius);
    return new Geom_RectangularTrimmedSurface(whole, x->range_v.lo, x->range_v.hi, Standard_False);
  }
  const NurbsSurface& n = std::get<NurbsSurface>(s.shape);
  const Knots ku(n.knots_u()), kv(n.knots_v());
  TColgp_Array2OfPnt poles(1, static_cast<int>(n.poles_u()), 1, static_cast<int>(n.poles_v()));
  TColStd_Array2OfReal weights(1, poles.ColLength(), 1, poles.RowLength());
  for (int i = 1; i <= poles.ColLength(); ++i)
    for (int j = 1; j <= poles.RowLength(); ++j) {
      const Hpoint& h = n.pole(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(j - 1));
      poles(i, j) = to_occt(project(h));
      weights(i, j) = h.w;
    }
  return new Geom_BSplineSurface(poles, weights, ku.reals(), kv.reals(), ku.multiplicities(), kv.multiplicities(),
                                 n.degree_u(), n.degree_v());
}

// ---- Scores

struct Answer {
  bool right = false;
  double milliseconds = 0;
};
template <class F>
Answer timed(F f) {
  Answer a;
  double best = infinity;
  for (int k = 0; k < 3; ++k) {
    const auto t = std::chrono::steady_clock::now();
    a.right = f();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - t).count());
    if (best > 200) break;
  }
  a.milliseconds = best;
  return a;
}

// In a process of its own: what crashes or does not end in twenty seconds is wrong.
Answer guarded(const std::function<Answer()>& f) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    Answer a;
    try {
      a = f();
    } catch (const Standard_Failure&) {
    }
    const auto written = write(ends[1], &a, sizeof a);
    _exit(written == sizeof a ? 0 : 1);
  }
  close(ends[1]);
  Answer a;
  const bool got = read(ends[0], &a, sizeof a) == sizeof a;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return got ? a : Answer{};
}

// Points that are one within 1e-6 count once; `where` holds the place of each.
std::size_t separate(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (const Point& p : points)
    if (std::none_of(kept.begin(), kept.end(), [&](Point q) { return distance(p, q) < 1e-6; })) kept.push_back(p);
  return kept.size();
}

bool occt_plane(const test::CurvePair& pair, double tolerance) {
  const gp_Pln plane;
  Geom2dAPI_InterCurveCurve found(GeomAPI::To2d(to_occt(pair.a), plane), GeomAPI::To2d(to_occt(pair.b), plane),
                                  tolerance);
  std::vector<Point> points;
  for (int i = 1; i <= found.NbPoints(); ++i) points.push_back({found.Point(i).X(), found.Point(i).Y(), 0});
  const std::size_t segments = static_cast<std::size_t>(found.NbSegments());
  if (segments > 0) points.clear();  // ends of stretches are listed among the points: not held against it
  return static_cast<int>(separate(points)) == pair.expected.points &&
         static_cast<int>(segments) == pair.expected.overlaps;
}
bool occt_space(const test::CurvePair& pair, double tolerance) {
  GeomAPI_ExtremaCurveCurve found(to_occt(pair.a), to_occt(pair.b));
  if (found.NbExtrema() > 0 && found.IsParallel())
    return pair.expected.overlaps > 0 && found.LowerDistance() <= tolerance;
  std::vector<Point> points;
  for (int i = 1; i <= found.NbExtrema(); ++i) {
    if (found.Distance(i) > tolerance) continue;
    gp_Pnt p, q;
    found.Points(i, p, q);
    points.push_back({p.X(), p.Y(), p.Z()});
  }
  return pair.expected.overlaps == 0 && static_cast<int>(separate(points)) == pair.expected.points;
}
bool occt_curve_surface(const test::CurveSurfacePair& pair) {
  const GeomAPI_IntCS found(to_occt(pair.curve), to_occt(pair.surface));
  if (!found.IsDone()) return false;
  std::vector<Point> points;
  for (int i = 1; i <= found.NbPoints(); ++i)
    points.push_back({found.Point(i).X(), found.Point(i).Y(), found.Point(i).Z()});
  if (found.NbSegments() > 0) points.clear();
  return static_cast<int>(separate(points)) == pair.expected.points && found.NbSegments() == pair.expected.overlaps;
}
bool occt_surfaces(const test::SurfacePair& pair, double tolerance) {
  GeomInt_IntSS found;
  found.Perform(to_occt(pair.a), to_occt(pair.b), tolerance, true, false, false);
  if (!found.IsDone()) return false;
  if (pair.expected.overlaps > 0) return found.NbLines() == 0;  // it has no word for them: silence counts
  std::vector<std::vector<Point>> parts;
  double length = 0;
  for (int i = 1; i <= found.NbLines(); ++i) {
    const Handle(Geom_Curve) c = found.Line(i);
    if (c.IsNull() || std::abs(c->FirstParameter()) > 1e50 || std::abs(c->LastParameter()) > 1e50) return false;
    const gp_Pnt p = c->Value(c->FirstParameter()), q = c->Value(c->LastParameter());
    parts.push_back({{p.X(), p.Y(), p.Z()}, {q.X(), q.Y(), q.Z()}});
    length += GCPnts_AbscissaPoint::Length(GeomAdaptor_Curve(c));
  }
  for (int i = 1; i <= found.NbPoints(); ++i) {
    const gp_Pnt p = found.Point(i);
    parts.push_back({{p.X(), p.Y(), p.Z()}});
  }
  std::vector<std::size_t> group(parts.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Point& p : parts[i])
        for (const Point& q : parts[j])
          if (distance(p, q) < 1e-5) {
            const std::size_t from = group[i], to = group[j];
            for (std::size_t& g : group)
              if (g == from) g = to;
          }
  std::sort(group.begin(), group.end());
  const auto components = std::unique(group.begin(), group.end()) - group.begin();
  return components == pair.expected.components &&
         (pair.length == 0 || std::abs(length - pair.length) <= 1e-3 * pair.length);
}

bool ours(const test::CurvePair& pair) {
  const auto f = intersect(pair.a, pair.b);
  return f && static_cast<int>(f->points.size()) == pair.expected.points &&
         static_cast<int>(f->overlaps.size()) == pair.expected.overlaps && f->undecided.empty();
}
bool ours(const test::CurveSurfacePair& pair) {
  const auto f = intersect(pair.curve, pair.surface);
  return f && static_cast<int>(f->points.size()) == pair.expected.points &&
         static_cast<int>(f->overlaps.size()) == pair.expected.overlaps && f->undecided.empty();
}
bool ours(const test::SurfacePair& pair) {
  SurfaceIntersectOptions o;
  o.fit_mm = 1e-7;
  const auto f = intersect(pair.a, pair.b, o);
  double length = 0;
  if (f)
    for (const IntersectionBranch& b : f->branches) length += trimloop::length(b.curve);
  return f && f->components == pair.expected.components &&
         static_cast<int>(f->overlaps.size()) == pair.expected.overlaps && f->undecided.empty() &&
         (pair.length == 0 || std::abs(length - pair.length) <= 1e-3 * pair.length);
}

template <class Pair, class Theirs>
void family(const char* name, const std::vector<Pair>& corpus, bool verbose, Theirs theirs) {
  int right[2] = {0, 0};
  std::vector<double> ratios;
  for (const Pair& pair : corpus) {
    const Answer a = timed([&] { return ours(pair); });
    const Answer b = guarded([&] { return timed([&] { return theirs(pair); }); });
    right[0] += a.right, right[1] += b.right;
    if (b.milliseconds > 0) ratios.push_back(a.milliseconds / b.milliseconds);
    if (verbose || !a.right)
      fmt::print("  {:60} ours {:5} {:9.3f} ms   OCCT {:5} {:9.3f} ms\n", pair.name, a.right, a.milliseconds, b.right,
                 b.milliseconds);
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print("{:45} {:4} cases: ours {:4} right, OCCT {:4} right; our time / OCCT's: median {:.2f}\n", name,
             corpus.size(), right[0], right[1], ratios.empty() ? 0.0 : ratios[ratios.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  const bool verbose = argc > 1 && std::strcmp(argv[1], "-v") == 0;
  family("curve/curve, plane (tolerance 1e-6)", test::plane_corpus(), verbose,
         [](const auto& p) { return occt_plane(p, 1e-6); });
  family("curve/curve, plane (tolerance 1e-12)", test::plane_corpus(), verbose,
         [](const auto& p) { return occt_plane(p, 1e-12); });
  family("curve/curve, space (contact within 1e-10)", test::space_corpus(), verbose,
         [](const auto& p) { return occt_space(p, 1e-10); });
  family("curve/surface", test::curve_surface_corpus(), verbose, [](const auto& p) { return occt_curve_surface(p); });
  family("surface/surface (tolerance 1e-7)", test::surface_corpus(), verbose,
         [](const auto& p) { return occt_surfaces(p, 1e-7); });
  family("surface/surface (tolerance 1e-10)", test::surface_corpus(), verbose,
         [](const auto& p) { return occt_surfaces(p, 1e-10); });
}
