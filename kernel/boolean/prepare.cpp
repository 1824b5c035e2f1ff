#include "kernel/boolean/prepare.h"

namespace trimloop::boolean {
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

Result<void> check_closed(const Body& body) {
  if (body.shells.empty()) return fail(ErrorCode::InvalidArgument, "an operand has no shell");
  for (const Shell& s : body.shells)
    if (!s.closed) return fail(ErrorCode::InvalidArgument, "an operand is not a closed solid");
  return {};
}

}  // namespace trimloop::boolean
