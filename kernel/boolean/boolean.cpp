#include "kernel/boolean/boolean.h"

#include <numeric>

#include "kernel/boolean/assemble.h"
#include "kernel/boolean/classify.h"
#include "kernel/boolean/whole.h"
#include "kernel/check/measure.h"
#include "kernel/closest/closest.h"

namespace trimloop {
namespace {

using namespace boolean;

enum class Standing : std::uint8_t { Outside, Inside, Same, Opposed };  // of a piece, towards the other body

// ---- Preparation

double size_of(const Body& body) {
  Box box;
  for (const Vertex& v : body.vertices) box.add(v.point);
  for (const Edge& e : body.edges)
    if (e.curve)
      for (int i = 0; i <= 4; ++i) box.add(evaluate(*e.curve, e.range.at(i / 4.0)));
  return box.empty() ? 0 : std::max({box.diagonal(), norm(to_vector(box.lo)), norm(to_vector(box.hi))});
}
double largest_gap(const Body& body) {
  double gap = 0;
  for (const Vertex& v : body.vertices) gap = std::max(gap, v.gap_mm);
  for (const Loop& l : body.loops)
    for (const Coedge& c : l.coedges) gap = std::max(gap, c.gap_mm);
  return gap;
}

struct Setting {
  Operand a, b;
  Prepared prepared;
};

Result<std::unique_ptr<Setting>> prepare(const Body& a, const Body& b, const BooleanOptions& options) {
  constexpr double relative = 1e-9;
  const double tolerance = options.tolerance_mm > 0
                               ? options.tolerance_mm
                               : std::max(relative * std::max(size_of(a), size_of(b)), 2 * std::max(largest_gap(a), largest_gap(b)));
  if (!(tolerance > 0) || !std::isfinite(tolerance)) return fail(ErrorCode::InvalidArgument, "an operand has no size");
  auto oa = Operand::make(a, tolerance), ob = Operand::make(b, tolerance);
  if (!oa || !ob) return tl::unexpected<Error>(oa ? ob.error() : oa.error());
  auto out = std::make_unique<Setting>(Setting{std::move(*oa), std::move(*ob), {}});
  Prepared& p = out->prepared;
  p.operands = {&out->a, &out->b};
  auto network = make_network(p.operands);
  if (!network) return tl::unexpected<Error>(network.error());
  p.network = std::move(*network);
  for (std::size_t k : {0u, 1u})
    for (std::size_t f = 0; f < p.operands[k]->faces().size(); ++f) {
      auto pieces = arrange(p.network, p.operands[k]->faces()[f], p.network.faces[k][f]);
      if (!pieces) return tl::unexpected<Error>(pieces.error());
      p.faces[k].push_back(std::move(*pieces));
    }
  return out;
}

// ---- Where each piece stands

class Classifier {
 public:
  Classifier(const Prepared& given, std::size_t k) : given_(given), mine_(*given.operands[k]), other_(*given.operands[1 - k]), k_(k) {}

  // Of each piece, by face; pieces that hang together along edges which the other body does not meet stand alike.
  template <class SideOf>
  Result<std::vector<std::vector<Standing>>> run(SideOf side) {
    number();
    connect();
    std::vector<std::optional<Standing>> known(count_);
    std::vector<std::vector<Standing>> out;
    for (std::uint32_t f = 0; f < faces().size(); ++f) {
      out.emplace_back();
      for (std::uint32_t p = 0; p < faces()[f].pieces.size(); ++p) {
        if (const auto on = on_other(f, faces()[f].pieces[p])) {
          out.back().push_back(*on);
          continue;
        }
        std::optional<Standing>& standing = known[root(first_[f] + p)];
        for (const Uv uv : faces()[f].pieces[p].inner) {
          if (standing) break;
          if (const auto s = side(evaluate(*mine_.faces()[f].surface, uv)))
            standing = *s == Side::Inside ? Standing::Inside : Standing::Outside;
        }
        if (!standing) return fail(ErrorCode::Degenerate, "whether a piece of a face lies inside the other body is not decided");
        out.back().push_back(*standing);
      }
    }
    return out;
  }

 private:
  const std::vector<FacePieces>& faces() const { return given_.faces[k_]; }

  void number() {
    for (const FacePieces& f : faces()) {
      first_.push_back(count_);
      count_ += f.pieces.size();
    }
    group_.resize(count_);
    std::iota(group_.begin(), group_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }
  void connect() {
    std::vector<std::size_t> seen(given_.network.segments.size(), count_);
    for (std::size_t f = 0; f < faces().size(); ++f)
      for (std::size_t p = 0; p < faces()[f].pieces.size(); ++p)
        for (const std::uint32_t cycle : faces()[f].pieces[p].cycles) {
          std::uint32_t i = cycle;
          do {
            const HalfEdge& h = faces()[f].half_edges[i];
            if (h.use.segment != none && !given_.network.segments[h.use.segment].meets) {
              std::size_t& with = seen[h.use.segment];
              if (with == count_) with = first_[f] + p;
              else group_[root(first_[f] + p)] = root(with);
            }
            i = h.next;
          } while (i != cycle);
        }
  }

  std::optional<Standing> on_other(std::uint32_t f, const FacePieces::Piece& piece) const {
    for (const std::uint32_t g : given_.network.faces[k_][f].coincident) {
      const FaceOf &mine = mine_.faces()[f], &theirs = other_.faces()[g];
      for (const Uv uv : piece.inner) {
        const Place place = other_.locate(theirs, evaluate(*mine.surface, uv));
        if (place.where == Where::Border) continue;
        if (place.where == Where::Outside) break;
        const double along = dot(normal(*mine.surface, uv), normal(*theirs.surface, place.uv));
        return (along > 0) == (mine.reversed == theirs.reversed) ? Standing::Same : Standing::Opposed;
      }
    }
    return std::nullopt;
  }

  const Prepared& given_;
  const Operand &mine_, &other_;
  const std::size_t k_;
  std::vector<std::size_t> first_, group_;
  std::size_t count_ = 0;
};

// ---- Selection

bool is_kept(BooleanOperation operation, int operand, Standing s) {
  switch (operation) {
    case BooleanOperation::Union: return s == Standing::Outside || (s == Standing::Same && operand == 0);
    case BooleanOperation::Intersection: return s == Standing::Inside || (s == Standing::Same && operand == 0);
    case BooleanOperation::Difference:
      return operand == 0 ? s == Standing::Outside || s == Standing::Opposed : s == Standing::Inside;
  }
  return false;
}

Result<void> check_closed(const Body& body) {
  if (body.shells.empty()) return fail(ErrorCode::InvalidArgument, "an operand has no shell");
  for (const Shell& s : body.shells)
    if (!s.closed) return fail(ErrorCode::InvalidArgument, "an operand is not a closed solid");
  return {};
}

}  // namespace

Result<BooleanResult> combine(const std::vector<Body>& a, const std::vector<Body>& b, BooleanOperation operation,
                              const BooleanOptions& options) {
  BooleanResult out;
  if (a.empty() || b.empty()) {
    if (operation == BooleanOperation::Union) out.bodies = a.empty() ? b : a;
    if (operation == BooleanOperation::Difference) out.bodies = a;
    return out;
  }
  const Body one = joined(a), two = joined(b);
  for (const Body* body : {&one, &two})
    if (auto closed = check_closed(*body); !closed) return tl::unexpected<Error>(closed.error());
  auto setting = prepare(one, two, options);
  if (!setting) return tl::unexpected<Error>(setting.error());
  const Prepared& prepared = (*setting)->prepared;
  std::vector<KeptPiece> kept;
  for (int k : {0, 1}) {
    const Operand& other = *prepared.operands[static_cast<std::size_t>(1 - k)];
    auto standing = Classifier(prepared, static_cast<std::size_t>(k)).run([&](Point p) { return side_of(other, p); });
    if (!standing) return tl::unexpected<Error>(standing.error());
    for (std::uint32_t f = 0; f < standing->size(); ++f)
      for (std::uint32_t p = 0; p < (*standing)[f].size(); ++p)
        if (is_kept(operation, k, (*standing)[f][p]))
          kept.push_back({k, f, p, operation == BooleanOperation::Difference && k == 1});
  }
  out.tolerance_mm = (*setting)->a.tolerance();
  out.bound_mm = prepared.network.bound_mm;
  if (kept.empty()) return out;
  auto body = assemble(prepared, kept);
  if (!body) return tl::unexpected<Error>(body.error());
  for (const Shell& s : body->shells)
    if (!s.closed) return fail(ErrorCode::Degenerate, "the faces of the result do not close");
  body->attributes = one.attributes;
  body->source = one.source;
  body->source.insert(body->source.end(), two.source.begin(), two.source.end());
  auto solids = solids_of(*body, out.tolerance_mm);
  if (!solids) return tl::unexpected<Error>(solids.error());
  out.bodies = std::move(*solids);
  return out;
}

Result<BooleanResult> combine(const Body& a, const Body& b, BooleanOperation operation, const BooleanOptions& options) {
  return combine(std::vector<Body>{a}, std::vector<Body>{b}, operation, options);
}

namespace {

// The side of the nearest face that the point is on.
class NearestFace {
 public:
  explicit NearestFace(const Operand& tool) : tool_(tool) {
    for (const FaceOf& f : tool.faces())
      if (auto c = ClosestOnFace::make(tool.body(), f.id)) faces_.push_back({&f, std::move(*c)});
  }
  std::optional<Side> operator()(Point p) const {
    double nearest = infinity, across = 0;
    for (const auto& [face, closest] : faces_) {
      const ClosestPoint c = closest.nearest(p);
      if (!(c.distance < nearest)) continue;
      nearest = c.distance;
      across = dot(normal(*face->surface, c.uv), p - c.point) * (face->reversed ? -1 : 1);
    }
    if (!(nearest > tool_.tolerance()) || !(std::abs(across) > 1e-6 * nearest)) return std::nullopt;
    return across < 0 ? Side::Inside : Side::Outside;
  }

 private:
  const Operand& tool_;
  std::vector<std::pair<const FaceOf*, ClosestOnFace>> faces_;
};

}  // namespace

Result<BooleanResult> trim(const Body& sheet, const Body& tool, TrimSide keep, const BooleanOptions& options) {
  auto setting = prepare(sheet, tool, options);
  if (!setting) return tl::unexpected<Error>(setting.error());
  const Prepared& prepared = (*setting)->prepared;
  const bool closed = check_closed(tool).has_value();
  const Operand& other = (*setting)->b;
  std::vector<KeptPiece> kept;
  if (keep == TrimSide::Both) {
    for (std::uint32_t f = 0; f < prepared.faces[0].size(); ++f)
      for (std::uint32_t p = 0; p < prepared.faces[0][f].pieces.size(); ++p) kept.push_back({0, f, p, false});
  } else {
    const NearestFace nearest(other);
    auto standing = Classifier(prepared, 0).run([&](Point p) { return closed ? side_of(other, p) : nearest(p); });
    if (!standing) return tl::unexpected<Error>(standing.error());
    const Standing wanted = keep == TrimSide::Inside ? Standing::Inside : Standing::Outside;
    for (std::uint32_t f = 0; f < standing->size(); ++f)
      for (std::uint32_t p = 0; p < (*standing)[f].size(); ++p)
        if ((*standing)[f][p] == wanted || (wanted == Standing::Outside && (*standing)[f][p] >= Standing::Same))
          kept.push_back({0, f, p, false});
  }
  BooleanResult out;
  out.tolerance_mm = (*setting)->a.tolerance();
  out.bound_mm = prepared.network.bound_mm;
  if (kept.empty()) return out;
  auto body = assemble(prepared, kept);
  if (!body) return tl::unexpected<Error>(body.error());
  body->kind = BodyKind::Sheet;
  body->attributes = sheet.attributes;
  body->source = sheet.source;
  out.bodies.push_back(std::move(*body));
  return out;
}

}  // namespace trimloop
