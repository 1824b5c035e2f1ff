#include "kernel/boolean/boolean.h"

#include "kernel/boolean/prepare.h"
#include "kernel/boolean/standing.h"
#include "kernel/boolean/whole.h"
#include "kernel/closest/closest.h"

namespace trimloop {
namespace {

using namespace boolean;

bool is_kept(BooleanOperation operation, int operand, Standing s) {
  switch (operation) {
    case BooleanOperation::Union: return s == Standing::Outside || (s == Standing::Same && operand == 0);
    case BooleanOperation::Intersection: return s == Standing::Inside || (s == Standing::Same && operand == 0);
    case BooleanOperation::Difference:
      return operand == 0 ? s == Standing::Outside || s == Standing::Opposed : s == Standing::Inside;
  }
  return false;
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
    auto standing = standings(prepared, static_cast<std::size_t>(k), [&](Point p) { return side_of(other, p); });
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

std::optional<std::size_t> solid_at(const std::vector<Body>& solids, Point p, double tolerance_mm) {
  std::optional<std::size_t> best;
  double least = tolerance_mm;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const auto operand = Operand::make(solids[i], std::max(1e-9 * size_of(solids[i]), 2 * largest_gap(solids[i])));
    if (!operand) continue;
    if (const auto side = side_of(*operand, p); side && *side == Side::Inside) return i;
    for (const FaceOf& f : operand->faces())
      if (const auto face = ClosestOnFace::make(solids[i], f.id))
        if (const double d = face->nearest(p).distance; d <= least) least = d, best = i;
  }
  return best;
}

}  // namespace trimloop
