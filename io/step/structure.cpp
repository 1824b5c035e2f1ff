// Which definitions the file needs: parts, and parts at another scale.

#include <fmt/format.h>

#include <cmath>

#include "io/step/product_writer.h"

namespace trimloop::io::step_export {

namespace {

// A matrix k R with R a rotation: k < 0 for mirrors, since every mirror is the one through the origin after a rotation,
// and that one commutes with all that is linear.
struct Decomposed {
  double scale = 1;
  Frame rotation;
};

Decomposed decompose(const Transform& t) {
  Decomposed out;
  out.scale = std::abs(scale_factor(t));
  if (std::abs(out.scale - 1) <= 1e-9) out.scale = 1;
  if (determinant(t) < 0) out.scale = -out.scale;
  const auto column = [&](int c) { return Vector{t.r[0][c], t.r[1][c], t.r[2][c]}; };
  const Vector z = column(2) / out.scale, x = column(0) / out.scale;
  const bool exact = std::abs(out.scale) == 1 && deviation_from_similarity(t) == 0;
  out.rotation = exact ? Frame{{}, x, column(1) / out.scale, z} : make_frame({}, z, x);
  return out;
}

}  // namespace

Result<Structure> structure_of(const Model& model, std::size_t max_definitions, std::vector<std::string>& losses) {
  Structure s;
  std::map<std::pair<std::uint32_t, double>, std::uint32_t> known;
  const auto definition = [&](std::uint32_t part, double scale) {
    const auto [at, fresh] = known.try_emplace({part, scale}, static_cast<std::uint32_t>(s.definitions.size()));
    if (fresh) s.definitions.push_back({part, scale});
    return at->second;
  };
  if (!model.parts.empty()) definition(0, 1);
  std::vector<std::uint32_t> pending;
  std::vector<std::vector<std::uint32_t>> users;
  for (std::uint32_t d = 0; d < s.definitions.size(); ++d) {
    if (s.definitions.size() > max_definitions) {
      return fail(ErrorCode::Limit, "scaled and mirrored occurrences need too many definitions",
                  double(s.definitions.size()), double(max_definitions));
    }
    const Definition here = s.definitions[d];
    s.places.emplace_back();
    pending.push_back(0);
    for (const Instance& i : model.parts[here.part].instances) {
      const double det = determinant(i.transform);
      if (!(std::abs(det) > 0) || !std::isfinite(det)) {
        losses.push_back(fmt::format("an occurrence of {}: its placement flattens it", model.parts[i.part].name));
        continue;
      }
      const Decomposed t = decompose(i.transform);
      // k T = T' k with the same rotation and the shift times k.
      double scale = here.scale * t.scale;
      if (std::abs(std::abs(scale) - 1) <= 1e-9) scale = scale < 0 ? -1 : 1;
      Place place{definition(i.part, scale), t.rotation, &i};
      place.frame.origin = to_point(here.scale * i.transform.t);
      s.places[d].push_back(place);
      ++pending[d];
    }
  }
  users.resize(s.definitions.size());
  for (std::uint32_t d = 0; d < s.definitions.size(); ++d) {
    for (const Place& p : s.places[d]) users[p.definition].push_back(d);
    if (s.places[d].empty()) s.leaves_first.push_back(d);
  }
  for (std::size_t next = 0; next < s.leaves_first.size(); ++next) {
    for (const std::uint32_t user : users[s.leaves_first[next]]) {
      if (--pending[user] == 0) s.leaves_first.push_back(user);
    }
  }
  return s;
}

}  // namespace trimloop::io::step_export
