// Arc length by Gauss-Legendre quadrature of the speed, halving where two halves disagree with the whole.

#include "kernel/geometry/arc_length.h"

#include <array>

namespace trimloop {
namespace {

// Nodes and weights of the 8-point rule on [-1, 1] (positive half; Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> nodes{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                      0.96028985649753623168};
constexpr std::array<double, 4> weights{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                        0.10122853629037625915};

double speed(const Curve& c, double t) { return norm(jet(c, t).d1); }

double gauss(const Curve& c, double lo, double hi) {
  const double half = 0.5 * (hi - lo), mid = 0.5 * (lo + hi);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += weights[i] * (speed(c, mid - half * nodes[i]) + speed(c, mid + half * nodes[i]));
  return half * sum;
}

struct Piece {
  double lo, hi, length;
};

// Pieces of a smooth part, in order, each measured to about `tolerance`. The work is bounded: a part that never settles
// (a cusp, a NaN) ends at 1/2^30 of itself, and after 4096 pieces nothing is halved any more.
std::vector<Piece> pieces(const Curve& c, double lo, double hi, double tolerance) {
  std::vector<Piece> done, open{{lo, hi, gauss(c, lo, hi)}};
  const double shortest = (hi - lo) * 0x1p-30;
  while (!open.empty()) {
    const Piece p = open.back();
    open.pop_back();
    const double mid = 0.5 * (p.lo + p.hi);
    const Piece left{p.lo, mid, gauss(c, p.lo, mid)}, right{mid, p.hi, gauss(c, mid, p.hi)};
    const bool settled = std::abs(left.length + right.length - p.length) <= tolerance;
    if (settled || !(p.hi - p.lo > shortest) || done.size() + open.size() > 4096) {
      done.push_back(left);
      done.push_back(right);
    } else {
      open.push_back(right);
      open.push_back(left);
    }
  }
  return done;
}

std::vector<Piece> all_pieces(const Curve& c, double relative_error) {
  const std::vector<double> at = breaks(c);
  double rough = 0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) rough += gauss(c, at[i], at[i + 1]);
  const double tolerance = relative_error * rough / static_cast<double>(std::max<std::size_t>(at.size(), 1));
  std::vector<Piece> out;
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    if (at[i] < at[i + 1])
      for (const Piece& p : pieces(c, at[i], at[i + 1], tolerance)) out.push_back(p);
  return out;
}

}  // namespace

double length(const Curve& c, double relative_error) {
  if (!is_bounded(c)) return infinity;
  if (const auto* line = std::get_if<Line>(&c.shape)) return line->range.length() * distance(line->start, line->end);
  if (const auto* circle = std::get_if<Circle>(&c.shape)) return circle->range.length() * std::abs(circle->radius);
  double sum = 0;
  if (const auto* polyline = std::get_if<Polyline>(&c.shape)) {
    for (std::size_t i = 0; i + 1 < polyline->points.size(); ++i)
      sum += distance(polyline->points[i], polyline->points[i + 1]);
  } else if (const auto* composite = std::get_if<CompositeCurve>(&c.shape)) {
    for (const CompositeCurve::Segment& s : composite->segments) sum += length(*s.curve, relative_error);
  } else {
    for (const Piece& p : all_pieces(c, relative_error)) sum += p.length;
  }
  return sum;
}

ArcLength::ArcLength(CurvePtr curve) : curve_(std::move(curve)) {
  const Interval r = range(*curve_);
  parameters_.push_back(r.lo);
  lengths_.push_back(0);
  for (const Piece& p : all_pieces(*curve_, 1e-11)) {
    parameters_.push_back(p.hi);
    lengths_.push_back(lengths_.back() + p.length);
  }
  if (parameters_.size() == 1) parameters_.push_back(r.hi), lengths_.push_back(0);
}

double ArcLength::fraction(double t) const {
  const Interval r{parameters_.front(), parameters_.back()};
  if (!(total() > 0)) return r.length() > 0 ? r.clamp(t - r.lo) / r.length() : 0;
  if (!(t > r.lo)) return 0;
  if (t >= r.hi) return 1;
  const auto i =
      static_cast<std::size_t>(std::upper_bound(parameters_.begin(), parameters_.end(), t) - parameters_.begin()) - 1;
  return (lengths_[i] + gauss(*curve_, parameters_[i], t)) / total();
}

// Newton inside the piece, kept within it by bisection.
double ArcLength::parameter(double length_fraction) const {
  const Interval r{parameters_.front(), parameters_.back()};
  if (!(length_fraction > 0)) return r.lo;
  if (length_fraction >= 1) return r.hi;
  if (!(total() > 0)) return r.at(length_fraction);
  const double target = length_fraction * total();
  const auto above =
      static_cast<std::size_t>(std::upper_bound(lengths_.begin(), lengths_.end(), target) - lengths_.begin());
  if (above >= parameters_.size()) return r.hi;
  const double start = parameters_[above - 1];
  double lo = start, hi = parameters_[above];
  double t = lo + (hi - lo) * (target - lengths_[above - 1]) / (lengths_[above] - lengths_[above - 1]);
  for (int i = 0; i < 60; ++i) {
    const double excess = lengths_[above - 1] + gauss(*curve_, start, t) - target;
    if (std::abs(excess) <= 1e-15 * total()) break;
    (excess > 0 ? hi : lo) = t;
    const double v = speed(*curve_, t);
    const double newton = t - excess / v;
    const double next = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
    if (std::abs(next - t) <= 1e-15 * r.length()) return next;
    t = next;
  }
  return t;
}

}  // namespace trimloop
