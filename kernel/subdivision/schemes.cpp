#include "kernel/subdivision/schemes.h"

#include <fmt/format.h>

#include <array>

#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision {

namespace {

struct Name {
  Scheme scheme;
  std::string_view name;
};
constexpr std::array<Name, 7> names{{{Scheme::CatmullClark, "catmull-clark"},
                                     {Scheme::DooSabin, "doo-sabin"},
                                     {Scheme::DooSabinMidpoint, "doo-sabin-midpoint"},
                                     {Scheme::MidEdge, "mid-edge"},
                                     {Scheme::Loop, "loop"},
                                     {Scheme::Butterfly, "butterfly"},
                                     {Scheme::Sqrt3, "sqrt3"}}};

bool wants_triangles(Scheme s) { return s == Scheme::Loop || s == Scheme::Butterfly || s == Scheme::Sqrt3; }
bool has_creases(Scheme s) { return s == Scheme::CatmullClark || s == Scheme::Loop; }

Result<void> check(const ControlMesh& mesh, Scheme scheme, std::size_t most_corners) {
  if (wants_triangles(scheme)) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      if (mesh.face(f).size() != 3)
        return fail(ErrorCode::InvalidArgument, fmt::format("face {} has {} corners, {} takes triangles", f,
                                                            mesh.face(f).size(), to_string(scheme)),
                    static_cast<double>(mesh.face(f).size()), 3);
  }
  if (!(mesh.creases.empty() && mesh.fixed.empty()) && !has_creases(scheme))
    return fail(ErrorCode::Unsupported, fmt::format("{} has no creases", to_string(scheme)));
  // No scheme makes more than eight corners of one: a quarter face for each corner, and the strips of Doo-Sabin.
  if (mesh.corners.size() > most_corners / 8)
    return fail(ErrorCode::Limit, fmt::format("another round makes more than {} corners", most_corners),
                static_cast<double>(mesh.corners.size()), static_cast<double>(most_corners));
  return {};
}

}  // namespace

std::string_view to_string(Scheme scheme) {
  for (const Name& n : names)
    if (n.scheme == scheme) return n.name;
  return "unknown";
}

std::optional<Scheme> scheme_from_name(std::string_view name) {
  for (const Name& n : names)
    if (n.name == name) return n.scheme;
  return std::nullopt;
}

Result<ControlMesh> refined(const ControlMesh& mesh, Scheme scheme, int round, std::size_t most_corners) {
  if (auto good = check(mesh, scheme, most_corners); !good) return tl::unexpected(good.error());
  const auto adj = adjacency(mesh);
  if (!adj) return tl::unexpected(adj.error());
  switch (scheme) {
    case Scheme::CatmullClark: return detail::catmull_clark(mesh, *adj);
    case Scheme::DooSabin: return detail::doo_sabin(mesh, *adj, false);
    case Scheme::DooSabinMidpoint: return detail::doo_sabin(mesh, *adj, true);
    case Scheme::MidEdge: return detail::mid_edge(mesh, *adj);
    case Scheme::Loop: return detail::loop(mesh, *adj);
    case Scheme::Butterfly: return detail::butterfly(mesh, *adj);
    case Scheme::Sqrt3: return detail::sqrt3(mesh, *adj, round);
  }
  return fail(ErrorCode::InvalidArgument, "no such scheme");
}

Result<ControlMesh> refined_times(const ControlMesh& mesh, Scheme scheme, int rounds, std::size_t most_corners) {
  Result<ControlMesh> out = mesh;
  for (int i = 0; i < rounds && out; ++i) out = refined(*out, scheme, i, most_corners);
  return out;
}

}  // namespace trimloop::subdivision
