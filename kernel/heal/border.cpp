#include "kernel/heal/border.h"

#include <algorithm>

namespace trimloop::heal {

Box Track::box() const {
  Box b;
  for (const Point& p : points) b.add(p);
  return grown(b, sag_mm);
}

namespace {

std::vector<Box> runs_of(const std::vector<Point>& points) {
  std::size_t leaves = 1;
  while (leaves + 1 < points.size()) leaves *= 2;
  std::vector<Box> runs(2 * leaves);
  for (std::size_t i = 1; i < points.size(); ++i) runs[leaves + i - 1].add(points[i - 1]), runs[leaves + i - 1].add(points[i]);
  for (std::size_t i = leaves; i-- > 1;)
    runs[i].add(runs[2 * i]), runs[i].add(runs[2 * i + 1]);
  return runs;
}

}  // namespace

Track make_track(const Body& body, EdgeId id, FaceId face) {
  const Edge& edge = body[id];
  Track track;
  track.edge = id;
  track.face = face;
  std::vector<double> stops{edge.range.lo};
  for (const double b : breaks(*edge.curve))
    if (b > stops.back() && b < edge.range.hi) stops.push_back(b);
  stops.push_back(edge.range.hi);
  const std::size_t pieces = stops.size() - 1;
  const bool straight = std::holds_alternative<Line>(edge.curve->shape) || std::holds_alternative<Polyline>(edge.curve->shape);
  const std::size_t per_piece = straight ? (pieces == 1 ? 4 : 2) : pieces == 1 ? 16 : pieces <= 8 ? 8 : pieces <= 64 ? 4 : 2;
  for (std::size_t i = 0; i < pieces; ++i)
    for (std::size_t k = 0; k < per_piece; ++k)
      track.t.push_back(Interval{stops[i], stops[i + 1]}.at(double(k) / double(per_piece)));
  track.t.push_back(edge.range.hi);
  for (const double t : track.t) track.points.push_back(evaluate(*edge.curve, t));
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    track.length_mm += distance(track.points[i - 1], track.points[i]);
    if (straight) continue;
    const Point middle = evaluate(*edge.curve, 0.5 * (track.t[i - 1] + track.t[i]));
    track.sag_mm = std::max(track.sag_mm, 1.5 * distance(middle, midpoint(track.points[i - 1], track.points[i])));
  }
  track.runs = runs_of(track.points);
  return track;
}

namespace {

double distance_to(const Box& b, Point p) {
  if (b.empty()) return infinity;
  const auto off = [](double x, double lo, double hi) { return std::max({lo - x, x - hi, 0.0}); };
  return norm(Vector{off(p.x, b.lo.x, b.hi.x), off(p.y, b.lo.y, b.hi.y), off(p.z, b.lo.z, b.hi.z)});
}

// Nearest place on the chord polygon, the first one of several. Runs of chords that are farther off are passed over.
TrackFoot chord_foot(const Track& track, Point p) {
  TrackFoot best;
  const std::size_t leaves = track.runs.size() / 2;
  std::size_t todo[130], count = 0, chosen = track.points.size();
  todo[count++] = 1;
  while (count > 0) {
    const std::size_t run = todo[--count];
    if (!(distance_to(track.runs[run], p) <= best.distance)) continue;
    if (run < leaves) {
      const bool right_first = distance_to(track.runs[2 * run + 1], p) < distance_to(track.runs[2 * run], p);
      todo[count++] = 2 * run + !right_first;
      todo[count++] = 2 * run + right_first;
      continue;
    }
    const std::size_t i = run - leaves + 1;
    const Point a = track.points[i - 1], b = track.points[i];
    const Vector d = b - a;
    const double dd = dot(d, d), x = dd > 0 ? std::clamp(dot(p - a, d) / dd, 0.0, 1.0) : 0;
    const double off = distance(p, a + x * d);
    if (off < best.distance || (off == best.distance && i < chosen))
      best = {track.t[i - 1] + x * (track.t[i] - track.t[i - 1]), off}, chosen = i;
  }
  return best;
}

}  // namespace

TrackFoot foot(const Body& body, const Track& track, Point p) {
  const Edge& edge = body[track.edge];
  const TrackFoot guess = chord_foot(track, p);
  const CurveFoot near = closest_point_near(*edge.curve, p, guess.t);
  TrackFoot best{edge.range.clamp(near.t), 0};
  best.distance = distance(p, evaluate(*edge.curve, best.t));
  const double there = distance(p, evaluate(*edge.curve, guess.t));  // the descent may have run off elsewhere
  return there < best.distance ? TrackFoot{guess.t, there} : best;
}

double one_sided(const Body& body, const Track& from, const Track& to, double limit) {
  const Curve& curve = *body[from.edge].curve;
  double worst = 0;
  // The middle first: it tells strangers apart.
  worst = foot(body, to, evaluate(curve, body[from.edge].range.at(0.45))).distance;
  for (std::size_t i = 0; i < from.t.size() && worst <= limit; ++i) {
    worst = std::max(worst, foot(body, to, from.points[i]).distance);
    if (i > 0 && worst <= limit)
      worst = std::max(worst, foot(body, to, evaluate(curve, 0.5 * (from.t[i - 1] + from.t[i]))).distance);
  }
  return worst;
}

double separation(const Body& body, const Track& a, const Track& b, double limit) {
  const double there = one_sided(body, a, b, limit);
  return there > limit ? there : std::max(there, one_sided(body, b, a, limit));
}

PointGrid::PointGrid(const std::vector<Point>& points, double size_mm, double least_cell_mm) {
  Box box;
  for (const Point& p : points) box.add(p);
  if (box.empty()) return;
  origin_ = box.lo;
  // Points of sewn faces lie on surfaces: so many cells across give about one point a cell.
  cell_ = std::max({least_cell_mm, std::max(size_mm, box.diagonal()) / std::clamp(std::sqrt(double(points.size())), 1.0, 1e6), 1e-300});
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    cells_[key(index(p.x, origin_.x), index(p.y, origin_.y), index(p.z, origin_.z))].push_back(i);
  }
}

}  // namespace trimloop::heal
