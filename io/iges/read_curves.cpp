#include "formats/iges/records/curves.h"
#include "formats/iges/records/surfaces.h"
#include "formats/iges/rules.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/rules.h"
#include "kernel/geometry/arc_length.h"
#include "kernel/geometry/conic.h"
#include "kernel/geometry/variable_offset.h"
#include "kernel/nurbs/power.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

// Where the numbers of a curve live: model space (scaled to mm) or the parameter plane of a surface (nothing scaled,
// z left out: design.md, "never scale").
struct Space {
  double scale = 1;
  bool flat = false;

  Point point(double x, double y, double z) const { return {x * scale, y * scale, flat ? 0 : z * scale}; }
  Point point(const iges::Xyz& p) const { return point(p.x, p.y, p.z); }
};

// The part of a matrix that acts inside the parameter plane.
Transform in_plane(const Transform& t) {
  Transform out;
  out.r = {{{t.r[0][0], t.r[0][1], 0}, {t.r[1][0], t.r[1][1], 0}, {0, 0, 1}}};
  out.t = {t.t.x, t.t.y, 0};
  return out;
}

std::optional<Curve> refused(Context& context, const DirectoryEntry& entry, const Rule& rule, const Error& error) {
  context.add(entry, rule, error.text, error.measured, error.limit);
  return std::nullopt;
}

std::optional<Curve> arc(Context& context, const DirectoryEntry& entry, const Space& space) {
  const auto* r = context.record<iges::CircularArc>(entry);
  if (!r) return std::nullopt;
  const Point centre = space.point(r->xc, r->yc, r->zt);
  const Point start = space.point(r->xs, r->ys, r->zt), end = space.point(r->xe, r->ye, r->zt);
  const double radius = distance(centre, start), end_radius = distance(centre, end);
  if (!(radius > 0) || !(end_radius > 0) || !std::isfinite(radius + end_radius)) {
    if (!std::isfinite(radius + end_radius))
      context.add(entry, rules::non_finite, "the arc's coordinates overflow; it is left out");
    return std::nullopt;
  }
  double lo = std::atan2(start.y - centre.y, start.x - centre.x), hi = std::atan2(end.y - centre.y, end.x - centre.x);
  if (lo < 0) lo += two_pi;
  while (hi <= lo) hi += two_pi;
  // Equal ends mean the whole circle; so do ends closer than the resolution (IG-E100-03) and than those of any arc.
  constexpr double no_arc_rad = 1e-4;
  const bool equal = start.x == end.x && start.y == end.y;
  const bool tiny = !space.flat && hi - lo < no_arc_rad && radius * (hi - lo) < context.resolution_mm;
  if (equal || tiny) hi = lo + two_pi;
  return Curve{Circle{Frame{centre}, radius, {lo, hi}}};
}

std::optional<Curve> conic(Context& context, const DirectoryEntry& entry, const Space& space) {
  const auto* r = context.record<iges::ConicArc>(entry);
  if (!r) return std::nullopt;
  // x = X / scale put into the equation.
  const double s = space.scale;
  const ConicCoefficients k{r->a / s / s, r->b / s / s, r->c / s / s, r->d / s, r->e / s, r->f};
  const Point start = space.point(r->xs, r->ys, r->zt), end = space.point(r->xe, r->ye, r->zt);
  auto found = conic_arc(k, start, end);
  if (!found)  // ends on two branches break what an arc asks for; all else is the equation's
    return refused(context, entry, found.error().code == ErrorCode::InvalidArgument ? igr::e104::two_branches : igr::e104::degenerate,
                   found.error());
  if (!found->canonical)
    context.add(entry, igr::e104::not_canonical, "the conic is shifted or turned in its own coordinates; read as it is");
  if (!space.flat && found->end_error > context.resolution_mm)
    context.add(entry, igr::e104::end_off_curve, "an end lies off the conic; the nearest parameter is taken",
                found->end_error, context.resolution_mm);
  return std::move(found->curve);
}

std::optional<Curve> polyline(Context& context, const DirectoryEntry& entry, const Space& space) {
  const auto r = context.decode<iges::CopiousData>(entry);
  if (!r) return std::nullopt;
  const std::size_t stride = r->stride(), count = r->values.size() / stride;
  if (count < 2) {
    return std::nullopt;
  }
  Polyline line;
  line.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* v = r->values.data() + i * stride;
    line.points.push_back(space.point(v[0], v[1], stride == 2 ? r->common_z : v[2]));
  }
  return Curve{std::move(line)};
}

std::optional<Curve> line(Context& context, const DirectoryEntry& entry, const Space& space) {
  const auto* r = context.record<iges::Line>(entry);
  if (!r) return std::nullopt;
  Line out{space.point(r->start), space.point(r->end)};
  // A segment of no length can still be the border of a face at a pole; a ray of no direction is nothing.
  if (entry.form != 0 && !(distance(out.start, out.end) > 0)) {
    context.add(entry, igr::e110::zero_length, "the points of the line are one; it has no direction and is left out", 0.0);
    return std::nullopt;
  }
  if (entry.form == 1) out.range = {0, infinity};
  if (entry.form == 2) out.range = {-infinity, infinity};
  return Curve{out};
}

std::optional<Curve> power_spline(Context& context, const DirectoryEntry& entry, const Space& space) {
  auto r = context.decode<iges::ParametricSplineCurve>(entry);
  if (!r) return std::nullopt;
  for (auto& segment : r->coefficients)
    for (std::size_t k = 0; k < 12; ++k) segment[k] *= space.flat && k >= 8 ? 0 : space.scale;
  auto spline = from_power(r->breaks, r->coefficients);
  if (!spline) return refused(context, entry, rules::erroneous_curve, spline.error());
  if (!space.flat && spline->largest_gap > context.resolution_mm)
    context.add(entry, rules::gap_inside, "segments of the spline do not meet; each end is moved to the next start",
                spline->largest_gap, context.resolution_mm);
  return Curve{std::move(spline->curve)};
}

// A curve that is a list of numbers (the law of a 130): nothing scaled, three coordinates.
std::optional<Curve> build_numbers(Context& context, const DirectoryEntry& entry);

// `t` is applied to the poles on the way in: one pass over the data.
std::optional<Curve> spline(Context& context, const DirectoryEntry& entry, const Space& space, const Transform& t) {
  auto r = context.decode<iges::RationalBSplineCurve>(entry);
  if (!r) return std::nullopt;
  const bool still = is_identity(t);
  std::vector<Hpoint> poles;
  poles.reserve(r->points.size());
  for (std::size_t i = 0; i < r->points.size(); ++i) {
    Point p = space.point(r->points[i]);
    if (!still) p = apply(t, p);
    const double w = i < r->weights.size() ? r->weights[i] : 1;
    poles.push_back({w * p.x, w * p.y, w * p.z, w});
  }
  const auto degree = static_cast<std::size_t>(std::max(r->degree, 0));
  std::optional<Interval> range;
  if (degree < r->knots.size() && poles.size() < r->knots.size()) {
    const Interval domain{r->knots[degree], r->knots[poles.size()]};
    const Interval asked{domain.clamp(r->v0), domain.clamp(r->v1)};
    if (asked.lo < asked.hi) range = asked;
  }
  auto curve = NurbsCurve::from_homogeneous(r->degree, std::move(r->knots), std::move(poles), range);
  if (!curve) return refused(context, entry, rules::erroneous_curve, curve.error());
  return Curve{std::move(*curve)};
}

// Distances of a 130 with FLAG 2 (linear from D1 at TD1 to D2 at TD2) or 3 (a coordinate of another curve), against the
// parameter of the base or the arc length from its start.
std::optional<Curve> variable(Context& context, const DirectoryEntry& entry, const iges::OffsetCurve& r, const CurvePtr& base,
                              const CurvePtr& whole, const Space& space) {
  constexpr int linear = 2, by_arc_length = 1;
  std::optional<ArcLength> lengths;
  if (r.taper_type == by_arc_length) lengths.emplace(whole);
  const auto measure = [&](double t) {  // in the file's numbers
    return lengths ? lengths->fraction(t) * lengths->total() / space.scale : t;
  };
  CurvePtr law;
  if (r.flag != linear) {
    const DirectoryEntry* e = context.resolve(r.function, is_curve, "a curve");
    auto flat = e ? build_numbers(context, *e) : std::nullopt;
    if (!flat || !is_bounded(*flat) || r.coordinate < 1 || r.coordinate > 3) return std::nullopt;
    law = std::make_shared<const Curve>(std::move(*flat));
  }
  const auto distance = [&](double t) {
    const double s = measure(t);
    if (law) {
      const Point p = evaluate(*law, range(*law).clamp(s));
      return space.scale * (r.coordinate == 1 ? p.x : r.coordinate == 2 ? p.y : p.z);
    }
    const double f = r.td1 == r.td2 ? 0 : (s - r.td1) / (r.td2 - r.td1);
    return space.scale * (r.d1 + f * (r.d2 - r.d1));
  };
  const std::vector<double> corners = law && !lengths ? breaks(*law) : std::vector<double>{};
  const double tolerance = 1e-3 * (space.flat ? 1e-3 : context.resolution_mm);
  auto curve = variable_offset(*base, distance, {r.normal.x, r.normal.y, r.normal.z}, corners, tolerance);
  if (!curve) return refused(context, entry, rules::unsupported, curve.error());
  if (curve->deviation > 0)
    context.add(entry, rules::approximated, "an offset of changing distance is given as a spline near it", curve->deviation,
                tolerance);
  return std::move(curve->curve);
}

std::optional<Curve> offset(Context& context, const DirectoryEntry& entry, const Space& space) {
  const auto* r = context.record<iges::OffsetCurve>(entry);
  if (!r) return std::nullopt;
  const DirectoryEntry* basis = context.resolve(r->basis, is_curve, "a curve");
  if (!basis) return std::nullopt;
  CurvePtr curve;
  if (space.flat) {
    if (auto flat = parameter_curve(context, *basis)) curve = std::make_shared<const Curve>(std::move(*flat));
  } else {
    curve = model_curve(context, *basis);
  }
  if (!curve) return std::nullopt;
  const CurvePtr entire = curve;
  const Interval whole = range(*curve), part{whole.clamp(r->tt1), whole.clamp(r->tt2)};
  if (part.lo < part.hi && (part.lo != whole.lo || part.hi != whole.hi))
    curve = std::make_shared<const Curve>(with_range(*curve, part));
  // The standard offsets along V x T, the kernel along T x N.
  const Vector normal = normalized({r->normal.x, r->normal.y, r->normal.z});
  if (norm(normal) == 0) return std::nullopt;  // IG-E130-02: there is no side to go to
  const double farthest = space.scale * std::max(std::abs(r->d1), r->flag == 1 ? 0 : std::abs(r->d2));
  if (!std::isfinite(farthest * farthest)) {
    context.add(entry, rules::non_finite, "the offset distance overflows; the curve is left out", farthest);
    return std::nullopt;
  }
  if (r->flag != 1) return variable(context, entry, *r, curve, entire, space);
  return Curve{OffsetCurve{std::move(curve), r->d1 * space.scale, -normal}};
}

std::optional<Curve> composite(Context& context, const DirectoryEntry& entry, const Space& space) {
  std::vector<CompositeCurve::Segment> segments;
  Point end;
  for (const CurvePiece& piece : pieces(context, entry, space.scale)) {
    CurvePtr curve;
    if (space.flat) {
      if (auto flat = parameter_curve(context, piece)) curve = std::make_shared<const Curve>(std::move(*flat));
    } else {
      curve = model_curve(context, piece);
    }
    if (!curve) continue;  // said so
    if (!is_bounded(*curve)) {
      context.add(entry, igr::e102::member_type, name_of(*piece.entry) + " has no end and cannot be a member");
      continue;
    }
    CompositeCurve::Segment segment{curve, false};
    Point first = start_point(*curve), last = end_point(*curve);
    if (!segments.empty() && !space.flat) {
      const double gap = distance(end, first), turned = distance(end, last);
      if (gap > context.resolution_mm && turned <= context.resolution_mm) {
        segment.reversed = true;
        std::swap(first, last);
        context.add(*piece.entry, igr::e102::reversed_member, "this member fits only when it is turned; it is", gap,
                    context.resolution_mm);
      } else if (gap > context.resolution_mm) {
        context.add(*piece.entry, igr::e102::gap, "this member does not start where the one before ends", gap,
                    context.resolution_mm);
      }
    }
    end = last;
    segments.push_back(std::move(segment));
  }
  if (segments.empty()) {
    context.add(entry, igr::e102::count, "no member of the composite curve can be used; it is left out");
    return std::nullopt;
  }
  // A composite of one is that curve, unless its parameter has to start at 0.
  if (segments.size() == 1 && range(*segments[0].curve).lo == 0) return *segments[0].curve;
  return Curve{make_composite(std::move(segments))};
}

std::optional<Curve> in_definition_space(Context& context, const DirectoryEntry& entry, const Space& space) {
  switch (entry.type) {
    case 100: return arc(context, entry, space);
    case 102: return composite(context, entry, space);
    case 104: return conic(context, entry, space);
    case 106: return polyline(context, entry, space);
    case 110: return line(context, entry, space);
    case 112: return power_spline(context, entry, space);
    case 130: return offset(context, entry, space);
    default: return std::nullopt;
  }
}

std::optional<Curve> build(Context& context, const DirectoryEntry& entry, const Space& space) {
  Visit visit(context, entry);
  if (!visit) return std::nullopt;
  Transform t = placement(context, entry, space.scale);
  if (space.flat) t = in_plane(t);
  if (entry.type == iges::RationalBSplineCurve::type) return spline(context, entry, space, t);
  // `pieces` hands the placement of a composite to its leaves.
  const bool done = is_identity(t) || entry.type == iges::CompositeCurve::type;
  auto curve = in_definition_space(context, entry, space);
  if (!curve || done) return curve;
  auto placed = transformed(*curve, t);
  if (!placed) return refused(context, entry, rules::non_finite, placed.error());
  return std::move(*placed);
}

std::optional<Curve> build_numbers(Context& context, const DirectoryEntry& entry) { return build(context, entry, {1, false}); }

}  // namespace

CurvePtr model_curve(Context& context, const DirectoryEntry& entry) {
  Context::State& state = context.state(entry);
  if (state.curve_known) return state.curve;
  auto curve = build(context, entry, {context.unit.scale, false});
  if (curve && is_bounded(*curve) && !(is_finite(start_point(*curve)) && is_finite(end_point(*curve)))) {
    context.add(entry, rules::non_finite, "the curve's ends are not finite; it is left out");
    curve.reset();
  }
  if (state.busy) return nullptr;  // a cycle: the outer reading will know
  state.curve_known = true;
  if (curve) state.curve = std::make_shared<const Curve>(std::move(*curve));
  return state.curve;
}

std::optional<Curve> parameter_curve(Context& context, const DirectoryEntry& entry) {
  return build(context, entry, {1, true});
}

std::vector<CurvePiece> pieces(Context& context, const DirectoryEntry& entry, double length_scale) {
  if (entry.type != iges::CompositeCurve::type) return {{&entry, {}}};
  struct Frame {
    std::unique_ptr<Visit> visit;  // none for the outermost: whoever asks is already there, or holds it
    const iges::CompositeCurve* record;
    std::size_t next;
    Transform outer;
  };
  std::vector<CurvePiece> out;
  context.state(entry).visited = true;
  const std::size_t most = context.execution.limits.instances;
  std::vector<Frame> stack;
  if (const auto* record = context.record<iges::CompositeCurve>(entry))
    stack.push_back({nullptr, record, 0, placement(context, entry, length_scale)});
  while (!stack.empty()) {
    Frame& top = stack.back();
    if (top.next == top.record->members.size()) {
      stack.pop_back();
      continue;
    }
    const auto admits = [](const DirectoryEntry& e) { return is_curve(e) || is_point(e) || e.type == 132; };
    const DirectoryEntry* member = context.resolve(top.record->members[top.next++], admits, "a curve or point");
    if (!member || !is_curve(*member)) continue;
    if (member->type != iges::CompositeCurve::type) {
      if (out.size() >= most) {
        context.add(entry, rules::work, "the composite curve unfolds to too many members; the rest is left out",
                    static_cast<double>(out.size()), static_cast<double>(most));
        return out;
      }
      out.push_back({member, top.outer});
      continue;
    }
    // A composite in a composite (IG-E102-02): its members are taken in its place.
    auto visit = std::make_unique<Visit>(context, *member);
    const auto* record = *visit ? context.record<iges::CompositeCurve>(*member) : nullptr;
    if (!record) continue;
    const Transform outer = top.outer * placement(context, *member, length_scale);
    stack.push_back({std::move(visit), record, 0, outer});
  }
  return out;
}

CurvePtr model_curve(Context& context, const CurvePiece& piece) {
  return moved(context, model_curve(context, *piece.entry), piece.outer);
}

std::optional<Curve> parameter_curve(Context& context, const CurvePiece& piece) {
  auto curve = parameter_curve(context, *piece.entry);
  if (!curve || is_identity(piece.outer)) return curve;
  auto placed = transformed(*curve, in_plane(piece.outer));
  if (!placed) return refused(context, *piece.entry, rules::non_finite, placed.error());
  return std::move(*placed);
}

std::vector<Point> model_points(Context& context, const DirectoryEntry& entry) {
  const Transform t = model_placement(context, entry);
  const Space space{context.unit.scale, false};
  std::vector<Point> out;
  if (entry.type == iges::PointRecord::type) {
    if (const auto* r = context.record<iges::PointRecord>(entry)) out.push_back(apply(t, space.point(r->point)));
  } else if (entry.type == 132 || entry.type == 134) {  // connect point, node
    if (const iges::TableRecord* r = context.table(entry)) out.push_back(apply(t, space.point(r->xyz("X", "Y", "Z"))));
  } else if (entry.type == iges::CopiousData::type) {
    const auto r = context.decode<iges::CopiousData>(entry);
    for (std::size_t at = 0; r && at + r->stride() <= r->values.size(); at += r->stride()) {
      const double* v = r->values.data() + at;
      out.push_back(apply(t, space.point(v[0], v[1], r->interpretation == 1 ? r->common_z : v[2])));
    }
  }
  const std::size_t before = out.size();
  out.erase(std::remove_if(out.begin(), out.end(), [](Point p) { return !is_finite(p); }), out.end());
  if (out.size() < before) context.add(entry, rules::non_finite, "points with overflowing coordinates are left out");
  return out;
}

CurvePtr moved(Context& context, CurvePtr curve, const Transform& t) {
  if (!curve || is_identity(t)) return curve;
  auto placed = transformed(*curve, t);
  if (placed) return std::make_shared<const Curve>(std::move(*placed));
  context.add(rules::non_finite, placed.error().text, placed.error().measured, placed.error().limit);
  return nullptr;
}

}  // namespace trimloop::io::iges_import
