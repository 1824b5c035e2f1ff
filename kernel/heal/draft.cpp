#include "kernel/heal/draft.h"
#include "kernel/heal/run_tree.h"

#include <algorithm>

namespace trimloop::heal {
namespace {

int samples_per_span(const Curve& c) {
  if (std::holds_alternative<Line>(c.shape) || std::holds_alternative<Polyline>(c.shape)) return 1;
  if (const auto* n = std::get_if<NurbsCurve>(&c.shape)) return n->degree() == 1 ? 1 : 8;
  return 8;
}

}  // namespace

bool take_samples(Piece& p) {
  const double lo = std::min(p.t0, p.t1), hi = std::max(p.t0, p.t1);
  std::vector<double> stops{lo};
  for (double b : breaks(p.pcurve.curve))
    if (b > stops.back() && b < hi) stops.push_back(b);
  stops.push_back(hi);
  const int n = samples_per_span(p.pcurve.curve);
  p.samples.clear();
  p.samples.reserve((stops.size() - 1) * static_cast<std::size_t>(n) + 1);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    for (int k = 0; k < n; ++k) {
      const double t = Interval{stops[i], stops[i + 1]}.at(double(k) / n);
      p.samples.push_back({t, uv_of(p, t)});
    }
  p.samples.push_back({hi, uv_of(p, hi)});
  if (p.t0 > p.t1) std::reverse(p.samples.begin(), p.samples.end());
  return std::all_of(p.samples.begin(), p.samples.end(), [](const Sample& s) { return is_finite(s.uv); });
}

Piece straight_piece(Uv a, Uv b) {
  Piece p;
  p.pcurve = make_line2(a, b);
  p.t0 = range(p.pcurve).lo;
  p.t1 = range(p.pcurve).hi;
  p.samples = {{p.t0, a}, {p.t1, b}};
  return p;
}

void move_by(Piece& p, Uv shift) {
  p.shift = p.shift + shift;
  for (Sample& s : p.samples) s.uv = s.uv + shift;
}

void move_by(Ring& ring, Uv shift) {
  if (shift.u == 0 && shift.v == 0) return;
  for (Piece& p : ring.pieces) move_by(p, shift);
}

void turn_around(Piece& p) {
  std::swap(p.t0, p.t1);
  std::swap(p.c0, p.c1);
  std::swap(p.start, p.end);
  std::reverse(p.samples.begin(), p.samples.end());
}

void turn_around(Ring& ring) {
  std::reverse(ring.pieces.begin(), ring.pieces.end());
  for (Piece& p : ring.pieces) turn_around(p);
  ring.turns_u = -ring.turns_u;
  ring.turns_v = -ring.turns_v;
  ring.area = -ring.area;
}

double curve_parameter(const Piece& p, double t) {
  if (p.map.size() < 2) return t == p.t0 ? p.c0 : t == p.t1 ? p.c1 : p.c0 + (t - p.t0) / (p.t1 - p.t0) * (p.c1 - p.c0);
  for (std::size_t i = 1; i < p.map.size(); ++i) {
    const Uv a = p.map[i - 1], b = p.map[i];
    if ((t - a.v) * (t - b.v) <= 0) return a.u + (t - a.v) / (b.v - a.v) * (b.u - a.u);
  }
  return p.c1;
}

double pcurve_parameter(const Piece& p, double c) {
  if (p.map.size() < 2) return c == p.c0 ? p.t0 : c == p.c1 ? p.t1 : p.t0 + (c - p.c0) / (p.c1 - p.c0) * (p.t1 - p.t0);
  for (std::size_t i = 1; i < p.map.size(); ++i) {
    const Uv a = p.map[i - 1], b = p.map[i];
    if (c <= b.u) return a.v + (c - a.u) / (b.u - a.u) * (b.v - a.v);
  }
  return p.map.back().v;
}

std::pair<Piece, Piece> split(const Piece& whole, double t, int node) {
  Piece a = whole, b = whole;
  const double c = curve_parameter(whole, t);
  a.t1 = b.t0 = t;
  a.c1 = b.c0 = c;
  a.end = b.start = node;
  a.seam = b.seam = -1;
  if (!whole.map.empty()) {
    const bool along = whole.c0 < whole.c1;  // the map ascends in the curve's parameter
    a.map.clear(), b.map.clear();
    for (const Uv& m : whole.map) {
      if ((along && m.u < c) || (!along && m.u > c)) a.map.push_back(m);
      if ((along && m.u > c) || (!along && m.u < c)) b.map.push_back(m);
    }
    a.map.insert(along ? a.map.end() : a.map.begin(), {c, t});
    b.map.insert(along ? b.map.begin() : b.map.end(), {c, t});
  }
  const Uv at = uv_of(whole, t);
  const auto before = [&](double s) { return whole.t0 < whole.t1 ? s < t : s > t; };
  a.samples.clear(), b.samples.clear();
  b.samples.push_back({t, at});
  for (const Sample& s : whole.samples) {
    if (s.t == t) continue;
    (before(s.t) ? a : b).samples.push_back(s);
  }
  a.samples.push_back({t, at});
  return {std::move(a), std::move(b)};
}

UvBox box_of(const Ring& ring) {
  UvBox box;
  for (const Piece& p : ring.pieces)
    for (const Sample& s : p.samples) box.add(s.uv);
  return box;
}

double area_of(const Ring& ring) {
  double twice = 0;
  const Uv origin = first_uv(ring.pieces.front());
  Uv last = origin;
  for (const Piece& p : ring.pieces)
    for (const Sample& s : p.samples) {
      twice += cross(last - origin, s.uv - origin);
      last = s.uv;
    }
  return twice / 2;
}

RunTree polygon_of(const Ring& ring) {
  std::vector<Chord> chords;
  Uv last = last_uv(ring.pieces.back());
  for (std::uint32_t p = 0; p < ring.pieces.size(); ++p)
    for (std::uint32_t i = 0; i < ring.pieces[p].samples.size(); ++i) {
      const Uv here = ring.pieces[p].samples[i].uv;
      chords.push_back({p, i == 0 ? 0 : i - 1, last, here});
      last = here;
    }
  return RunTree(std::move(chords));
}

}  // namespace trimloop::heal
