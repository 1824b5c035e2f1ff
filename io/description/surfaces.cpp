#include <fmt/format.h>

#include <algorithm>

#include "io/description/shapes.h"
#include "kernel/nurbs/construct_blend.h"
#include "kernel/nurbs/construct_surface.h"
#include "kernel/patches/developable.h"
#include "kernel/patches/n_sided.h"
#include "kernel/patches/triangle_bezier.h"
#include "kernel/splines/beta_spline.h"
#include "kernel/subdivision/schemes.h"

namespace trimloop::io::description {

namespace {

using Made = std::optional<SurfaceShape>;

constexpr double closing_tolerance_mm = 1e-6;  // of curves that a surface is made to pass through
constexpr int most_rulings = 10'000;           // of a developable strip

Made made(Fields& f, Result<NurbsSurface> surface, double bound = 0) {
  if (!f.good()) return std::nullopt;
  if (!surface) {
    f.impossible(surface.error());
    return std::nullopt;
  }
  return SurfaceShape{{std::move(*surface)}, bound};
}

Made bezier(Fields& f) {
  const Fields::Net net = f.net("points");
  const auto w = f.net_numbers_or_none("weights", net);
  if (f.good() && (net.rows < 2 || net.columns < 2)) f.wrong("points", "a patch has at least two rows and two columns");
  if (!f.good()) return std::nullopt;
  const auto knots = [](std::size_t n) {
    std::vector<double> k(n, 0.0);
    k.insert(k.end(), n, 1.0);
    return k;
  };
  return made(f, NurbsSurface::from_cartesian(static_cast<int>(net.rows) - 1, static_cast<int>(net.columns) - 1, knots(net.rows),
                                              knots(net.columns), net.points, w));
}

// Rows and columns as the seed wraps them (001 §8.2.2): repeated at the ends, or periodic.
void end_conditions(Fields::Net& net, std::vector<double>& w, std::size_t u, std::size_t v, int degree_u, int degree_v) {
  const auto index = [](std::size_t kind, std::size_t n, int degree) {
    std::vector<std::size_t> order;
    const auto p = static_cast<std::size_t>(degree);
    if (kind == 1) order.assign(p - 1, 0);
    for (std::size_t i = 0; i < n; ++i) order.push_back(i);
    if (kind == 1) order.insert(order.end(), p - 1, n - 1);
    if (kind == 2)
      for (std::size_t i = 0; i < p; ++i) order.push_back(i % n);
    return order;
  };
  const auto rows = index(u, net.rows, degree_u), columns = index(v, net.columns, degree_v);
  Fields::Net out{rows.size(), columns.size(), {}};
  std::vector<double> weights;
  for (const std::size_t i : rows)
    for (const std::size_t j : columns) {
      out.points.push_back(net.points[i * net.columns + j]);
      if (!w.empty()) weights.push_back(w[i * net.columns + j]);
    }
  net = std::move(out);
  w = std::move(weights);
}

Made nurbs(Fields& f) {
  const int degree_u = f.integer_or("degree_u", 3, 1, 64), degree_v = f.integer_or("degree_v", 3, 1, 64);
  Fields::Net net = f.net("points");
  auto w = f.net_numbers_or_none("weights", net);
  const std::size_t wrap_u = f.choice("wrap_u", {"none", "repeated", "periodic"}), wrap_v = f.choice("wrap_v", {"none", "repeated", "periodic"});
  if (!f.good()) return std::nullopt;
  end_conditions(net, w, wrap_u, wrap_v, degree_u, degree_v);
  const auto knots = [&f](std::size_t wrap, std::string_view name, std::string_view ends, int degree, std::size_t count) {
    if (wrap == 0) return knots_of(f, name, ends, degree, count);
    std::vector<double> uniform;
    for (std::size_t i = 0; i < count + static_cast<std::size_t>(degree) + 1; ++i) uniform.push_back(static_cast<double>(i) - degree);
    return uniform;
  };
  auto knots_u = knots(wrap_u, "knots_u", "ends_u", degree_u, net.rows);
  auto knots_v = knots(wrap_v, "knots_v", "ends_v", degree_v, net.columns);
  if (!f.good()) return std::nullopt;
  return made(f, NurbsSurface::from_cartesian(degree_u, degree_v, std::move(knots_u), std::move(knots_v), net.points, w));
}

Made beta(Fields& f) {
  const Fields::Net net = f.net("points");
  const BetaShape shape{f.number_or("bias", 1), f.number_or("tension", 0)};
  if (!f.good()) return std::nullopt;
  return made(f, beta_spline(net.points, net.rows, net.columns, shape, shape));
}

Made bilinear_patch(Fields& f) {
  const auto p = f.points("corners", 4);
  if (f.good() && p.size() != 4) f.wrong("corners", "four corners in order around the patch", static_cast<double>(p.size()), 4);
  if (!f.good()) return std::nullopt;
  return made(f, bilinear(p[0], p[1], p[3], p[2]));
}

Made ruled_patch(Fields& f) {
  const auto a = curve_member(f, "first"), b = curve_member(f, "second");
  if (!a || !b) return std::nullopt;
  return made(f, ruled(*a, *b));
}

// Rulings whose end tangents lie in one plane; where a curve has none the strip could not be bent from a sheet.
Made developable(Fields& f) {
  const auto a = curve_member(f, "first"), b = curve_member(f, "second");
  const int rulings = f.integer_or("rulings", 65, 2, most_rulings);
  if (!a || !b || !f.good()) return std::nullopt;
  auto strip = developable_strip(*a, *b, rulings);
  if (!strip) return made(f, tl::unexpected(strip.error()));
  if (strip->unmatched > 0) {
    f.wrong("second", fmt::format("{} of {} rulings find no partner whose tangent lies in one plane with theirs", strip->unmatched, rulings),
            static_cast<double>(strip->unmatched), 0);
    return std::nullopt;
  }
  return made(f, std::move(strip->surface), strip->curve_miss);
}

Made extrusion(Fields& f) {
  const auto c = curve_member(f, "curve");
  const Vector d = to_vector(f.point("direction"));
  if (f.good() && norm(d) == 0) f.wrong("direction", "the direction has no length", 0, 0);
  if (!c) return std::nullopt;
  return made(f, extruded(*c, d));
}

Made cone_over(Fields& f) {
  const auto c = curve_member(f, "curve");
  const Point apex = f.point("apex");
  if (!c) return std::nullopt;
  return made(f, cone(*c, {apex.x, apex.y, apex.z, 1}));
}

Made translated(Fields& f) {
  const auto a = curve_member(f, "first"), b = curve_member(f, "second");
  if (!a || !b) return std::nullopt;
  return made(f, translational(*a, *b));
}

Made revolution(Fields& f) {
  const auto c = curve_member(f, "curve");
  const Point origin = f.point_or("origin", {});
  const Vector axis = to_vector(f.point_or("axis", {0, 0, 1}));
  const double start = f.number_or("start_deg", 0), end = f.number_or("end_deg", start + 360);
  if (f.good() && !(end > start && end - start <= 360)) f.wrong("end_deg", "the turn runs upwards by at most 360", end, start + 360);
  if (!c || !f.good()) return std::nullopt;
  return made(f, revolved(*c, origin, axis, {start * pi / 180, end * pi / 180}));
}

Made coons_patch(Fields& f) {
  const auto bottom = curve_member(f, "bottom"), top = curve_member(f, "top"), left = curve_member(f, "left"), right = curve_member(f, "right");
  if (!bottom || !top || !left || !right) return std::nullopt;
  auto patch = coons(*bottom, *top, *left, *right, closing_tolerance_mm);
  if (!patch) return made(f, tl::unexpected(patch.error()));
  return made(f, std::move(patch->surface), patch->largest_miss);
}

Made sweep(Fields& f) {
  const auto section = curve_member(f, "section"), path = curve_member(f, "path");
  const Frames frames = f.choice("frames", {"following", "parallel"}) == 0 ? Frames::Following : Frames::Parallel;
  const double tolerance = f.has("tolerance") ? f.positive("tolerance") : 1e-4;
  if (!section || !path || !f.good()) return std::nullopt;
  auto surface = swept(*section, *path, frames, tolerance);
  if (!surface) return made(f, tl::unexpected(surface.error()));
  return made(f, std::move(surface->surface), surface->deviation);
}

std::optional<std::vector<NurbsCurve>> curves(Fields& f, std::string_view name) {
  std::vector<NurbsCurve> out;
  for (Fields& inner : f.objects(name, 2)) {
    auto c = described_curve(inner);
    if (!c) return std::nullopt;
    out.push_back(std::move(*c));
  }
  return out;
}

Made skin(Fields& f) {
  const auto sections = curves(f, "sections");
  const int degree = f.integer_or("degree", 3, 1, 25);
  if (!sections || !f.good()) return std::nullopt;
  auto surface = skinned(*sections, std::min(degree, static_cast<int>(sections->size()) - 1));
  if (!surface) return made(f, tl::unexpected(surface.error()));
  return made(f, std::move(surface->surface), surface->error);
}

Made gordon_net(Fields& f) {
  const auto along_u = curves(f, "along_u"), along_v = curves(f, "along_v");
  const auto u = f.numbers("u"), v = f.numbers("v");
  if (!along_u || !along_v || !f.good()) return std::nullopt;
  auto surface = gordon(*along_u, v, *along_v, u, closing_tolerance_mm);
  if (!surface) return made(f, tl::unexpected(surface.error()));
  return made(f, std::move(surface->surface), surface->largest_miss);
}

Made interpolated(Fields& f) {
  const Fields::Net net = f.net("points");
  const int degree_u = f.integer_or("degree_u", 3, 1, 25), degree_v = f.integer_or("degree_v", 3, 1, 25);
  if (!f.good()) return std::nullopt;
  auto fit = interpolate_net(net.points, net.columns, degree_u, degree_v);
  if (!fit) return made(f, tl::unexpected(fit.error()));
  return made(f, std::move(fit->surface));
}

Made triangle(Fields& f) {
  const int degree = f.integer("degree", 1, 32);
  const auto points = f.points("points", 3);
  const auto w = f.numbers_or_none("weights");
  const bool quads = f.choice("form", {"collapsed", "three-quads"}) == 1;
  if (!f.good()) return std::nullopt;
  const auto patch = TriangleBezier::from_cartesian(degree, points, w);
  if (!patch) return made(f, tl::unexpected(patch.error()));
  if (!quads) return SurfaceShape{{to_collapsed_quad(*patch)}, 0};
  const auto thirds = to_three_quads(*patch);
  return SurfaceShape{{thirds.begin(), thirds.end()}, 0};
}

std::optional<subdivision::ControlMesh> control_mesh(Fields& f) {
  subdivision::ControlMesh mesh;
  mesh.points = f.points("points", 3);
  const int last = static_cast<int>(mesh.points.size()) - 1;
  for (const auto& face : f.lists("faces", 0, last)) {
    std::vector<std::uint32_t> corners(face.begin(), face.end());
    mesh.add_face(corners);
  }
  if (f.has("creases")) {
    for (Fields& crease : f.objects("creases", 0)) {
      const auto edge = crease.integers_or_none("edge", 0, last);
      if (f.good() && edge.size() != 2) crease.wrong("edge", "an edge has two ends", static_cast<double>(edge.size()), 2);
      const double sharpness = crease.number_or("sharpness", infinity);
      crease.finish();
      if (f.good()) mesh.creases.push_back({static_cast<std::uint32_t>(edge[0]), static_cast<std::uint32_t>(edge[1]), sharpness});
    }
  }
  for (const int v : f.integers_or_none("fixed", 0, last)) mesh.fixed.push_back(static_cast<std::uint32_t>(v));
  if (!f.good()) return std::nullopt;
  return mesh;
}

Made subdivided(Fields& f) {
  using subdivision::Scheme;
  static constexpr Scheme schemes[] = {Scheme::CatmullClark, Scheme::DooSabin, Scheme::Loop, Scheme::Butterfly, Scheme::MidEdge,
                                       Scheme::Sqrt3, Scheme::DooSabinMidpoint};
  const Scheme scheme = schemes[f.choice("scheme", {"catmull-clark", "doo-sabin", "loop", "butterfly", "mid-edge", "sqrt3", "doo-sabin-midpoint"})];
  subdivision::LimitOptions options;
  if (f.has("tolerance")) options.tolerance = f.positive("tolerance");
  const int rounds = f.integer_or("rounds", 0, 0, 12);
  auto mesh = control_mesh(f);
  if (!mesh) return std::nullopt;
  const auto refined = subdivision::refined_times(*mesh, scheme, rounds, 4'000'000);
  if (!refined) return made(f, tl::unexpected(refined.error()));
  SurfaceShape out;
  if (scheme == Scheme::CatmullClark || scheme == Scheme::DooSabin) {
    auto limit = scheme == Scheme::CatmullClark ? catmull_clark_limit(*refined, options) : doo_sabin_limit(*refined, options);
    if (!limit) return made(f, tl::unexpected(limit.error()));
    for (auto& p : limit->patches) out.patches.push_back(std::move(p.surface));
    out.bound_mm = limit->bound;
    return out;
  }
  if (scheme == Scheme::Loop) {
    const auto loop = loop_regular_patches(*refined);
    if (!loop) return made(f, tl::unexpected(loop.error()));
    if (!loop->irregular.empty()) {
      f.wrong("faces", fmt::format("{} faces have an irregular corner or a border, where Loop's limit is no finite set of patches; "
                                   "catmull-clark takes them", loop->irregular.size()),
              static_cast<double>(loop->irregular.size()), 0);
      return std::nullopt;
    }
    for (const TriangleBezier& p : loop->patches)
      for (const NurbsSurface& s : to_three_quads(p)) out.patches.push_back(s);
    return out;
  }
  f.wrong("scheme", "this scheme's limit is no NURBS; catmull-clark and doo-sabin are, and loop where it is regular");
  return std::nullopt;
}

Made n_sided(Fields& f) {
  const auto sides = curves(f, "sides");
  const auto continuity = f.choice("continuity", {"position", "tangent"}) == 0 ? FillContinuity::Position : FillContinuity::Tangent;
  if (!sides || !f.good()) return std::nullopt;
  auto fill = n_sided_fill(*sides, closing_tolerance_mm, continuity);
  if (!fill) return made(f, tl::unexpected(fill.error()));
  return SurfaceShape{std::move(fill->patches), fill->boundary_miss, fill->spoke_angle_rad};
}

struct Maker {
  std::string_view type;
  Made (*make)(Fields&);
};
const Maker makers[] = {{"bezier-surface", bezier}, {"nurbs-surface", nurbs}, {"beta-surface", beta}, {"bilinear", bilinear_patch},
                        {"ruled", ruled_patch}, {"developable", developable}, {"extrusion", extrusion}, {"cone", cone_over}, {"translational", translated},
                        {"revolution", revolution}, {"coons", coons_patch}, {"swept", sweep}, {"skinned", skin}, {"gordon", gordon_net},
                        {"interpolate-surface", interpolated}, {"triangle", triangle}, {"n-sided", n_sided}, {"subdivision", subdivided}};

const Maker* find(std::string_view type) {
  const auto found = std::find_if(std::begin(makers), std::end(makers), [&](const Maker& m) { return m.type == type; });
  return found == std::end(makers) ? nullptr : found;
}

}  // namespace

bool is_surface(std::string_view type) { return find(type) != nullptr; }

Made surface_shape(std::string_view type, Fields& f) { return find(type)->make(f); }

}  // namespace trimloop::io::description
