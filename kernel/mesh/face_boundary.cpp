#include "kernel/mesh/face_boundary.h"

namespace trimloop::mesh {
namespace {

// Consecutive coedges whose ends differ by less than this share of the face's box share one point.
constexpr double rounding = 1e-7;

class Collector {
 public:
  Collector(const Body& body, std::span<const SampledEdge> edges, FaceBoundary& out)
      : body_(body), edges_(edges), out_(out) {}

  void add_coedge(const Coedge& c) {
    const SampledEdge& edge = edges_[c.edge.index];
    const std::size_t count = edge.samples.t.size();
    const std::size_t first = out_.uv.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = c.reversed ? count - 1 - k : k;
      const Uv uv = uv_at(body_, c, edge.samples.t[i]);
      out_.finite = out_.finite && is_finite(uv) && is_finite(edge.samples.points[i]);
      out_.uv.push_back(uv);
      out_.point.push_back(edge.points[i]);
      if (k > 0) add_segment(out_.uv.size() - 2, out_.uv.size() - 1, &c, c.reversed ? count - 1 - k : k - 1);
    }
    const Uv run = out_.uv.back() - out_.uv[first];
    const PoleSide side = std::abs(run.u) >= std::abs(run.v) ? PoleSide::AlongU : PoleSide::AlongV;
    out_.pole.resize(out_.uv.size(), body_[c.edge].is_pole ? side : PoleSide::None);
    out_.gap_mm = std::max(out_.gap_mm, c.gap_mm);
    out_.edge_deviation_mm = std::max(out_.edge_deviation_mm, edge.samples.deviation_mm);
  }

  // `coedge` may be null.
  void add_segment(std::size_t a, std::size_t b, const Coedge* coedge, std::size_t chord) {
    out_.segments.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
    out_.chords.push_back({coedge ? coedge->edge : EdgeId{}, static_cast<std::uint32_t>(chord), coedge});
  }

 private:
  const Body& body_;
  std::span<const SampledEdge> edges_;
  FaceBoundary& out_;
};

void measure_box(FaceBoundary& b) {
  b.u = b.v = {infinity, -infinity};
  for (const Uv p : b.uv) {
    b.u = {std::min(b.u.lo, p.u), std::max(b.u.hi, p.u)};
    b.v = {std::min(b.v.lo, p.v), std::max(b.v.hi, p.v)};
  }
}

// The end of one coedge and the start of the next: one point when they differ by rounding only, else a joining segment.
void close(FaceBoundary& b, Collector& collector, std::size_t end, std::size_t start) {
  const Uv gap = b.uv[start] - b.uv[end];
  if (b.pole[end] != PoleSide::None || b.pole[start] != PoleSide::None)
    b.pole[end] = b.pole[start] = std::max(b.pole[end], b.pole[start]);
  if (std::abs(gap.u) <= rounding * b.u.length() && std::abs(gap.v) <= rounding * b.v.length()) {
    b.uv[start] = b.uv[end];  // equal points are merged by the triangulation
  } else {
    collector.add_segment(end, start, nullptr, 0);
  }
}

}  // namespace

void FaceBoundary::clear() {
  uv.clear(), point.clear(), pole.clear(), segments.clear(), chords.clear();
  gap_mm = edge_deviation_mm = 0;
  finite = true;
}

void collect_boundary(const Body& body, const Face& face, std::span<const SampledEdge> edges, FaceBoundary& out) {
  out.clear();
  Collector collector(body, edges, out);
  std::vector<std::size_t> starts;  // of each coedge in the arrays
  for (const LoopId loop : face.loops) {
    for (const Coedge& coedge : body[loop].coedges) {
      starts.push_back(out.uv.size());
      collector.add_coedge(coedge);
    }
  }
  starts.push_back(out.uv.size());
  measure_box(out);
  std::size_t k = 0;
  for (const LoopId loop : face.loops) {
    const std::size_t first = k, count = body[loop].coedges.size();
    for (std::size_t i = 0; i < count; ++i, ++k) close(out, collector, starts[k + 1] - 1, starts[first + (i + 1) % count]);
  }
}

}  // namespace trimloop::mesh
