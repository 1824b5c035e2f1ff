#include "kernel/splines/interpolating.h"

#include <fmt/format.h>

#include "kernel/splines/pieces.h"

namespace trimloop {

namespace {

struct Joint {
  Point point;
  Vector tangent;  // derivative by the rule's own parameter
};

double span_length(Point a, Point b, TangentRule rule) { return rule == TangentRule::CatmullRom ? 1 : distance(a, b); }

// Seed 000 §2.2.1 with the denominator (i + 1) - (i - 1), and §2.2.2.
Vector tangent(Point before, Point at, Point after, TangentRule rule) {
  if (rule == TangentRule::CatmullRom) return 0.5 * (after - before);
  const double in = distance(before, at), out = distance(at, after);
  return ((out / in) * (at - before) + (in / out) * (after - at)) / (in + out);
}

Result<void> check(std::span<const Point> points, TangentRule rule, SplineEnds ends) {
  const std::size_t least = ends == SplineEnds::Dropped ? 4 : 3;
  if (points.size() < least)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} points, at least {} are needed", points.size(), least),
                static_cast<double>(points.size()), static_cast<double>(least));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite", i));
    const std::size_t next = (i + 1) % points.size();
    if (next == 0 && ends != SplineEnds::Closed) break;
    if (rule == TangentRule::Overhauser && !(distance(points[i], points[next]) > 0))
      return fail(ErrorCode::InvalidArgument, fmt::format("points {} and {} coincide", i, next), 0, 0);
  }
  return {};
}

// The poles of a cubic over [0, h] from its ends and end derivatives.
CubicPiece hermite(const Joint& a, const Joint& b, double h) {
  return {{a.point, a.point + (h / 3) * a.tangent, b.point - (h / 3) * b.tangent, b.point}, h};
}

// A parabola with the middle pole `middle`, raised to degree 3 by thirds (seed 000 §1.3).
CubicPiece raised(Point a, Point middle, Point b, double h) {
  return {{a, a + (2.0 / 3) * (middle - a), b + (2.0 / 3) * (middle - b), b}, h};
}

struct Chain {
  std::vector<CubicPiece> pieces;
  std::vector<Smoothness> joints;  // between piece i and i + 1
};

Chain chain(std::span<const Point> p, TangentRule rule, SplineEnds ends) {
  const std::size_t n = p.size();
  const bool closed = ends == SplineEnds::Closed;
  std::vector<Joint> at(n);
  for (std::size_t i = 0; i < n; ++i) {
    at[i].point = p[i];
    if (closed || (i > 0 && i + 1 < n)) at[i].tangent = tangent(p[(i + n - 1) % n], p[i], p[(i + 1) % n], rule);
  }
  const bool parabolas = ends == SplineEnds::QuadraticG1 || ends == SplineEnds::QuadraticC1;
  const double share = ends == SplineEnds::QuadraticC1 ? 0.5 : 1 / std::numbers::sqrt2;
  const Smoothness end_joint = ends == SplineEnds::QuadraticC1 ? Smoothness::C1 : Smoothness::C0;
  Chain out;
  const auto append = [&out](const CubicPiece& piece, Smoothness with_last) {
    if (!out.pieces.empty()) out.joints.push_back(with_last);
    out.pieces.push_back(piece);
  };
  if (parabolas) {
    const double h = span_length(p[0], p[1], rule);
    append(raised(p[0], p[1] - (share * h) * at[1].tangent, p[1], h), Smoothness::C1);
  }
  const std::size_t first = closed ? 0 : 1, last = closed ? n : n - 2;
  for (std::size_t i = first; i < last; ++i) {
    const Joint& to = at[(i + 1) % n];
    append(hermite(at[i], to, span_length(p[i], to.point, rule)), parabolas && i == 1 ? end_joint : Smoothness::C1);
  }
  if (parabolas) {
    const double h = span_length(p[n - 2], p[n - 1], rule);
    append(raised(p[n - 2], p[n - 2] + (share * h) * at[n - 2].tangent, p[n - 1], h), end_joint);
  }
  return out;
}

}  // namespace

Result<NurbsCurve> spline_through(std::span<const Point> points, TangentRule rule, SplineEnds ends) {
  if (auto good = check(points, rule, ends); !good) return tl::unexpected(good.error());
  const Chain c = chain(points, rule, ends);
  return join_cubics(c.pieces, c.joints);
}

Result<NurbsCurve> overhauser_uniform(std::span<const Point> points, SplineEnds ends) {
  if (auto good = check(points, TangentRule::Overhauser, ends); !good) return tl::unexpected(good.error());
  Chain c = chain(points, TangentRule::Overhauser, ends);
  for (CubicPiece& piece : c.pieces) piece.length = 1;
  for (Smoothness& joint : c.joints) joint = Smoothness::C0;
  return join_cubics(c.pieces, c.joints);
}

}  // namespace trimloop
