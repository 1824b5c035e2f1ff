#include "kernel/boolean/whole.h"

#include "kernel/boolean/classify.h"
#include "kernel/check/measure.h"

namespace trimloop::boolean {
namespace {

// Copies shells (with what they use) into a body of their own.
class Extractor {
 public:
  explicit Extractor(const Body& from) : from_(from), vertices_(from.vertices.size()), edges_(from.edges.size()) {
    out.attributes = from.attributes;
    out.source = from.source;
    out.kind = BodyKind::Solid;
  }
  void shell(const Shell& s, bool is_void) {
    Shell copy = s;
    copy.is_void = is_void;
    for (Shell::Use& use : copy.faces) use.face = face(use.face);
    out.add(std::move(copy));
  }

  Body out;

 private:
  VertexId vertex(VertexId id) {
    if (!vertices_[id.index]) vertices_[id.index] = out.add(from_[id]);
    return vertices_[id.index];
  }
  EdgeId edge(EdgeId id) {
    if (edges_[id.index]) return edges_[id.index];
    Edge e = from_[id];
    e.start = vertex(e.start), e.end = vertex(e.end);
    return edges_[id.index] = out.add(std::move(e));
  }
  FaceId face(FaceId id) {
    Face f = from_[id];
    for (LoopId& l : f.loops) {
      Loop loop = from_[l];
      for (Coedge& c : loop.coedges) c.edge = edge(c.edge);
      l = out.add(std::move(loop));
    }
    return out.add(std::move(f));
  }

  const Body& from_;
  std::vector<VertexId> vertices_;
  std::vector<EdgeId> edges_;
};

}  // namespace

Body joined(const std::vector<Body>& bodies) {
  Body out = bodies.front();
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Body& b = bodies[i];
    const auto moved = [](auto id, std::size_t by) {
      if (id) id.index += static_cast<std::uint32_t>(by);
      return id;
    };
    const std::size_t v = out.vertices.size(), e = out.edges.size(), l = out.loops.size(), f = out.faces.size();
    for (const Vertex& x : b.vertices) out.add(x);
    for (Edge x : b.edges) {
      x.start = moved(x.start, v), x.end = moved(x.end, v);
      out.add(std::move(x));
    }
    for (Loop x : b.loops) {
      for (Coedge& c : x.coedges) c.edge = moved(c.edge, e);
      out.add(std::move(x));
    }
    for (Face x : b.faces) {
      for (LoopId& id : x.loops) id = moved(id, l);
      out.add(std::move(x));
    }
    for (Shell x : b.shells) {
      for (Shell::Use& use : x.faces) use.face = moved(use.face, f);
      out.add(std::move(x));
    }
    out.source.insert(out.source.end(), b.source.begin(), b.source.end());
  }
  return out;
}

Result<std::vector<Body>> solids_of(const Body& body, double tolerance_mm) {
  std::vector<std::size_t> outer, voids;
  for (std::uint32_t s = 0; s < body.shells.size(); ++s) {
    constexpr double enough = 1e-3;  // for its sign
    const auto v = volume(body, ShellId{s}, enough);
    if (!v) return tl::unexpected<Error>(v.error());
    (v->value > 0 ? outer : voids).push_back(s);
  }
  std::vector<Body> out;
  for (const std::size_t s : outer) {
    Extractor e(body);
    e.shell(body.shells[s], false);
    out.push_back(std::move(e.out));
  }
  if (voids.empty()) return out;
  std::vector<std::vector<std::size_t>> inside(outer.size());
  for (const std::size_t v : voids) {
    const Face& face = body[body.shells[v].faces.front().face];
    const Coedge& c = body[face.loops.front()].coedges.front();
    const Point p = point_at(body, face, c, body[c.edge].range.mid());
    std::size_t best = out.size();
    double least = infinity;
    for (std::size_t o = 0; o < out.size(); ++o) {
      if (out.size() > 1) {
        const auto operand = Operand::make(out[o], tolerance_mm);
        if (!operand) return tl::unexpected<Error>(operand.error());
        const auto side = side_of(*operand, p);
        if (!side || *side == Side::Outside) continue;
      }
      const auto size = volume(out[o], ShellId{0}, 1e-3);
      if (size && size->value < least) least = size->value, best = o;
    }
    if (best == out.size()) return fail(ErrorCode::Degenerate, "a void of the result lies in no solid");
    inside[best].push_back(v);
  }
  for (std::size_t o = 0; o < out.size(); ++o) {
    if (inside[o].empty()) continue;
    Extractor e(body);
    e.shell(body.shells[outer[o]], false);
    for (const std::size_t v : inside[o]) e.shell(body.shells[v], true);
    out[o] = std::move(e.out);
  }
  return out;
}

}  // namespace trimloop::boolean
