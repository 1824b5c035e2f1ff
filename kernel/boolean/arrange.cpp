#include "kernel/boolean/arrange.h"

#include <algorithm>

namespace trimloop::boolean {
namespace {

bool is_straight(const Curve2& c) { return std::holds_alternative<Line>(c.curve.shape); }

double parameter(const HalfEdge& h, double x) {  // x from 0 at its start to 1 at its end
  const Interval r = h.use.range;
  if (x == 0 || x == 1) return (x == 1) != h.use.reversed ? r.hi : r.lo;
  return h.use.reversed ? r.hi + x * (r.lo - r.hi) : r.lo + x * (r.hi - r.lo);
}
Uv at(const HalfEdge& h, double x) { return evaluate(h.use.pcurve, parameter(h, x)); }

// Fractions at which a curve is looked at: its breaks and enough between them.
std::vector<double> fractions(const HalfEdge& h) {
  if (is_straight(h.use.pcurve)) return {0, 1};
  std::vector<double> stops{0};
  const double a = parameter(h, 0), b = parameter(h, 1);
  for (const double t : breaks(h.use.pcurve.curve))
    if (const double x = (t - a) / (b - a); x > 1e-9 && x < 1 - 1e-9) stops.push_back(x);
  stops.push_back(1);
  std::sort(stops.begin(), stops.end());
  const int parts = stops.size() > 8 ? 4 : 24;
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    for (int k = 0; k < parts; ++k) out.push_back(stops[i] + (stops[i + 1] - stops[i]) * k / parts);
  out.push_back(1);
  return out;
}

class Arranger {
 public:
  Arranger(const Network& network, const FaceOf& face, const FaceNet& net)
      : network_(network), net_(net),
        scale_{1 / std::max(face.uv.u.length(), 1e-300), 1 / std::max(face.uv.v.length(), 1e-300)} {}

  Result<FacePieces> run() {
    collect();
    number_ends();
    prune();
    if (auto bad = link()) return tl::unexpected<Error>(*bad);
    return pieces();
  }

 private:
  Uv scaled(Uv p) const { return {p.u * scale_.u, p.v * scale_.v}; }

  // ---- Half-edges

  void collect() {
    for (const Use& use : net_.border) {
      if (use.segment == none) {
        add_pole(use);
        continue;
      }
      add(use);
    }
    for (const Use& use : net_.inner) {
      Use there = use;
      there.reversed = false;
      add(there);
      there.reversed = true;
      add(there);
    }
  }
  void add(const Use& use) {
    const Segment& s = network_.segments[use.segment];
    HalfEdge h;
    h.use = use;
    h.from = use.reversed ? s.end : s.start;
    h.to = use.reversed ? s.start : s.end;
    out_.half_edges.push_back(std::move(h));
  }
  // A pole's side is cut where inner curves arrive.
  void add_pole(const Use& use) {
    const Uv a = evaluate(use.pcurve, use.range.lo), d = evaluate(use.pcurve, use.range.hi) - a;
    const double length = norm(scaled(d));
    std::vector<double> cuts{0};
    for (const Use& inner : net_.inner) {
      const Segment& s = network_.segments[inner.segment];
      for (const bool hi : {false, true}) {
        if ((hi ? s.end : s.start) != use.pole) continue;
        const Uv p = scaled(evaluate(inner.pcurve, hi ? inner.range.hi : inner.range.lo) - a);
        if (std::abs(cross(scaled(d), p)) > 1e-6 * length) continue;
        const double x = dot(p, scaled(d)) / (length * length);
        if (x > 1e-9 && x < 1 - 1e-9) cuts.push_back(x);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(1);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] - cuts[i] <= 1e-9) continue;
      HalfEdge h;
      h.use = use;
      const double from = use.range.lo, span = use.range.hi - use.range.lo;
      h.use.range = {cuts[i] == 0 ? from : from + cuts[i] * span, cuts[i + 1] == 1 ? use.range.hi : from + cuts[i + 1] * span};
      h.from = h.to = use.pole;
      out_.half_edges.push_back(std::move(h));
    }
  }

  // ---- Ends: places in the parameter plane; one node may have several (seams, poles)

  void number_ends() {
    for (const HalfEdge& h : out_.half_edges) {
      starts_.push_back(place(h.from, start_of(h)));
      ends_.push_back(place(h.to, end_of(h)));
    }
  }
  std::size_t place(NodeIndex node, Uv uv) {
    const Uv p = scaled(uv);
    const bool pole = is_pole(node);
    const double near = pole ? 1e-7 : 1e-3;
    auto& at = places_[node];
    for (const auto& [q, index] : at)
      if (norm(p - q) <= near) return index;
    at.push_back({p, count_});
    return count_++;
  }
  bool is_pole(NodeIndex node) const {
    for (const Use& use : net_.border)
      if (use.segment == none && use.pole == node) return true;
    return false;
  }

  // Curves that end inside the face bound nothing.
  void prune() {
    std::vector<bool> gone(out_.half_edges.size(), false);
    for (bool again = true; again;) {
      again = false;
      std::vector<int> leaving(count_, 0);
      for (std::size_t i = 0; i < gone.size(); ++i)
        if (!gone[i]) ++leaving[starts_[i]], ++leaving[ends_[i]];
      for (std::size_t i = 0; i < gone.size(); ++i)
        if (!gone[i] && (leaving[starts_[i]] == 2 || leaving[ends_[i]] == 2) && is_two_sided(i) &&
            (is_loose(i, starts_[i], gone) || is_loose(i, ends_[i], gone)))
          gone[i] = again = true;
    }
    FacePieces kept;
    std::vector<std::size_t> s, e;
    for (std::size_t i = 0; i < gone.size(); ++i)
      if (!gone[i]) kept.half_edges.push_back(std::move(out_.half_edges[i])), s.push_back(starts_[i]), e.push_back(ends_[i]);
    out_ = std::move(kept);
    starts_ = std::move(s), ends_ = std::move(e);
  }
  bool is_two_sided(std::size_t i) const {
    const SegmentIndex segment = out_.half_edges[i].use.segment;
    for (const Use& use : net_.inner)
      if (use.segment == segment) return segment != none;
    return false;
  }
  // Nothing at the place but the segment itself.
  bool is_loose(std::size_t i, std::size_t place, const std::vector<bool>& gone) const {
    if (starts_[i] == ends_[i]) return false;
    for (std::size_t k = 0; k < gone.size(); ++k)
      if (!gone[k] && (starts_[k] == place || ends_[k] == place) &&
          out_.half_edges[k].use.segment != out_.half_edges[i].use.segment)
        return false;
    return true;
  }

  // ---- Round each place

  // Where the half-edge, followed from its start (or back from its end), leaves a circle about that place.
  double angle(const HalfEdge& h, bool backwards, double radius) const {
    const auto from = [&](double x) { return scaled(at(h, backwards ? 1 - x : x)); };
    const Uv centre = from(0);
    double lo = 0, hi = 1;
    const std::vector<double> stops = is_straight(h.use.pcurve) ? std::vector<double>{0, 1} : fractions(h);
    for (std::size_t i = 1; i < stops.size(); ++i) {
      const double x = backwards ? 1 - stops[stops.size() - 1 - i] : stops[i];
      if (norm(from(x) - centre) >= radius) {
        hi = x;
        break;
      }
      lo = x;
    }
    for (int i = 0; i < 60 && hi - lo > 1e-15; ++i) (norm(from(0.5 * (lo + hi)) - centre) >= radius ? hi : lo) = 0.5 * (lo + hi);
    const Uv d = from(hi) - centre;
    return std::atan2(d.v, d.u);
  }
  double extent(const HalfEdge& h, bool backwards) const {
    const Uv centre = scaled(at(h, backwards ? 1 : 0));
    double far = 0;
    for (const double x : fractions(h)) far = std::max(far, norm(scaled(at(h, x)) - centre));
    return far;
  }

  std::optional<Error> link() {
    std::vector<std::vector<std::uint32_t>> leaving(count_), arriving(count_);
    for (std::uint32_t i = 0; i < starts_.size(); ++i) {
      leaving[starts_[i]].push_back(i);
      arriving[ends_[i]].push_back(i);
    }
    for (std::size_t p = 0; p < count_; ++p) {
      if (leaving[p].size() != arriving[p].size()) return Error{ErrorCode::Degenerate, "the curves in a face do not meet at their ends"};
      if (leaving[p].size() == 1) {
        join(arriving[p][0], leaving[p][0]);
        continue;
      }
      if (auto bad = link(leaving[p], arriving[p])) return bad;
    }
    return std::nullopt;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    out_.half_edges[a].next = b;
    out_.half_edges[b].previous = a;
  }
  std::optional<Error> link(const std::vector<std::uint32_t>& leaving, const std::vector<std::uint32_t>& arriving) {
    double radius = infinity;
    for (const std::uint32_t i : leaving) radius = std::min(radius, 0.3 * extent(out_.half_edges[i], false));
    for (const std::uint32_t i : arriving) radius = std::min(radius, 0.3 * extent(out_.half_edges[i], true));
    struct Ray {
      double angle;
      std::uint32_t index;
    };
    std::vector<Ray> out;
    for (const std::uint32_t i : leaving) out.push_back({angle(out_.half_edges[i], false, radius), i});
    std::vector<bool> taken(out.size(), false);
    constexpr double same = 1e-9;
    for (const std::uint32_t i : arriving) {
      const HalfEdge& h = out_.half_edges[i];
      const double back = angle(h, true, radius);
      // The first one clockwise from where h comes from; its own other side comes last.
      std::size_t best = out.size();
      double least = infinity;
      for (std::size_t k = 0; k < out.size(); ++k) {
        const HalfEdge& g = out_.half_edges[out[k].index];
        const bool twin = g.use.segment != none && g.use.segment == h.use.segment && g.use.reversed != h.use.reversed &&
                          std::abs(std::remainder(back - out[k].angle, two_pi)) < 1e-6;
        double turn = std::fmod(back - out[k].angle + 2 * two_pi, two_pi);
        if (twin) turn = two_pi;
        else if (turn < same || turn > two_pi - same)
          return Error{ErrorCode::Degenerate, "two curves in a face leave a point in one direction"};
        if (turn < least) least = turn, best = k;
      }
      if (taken[best]) return Error{ErrorCode::Degenerate, "the order of curves about a point is not decided"};
      taken[best] = true;
      join(i, out[best].index);
    }
    return std::nullopt;
  }

  // ---- Cycles

  Result<FacePieces> pieces() {
    std::vector<bool> seen(out_.half_edges.size(), false);
    struct Cycle {
      std::uint32_t first;
      std::vector<Uv> at;
      double area;
    };
    std::vector<Cycle> outer, holes;
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      if (seen[i]) continue;
      for (std::uint32_t k = i; !seen[k]; k = out_.half_edges[k].next) seen[k] = true;
      Cycle c{i, polygon(out_.half_edges, i), 0};
      for (Uv& p : c.at) p = scaled(p);
      c.area = area_of(c.at);
      (c.area > 0 ? outer : holes).push_back(std::move(c));
    }
    std::vector<std::vector<std::vector<Uv>>> rings(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i) {
      FacePieces::Piece piece;
      piece.cycles = {outer[i].first};
      rings[i] = {outer[i].at};
      out_.pieces.push_back(std::move(piece));
    }
    for (Cycle& hole : holes) {
      std::size_t best = outer.size();
      const Uv inside = scaled(at(out_.half_edges[hole.first], 0.5));
      for (std::size_t i = 0; i < outer.size(); ++i)
        if (contains(outer[i].at, inside) && !is_border_of(hole.first, outer[i].first) &&
            (best == outer.size() || outer[i].area < outer[best].area))
          best = i;
      if (best == outer.size()) return fail(ErrorCode::Degenerate, "a hole of a face lies in no piece of it");
      out_.pieces[best].cycles.push_back(hole.first);
      rings[best].push_back(std::move(hole.at));
    }
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const std::vector<Uv> inside = points_inside(rings[i]);
      if (inside.empty()) return fail(ErrorCode::Degenerate, "a piece of a face has no inside");
      constexpr std::size_t enough = 8;
      for (std::size_t k = 0; k < std::min(inside.size(), enough); ++k)
        out_.pieces[i].inner.push_back({inside[k].u / scale_.u, inside[k].v / scale_.v});
    }
    return std::move(out_);
  }
  // The cycle about the other side of the same curve does not contain it.
  bool is_border_of(std::uint32_t half_edge, std::uint32_t cycle) const {
    const Use& use = out_.half_edges[half_edge].use;
    std::uint32_t k = cycle;
    do {
      if (use.segment != none && out_.half_edges[k].use.segment == use.segment) return true;
      k = out_.half_edges[k].next;
    } while (k != cycle);
    return false;
  }

  const Network& network_;
  const FaceNet& net_;
  const Uv scale_;
  FacePieces out_;
  std::vector<std::size_t> starts_, ends_;
  std::map<NodeIndex, std::vector<std::pair<Uv, std::size_t>>> places_;
  std::size_t count_ = 0;
};

}  // namespace

Result<FacePieces> arrange(const Network& network, const FaceOf& face, const FaceNet& net) {
  return Arranger(network, face, net).run();
}

Uv start_of(const HalfEdge& h) { return at(h, 0); }
Uv end_of(const HalfEdge& h) { return at(h, 1); }

std::vector<Uv> polygon(const std::vector<HalfEdge>& half_edges, std::uint32_t cycle) {
  std::vector<Uv> out;
  std::uint32_t k = cycle;
  do {
    const std::vector<double> stops = fractions(half_edges[k]);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) out.push_back(at(half_edges[k], stops[i]));
    k = half_edges[k].next;
  } while (k != cycle && k != none);
  return out;
}

double area_of(const std::vector<Uv>& p) {
  double twice = 0;
  for (std::size_t i = 2; i < p.size(); ++i) twice += cross(p[i - 1] - p[0], p[i] - p[0]);
  return twice / 2;
}

bool contains(const std::vector<Uv>& polygon, Uv p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Uv a = polygon[j], b = polygon[i];
    if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
  }
  return inside;
}

std::vector<Uv> points_inside(const std::vector<std::vector<Uv>>& polygons) {
  Interval v{infinity, -infinity};
  for (const Uv p : polygons.front()) v = {std::min(v.lo, p.v), std::max(v.hi, p.v)};
  struct Candidate {
    double room;
    Uv at;
  };
  std::vector<Candidate> found;
  for (const double x : {0.5123, 0.2617, 0.7431, 0.1171, 0.8793, 0.3779, 0.6257, 0.0453, 0.9561}) {
    const double level = v.at(x);
    std::vector<double> hits;
    for (const std::vector<Uv>& polygon : polygons)
      for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Uv a = polygon[j], b = polygon[i];
        if ((a.v > level) != (b.v > level)) hits.push_back(a.u + (level - a.v) / (b.v - a.v) * (b.u - a.u));
      }
    std::sort(hits.begin(), hits.end());
    for (std::size_t i = 0; i + 1 < hits.size(); i += 2)
      if (hits[i + 1] > hits[i])
        for (const double part : {0.4937, 0.3127, 0.7081})  // not in the middle, where symmetric shapes touch
          found.push_back({hits[i + 1] - hits[i], {Interval{hits[i], hits[i + 1]}.at(part), level}});
  }
  for (Candidate& c : found)
    for (const std::vector<Uv>& polygon : polygons)
      for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Uv a = polygon[j], d = polygon[i] - a;
        const double length2 = dot(d, d), t = length2 > 0 ? Interval{0, 1}.clamp(dot(c.at - a, d) / length2) : 0;
        c.room = std::min(c.room, norm(c.at - (a + t * d)));
      }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.room > b.room; });
  std::vector<Uv> out;
  for (const Candidate& c : found) out.push_back(c.at);
  return out;
}

}  // namespace trimloop::boolean
