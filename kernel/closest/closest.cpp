#include "kernel/closest/closest.h"

#include <algorithm>

#include "kernel/closest/search.h"
#include "kernel/geometry/surface_descent.h"

namespace trimloop {

using closest::Answer;
using closest::Foot;
using closest::Question;
using closest::Shape;
using closest::SquaredDistance;

namespace {

// What evaluation may be off, for points of that size.
double rounding(const SquaredDistance& field, Point p) {
  return 32 * std::numeric_limits<double>::epsilon() * (field.size + norm(to_vector(p)));
}

ClosestPoint to_closest(const Foot& foot, double lower_squared, double slack) {
  ClosestPoint c{foot.uv, foot.point, std::sqrt(foot.squared), 0};
  c.lower = std::max(0.0, std::sqrt(std::min(lower_squared, foot.squared)) - slack);
  return c;
}

ClosestPoint nearest_of(const SquaredDistance& field, const Shape& shape, Point p, const ClosestOptions& options) {
  Question ask;
  ask.p = p;
  ask.tolerance = std::max(options.tolerance_mm, rounding(field, p));
  const Answer answer = closest::search(field, shape, ask);
  return to_closest(answer.best, answer.lower, rounding(field, p));
}

// The collected feet that are valleys of the whole: one of each, nearest first.
ClosestPoints all_of(const SquaredDistance& field, const Shape& shape, Point p, double within) {
  Question ask;
  ask.p = p;
  ask.within = std::max(within, rounding(field, p));
  ask.collect = true;
  ask.most_cells = 4000;  // a continuum of answers would take any number
  Answer answer = closest::search(field, shape, ask);
  answer.feet.push_back(answer.best);
  std::stable_sort(answer.feet.begin(), answer.feet.end(),
                   [](const Foot& a, const Foot& b) { return a.squared < b.squared; });
  ClosestPoints out;
  out.complete = answer.complete;
  const double limit = std::sqrt(answer.best.squared) + ask.within, near = 1e-7 * field.size;
  std::vector<Foot> kept;
  for (const Foot& foot : answer.feet) {
    if (std::sqrt(foot.squared) > limit || kept.size() >= 256) break;
    // The bottom of a part may lie on the part's side: on in the whole piece, and in those that touch there, it goes
    // down to a valley that is in the list already.
    bool valley = true;
    for (std::size_t i = 0; i < field.pieces.size() && valley; ++i) {
      const SquaredDistance::Piece& piece = field.pieces[i];
      if (!piece.u.contains(foot.uv.u) || !piece.v.contains(foot.uv.v)) continue;
      const Foot on = closest::descend(shape, i, piece.u, piece.v, p, foot.uv);
      valley = distance(on.point, foot.point) <= near;
    }
    const auto known = [&](const Foot& k) { return distance(k.point, foot.point) <= near; };
    if (valley && std::none_of(kept.begin(), kept.end(), known)) kept.push_back(foot);
  }
  for (const Foot& foot : kept) out.points.push_back(to_closest(foot, answer.lower, rounding(field, p)));
  return out;
}

}  // namespace

// ---- Curves

struct ClosestOnCurve::Data {
  CurvePieces pieces;
  SquaredDistance field;
  std::optional<ParameterMap> map;
  explicit Data(const NurbsCurve& c) : pieces(c), field(closest::squared_distance(pieces)) {}
  Shape shape() const { return {nullptr, &pieces}; }
  ClosestPoint mapped(ClosestPoint c) const {
    if (map) c.uv.u = map_from_nurbs(*map, c.uv.u);
    return c;
  }
};

ClosestOnCurve::ClosestOnCurve(const NurbsCurve& c) : data_(std::make_shared<Data>(c)) {}

Result<ClosestOnCurve> ClosestOnCurve::make(const Curve& c) {
  if (const auto* nurbs = std::get_if<NurbsCurve>(&c.shape)) return ClosestOnCurve(*nurbs);
  const auto nurbs = to_nurbs(c);
  if (!nurbs) return tl::unexpected(nurbs.error());
  auto data = std::make_shared<Data>(nurbs->curve);
  data->map = nurbs->map;
  ClosestOnCurve out(nurbs->curve);
  out.data_ = data;
  return out;
}

ClosestPoint ClosestOnCurve::nearest(Point p, ClosestOptions options) const {
  return data_->mapped(nearest_of(data_->field, data_->shape(), p, options));
}

ClosestPoints ClosestOnCurve::all(Point p, double within_mm) const {
  ClosestPoints out = all_of(data_->field, data_->shape(), p, within_mm);
  for (ClosestPoint& c : out.points) c = data_->mapped(c);
  return out;
}

// ---- Surfaces

struct ClosestOnSurface::Data {
  struct Searched {
    SurfacePieces pieces;
    SquaredDistance field;
    explicit Searched(const NurbsSurface& s) : pieces(s), field(closest::squared_distance(pieces)) {}
    Shape shape() const { return {&pieces, nullptr}; }
  };
  std::optional<Searched> searched;
  std::optional<Surface> elementary;
  Interval u, v;  // of the elementary one
  std::optional<ParameterMap> map_u, map_v;
  ClosestPoint mapped(ClosestPoint c) const {
    if (map_u) c.uv = {map_from_nurbs(*map_u, c.uv.u), map_from_nurbs(*map_v, c.uv.v)};
    return c;
  }
  ClosestPoint closed_form(Point p) const {
    const SurfaceFoot foot = *detail::closest_elementary(*elementary, p, u, v);
    const double slack = 64 * std::numeric_limits<double>::epsilon() *
                         (norm(to_vector(p)) + norm(to_vector(foot.point)) + foot.distance);
    return {foot.uv, foot.point, foot.distance, std::max(0.0, foot.distance - slack)};
  }
};

ClosestOnSurface::ClosestOnSurface(const NurbsSurface& s) {
  auto data = std::make_shared<Data>();
  data->searched.emplace(s);
  data_ = data;
}

Result<ClosestOnSurface> ClosestOnSurface::make(const Surface& s, std::optional<Interval> u,
                                                std::optional<Interval> v) {
  const detail::Rectangle whole = detail::rectangle(s);
  const Interval in_u = u.value_or(whole.u), in_v = v.value_or(whole.v);
  if (const auto* nurbs = std::get_if<NurbsSurface>(&s.shape))
    return ClosestOnSurface(u || v ? nurbs->with_range(in_u, in_v) : *nurbs);
  auto data = std::make_shared<Data>();
  if (detail::closest_elementary(s, {}, in_u, in_v)) {
    data->elementary = s;
    data->u = in_u;
    data->v = in_v;
  } else {
    if (!in_u.is_bounded() || !in_v.is_bounded())
      return tl::unexpected(Error{ErrorCode::Unsupported, "the nearest point of an unbounded surface"});
    auto nurbs = to_nurbs(s, in_u, in_v);
    if (!nurbs) return tl::unexpected(nurbs.error());
    data->searched.emplace(nurbs->surface);
    data->map_u = nurbs->map_u;
    data->map_v = nurbs->map_v;
  }
  ClosestOnSurface out;
  out.data_ = data;
  return out;
}

ClosestPoint ClosestOnSurface::nearest(Point p, ClosestOptions options) const {
  if (data_->elementary) return data_->closed_form(p);
  return data_->mapped(nearest_of(data_->searched->field, data_->searched->shape(), p, options));
}

ClosestPoints ClosestOnSurface::all(Point p, double within_mm) const {
  if (data_->elementary) return {{data_->closed_form(p)}, false};
  ClosestPoints out = all_of(data_->searched->field, data_->searched->shape(), p, within_mm);
  for (ClosestPoint& c : out.points) c = data_->mapped(c);
  return out;
}

}  // namespace trimloop
