#include "kernel/subdivision/limit.h"

#include <fmt/format.h>

#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision {

namespace {

using detail::Mean;

bool all_quads(const ControlMesh& mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (mesh.face(f).size() != 4) return false;
  return true;
}

// Creases that end after some rounds are carried out; what is left is smooth or sharp for ever.
Result<ControlMesh> settled(const ControlMesh& mesh, Scheme scheme) {
  Result<ControlMesh> out = mesh;
  const auto unsettled = [](const ControlMesh& m) {
    for (const Crease& c : m.creases)
      if (c.sharpness > 0 && std::isfinite(c.sharpness)) return true;
    return false;
  };
  while (out && unsettled(*out)) out = refined(*out, scheme);
  if (out && scheme == Scheme::CatmullClark && !all_quads(*out)) out = refined(*out, scheme);
  return out;
}

// Where sharp edges pass, the point on their cubic B-spline (1, 4, 1) / 6; nothing when the smooth rule holds.
std::optional<Point> sharp_limit(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  if (adj.fixed[v]) return mesh.points[v];
  std::vector<Point> far;
  for (const std::uint32_t h : outgoing(adj, v))
    if (detail::sharpness(adj, adj.edge[h]) > 0) far.push_back(mesh.points[mesh.corners[adj.next[h]]]);
  if (adj.border_in[v] != Adjacency::none) far.push_back(mesh.points[mesh.corners[adj.border_in[v]]]);
  if (far.size() < 2) return std::nullopt;
  if (far.size() > 2) return mesh.points[v];
  Mean mean;
  mean.add(4, mesh.points[v]);
  mean.add(1, far[0]);
  mean.add(1, far[1]);
  return mean.point();
}

LimitPoint catmull_clark_limit(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  const auto around = outgoing(adj, v);
  const double n = static_cast<double>(around.size());
  const double along = 1 + std::cos(two_pi / n) + std::cos(pi / n) * std::sqrt(2 * (9 + std::cos(two_pi / n)));
  Mean mean;
  mean.add(n * n, mesh.points[v]);
  Vector t1{}, t2{};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::uint32_t h = around[i];
    const Point edge = mesh.points[mesh.corners[adj.next[h]]], face = mesh.points[mesh.corners[adj.next[adj.next[h]]]];
    mean.add(4, edge);
    mean.add(1, face);
    const auto turn = [&](double by) { return two_pi * (static_cast<double>(i) + by) / n; };
    const Vector e = edge - mesh.points[v], f = face - mesh.points[v];
    t1 += (along * std::cos(turn(0))) * e + (std::cos(turn(0)) + std::cos(turn(1))) * f;
    t2 += (along * std::sin(turn(0))) * e + (std::sin(turn(0)) + std::sin(turn(1))) * f;
  }
  return {mean.point(), normalized(cross(t1, t2))};
}

LimitPoint loop_limit(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  const auto around = outgoing(adj, v);
  const double n = static_cast<double>(around.size());
  const double share = 1 / (3 / (8 * loop_beta(around.size())) + n);
  Mean mean;
  mean.add(1 - n * share, mesh.points[v]);
  Vector t1{}, t2{};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Point p = mesh.points[mesh.corners[adj.next[around[i]]]];
    mean.add(share, p);
    const double turn = two_pi * static_cast<double>(i) / n;
    t1 += std::cos(turn) * (p - mesh.points[v]);
    t2 += std::sin(turn) * (p - mesh.points[v]);
  }
  return {mean.point(), normalized(cross(t1, t2))};
}

}  // namespace

Result<std::vector<LimitPoint>> limit_points(const ControlMesh& mesh, Scheme scheme) {
  std::vector<LimitPoint> out;
  if (scheme == Scheme::DooSabin || scheme == Scheme::DooSabinMidpoint) {
    if (auto adj = adjacency(mesh); !adj) return tl::unexpected(adj.error());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) out.push_back({detail::face_centre(mesh, f), {}});
    return out;
  }
  if (scheme != Scheme::CatmullClark && scheme != Scheme::Loop && scheme != Scheme::Butterfly)
    return fail(ErrorCode::Unsupported, fmt::format("{} has no closed form for its limit here", to_string(scheme)));
  const auto fine = settled(mesh, scheme);
  if (!fine) return tl::unexpected(fine.error());
  const auto adj = adjacency(*fine);
  if (!adj) return tl::unexpected(adj.error());
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {  // a finer mesh keeps the control points' numbers
    if (adj->out[v] == Adjacency::none || scheme == Scheme::Butterfly) out.push_back({fine->points[v], {}});
    else if (const auto sharp = sharp_limit(*fine, *adj, v)) out.push_back({*sharp, {}});
    else out.push_back(scheme == Scheme::CatmullClark ? catmull_clark_limit(*fine, *adj, v) : loop_limit(*fine, *adj, v));
  }
  return out;
}

}  // namespace trimloop::subdivision
