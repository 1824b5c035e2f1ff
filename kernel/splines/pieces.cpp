#include "kernel/splines/pieces.h"

#include "base/assert.h"

namespace trimloop {

Result<NurbsCurve> join_cubics(std::span<const CubicPiece> pieces, std::span<const Smoothness> joints) {
  TRIMLOOP_ASSERT(!pieces.empty() && joints.size() + 1 == pieces.size(), "one joint between two pieces");
  std::vector<Point> poles{pieces[0].poles[0]};
  std::vector<double> knots(4, 0.0);
  double at = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const CubicPiece& piece = pieces[i];
    at += piece.length;
    poles.push_back(piece.poles[1]);
    poles.push_back(piece.poles[2]);
    const bool last = i + 1 == pieces.size();
    if (last || joints[i] == Smoothness::C0) poles.push_back(piece.poles[3]);
    knots.insert(knots.end(), last ? 4 : joints[i] == Smoothness::C0 ? 3 : 2, at);
  }
  return NurbsCurve::from_cartesian(3, std::move(knots), poles, {});
}

}  // namespace trimloop
