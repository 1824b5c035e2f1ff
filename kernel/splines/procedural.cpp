#include "kernel/splines/procedural.h"

#include <fmt/format.h>

namespace trimloop {

namespace {

Result<void> check(std::span<const Point> polygon, bool closed, int rounds, std::size_t growth, std::size_t most) {
  const std::size_t least = closed ? 3 : 2;
  if (polygon.size() < least)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} points, at least {} are needed", polygon.size(), least),
                static_cast<double>(polygon.size()), static_cast<double>(least));
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (!is_finite(polygon[i])) return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite", i));
  if (rounds < 0) return fail(ErrorCode::InvalidArgument, "the number of rounds is negative", rounds, 0);
  std::size_t count = polygon.size();
  for (int i = 0; i < rounds; ++i) {
    if (count > most / growth)
      return fail(ErrorCode::Limit, fmt::format("{} rounds make more than {} points", rounds, most), rounds,
                  static_cast<double>(most));
    count *= growth;
  }
  return {};
}

std::vector<Point> cut_once(const std::vector<Point>& p, bool closed, double ratio) {
  std::vector<Point> out;
  out.reserve(2 * p.size());
  const std::size_t sides = closed ? p.size() : p.size() - 1;
  if (!closed) out.push_back(p.front());
  for (std::size_t i = 0; i < sides; ++i) {
    const Point a = p[i], b = p[(i + 1) % p.size()];
    if (closed || i > 0) out.push_back(a + ratio * (b - a));
    if (closed || i + 1 < sides) out.push_back(b - ratio * (b - a));
  }
  if (!closed) out.push_back(p.back());
  return out;
}

double longest_side(const std::vector<Point>& p, bool closed) {
  double longest = 0;
  for (std::size_t i = closed ? 0 : 1; i < p.size(); ++i)
    longest = std::max(longest, distance(p[(i + p.size() - 1) % p.size()], p[i]));
  return longest;
}

double largest_second_difference(const std::vector<Point>& p, bool closed) {
  double largest = 0;
  const std::size_t n = p.size();
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i)
    largest = std::max(largest, norm((p[(i + 1) % n] - p[i]) - (p[i] - p[(i + n - 1) % n])));
  return largest;
}

}  // namespace

Result<LevelPolygon> cut_corners(std::span<const Point> polygon, bool closed, double ratio, int rounds,
                                 std::size_t most_points) {
  if (auto good = check(polygon, closed, rounds, 2, most_points); !good) return tl::unexpected(good.error());
  if (!(ratio > 0 && ratio < 0.5))
    return fail(ErrorCode::InvalidArgument, fmt::format("ratio {} is not between 0 and 1/2", ratio), ratio, 0.5);
  LevelPolygon out{{polygon.begin(), polygon.end()}, 0};
  for (int i = 0; i < rounds; ++i) out.points = cut_once(out.points, closed, ratio);
  // A corner is r/2 times its second difference away from the side that cuts it off. At 1/4 these shrink to a quarter
  // with each round away from the ends, and the polygon's corner is an eighth of it away from the parabola. Otherwise
  // sides shrink by the larger of 1 - 2r and 2r, and a second difference is at most two sides. Beside the end of an open
  // polygon a side keeps up to 1 - r of its length.
  const double shrink = std::max({1 - 2 * ratio, 2 * ratio, closed ? 0 : 1 - ratio});
  const double by_sides = ratio * longest_side(out.points, closed) / (1 - shrink);
  out.bound = ratio == 0.25 && closed ? std::min(by_sides, largest_second_difference(out.points, true) / 8) : by_sides;
  return out;
}

Result<LevelPolygon> koch(std::span<const Point> polygon, bool closed, int rounds, std::size_t most_points) {
  if (auto good = check(polygon, closed, rounds, 4, most_points); !good) return tl::unexpected(good.error());
  for (const Point& p : polygon)
    if (p.z != polygon[0].z) return fail(ErrorCode::InvalidArgument, "Koch's curve lies in a plane z = const", p.z, polygon[0].z);
  LevelPolygon out{{polygon.begin(), polygon.end()}, 0};
  const double height = std::sqrt(3.0) / 6;  // of the raised triangle, as a share of the side
  for (int round = 0; round < rounds; ++round) {
    std::vector<Point> next;
    const std::size_t n = out.points.size(), sides = closed ? n : n - 1;
    next.reserve(4 * n);
    for (std::size_t i = 0; i < sides; ++i) {
      const Point a = out.points[i], b = out.points[(i + 1) % n];
      const Vector along = b - a, left{-along.y, along.x, 0};
      next.insert(next.end(), {a, a + along / 3, a + 0.5 * along + height * left, b - along / 3});
    }
    if (!closed) next.push_back(out.points.back());
    out.points = std::move(next);
  }
  // The curve over a side fills no more than the triangle that the next round raises there, and reaches its apex.
  out.bound = height * longest_side(out.points, closed);
  return out;
}

}  // namespace trimloop
