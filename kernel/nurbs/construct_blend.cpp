#include "kernel/nurbs/construct_blend.h"

#include <fmt/format.h>

#include "kernel/nurbs/construct_surface.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/fit_detail.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/reparametrize.h"

namespace trimloop {
namespace {

// Mean over pole columns of their chord-length parameters (eq. 10.8).
std::vector<double> section_parameters(const std::vector<NurbsCurve>& sections) {
  std::vector<double> mean(sections.size(), 0.0);
  double used = 0;
  for (std::size_t j = 0; j < sections[0].poles().size(); ++j) {
    std::vector<Point> column;
    for (const NurbsCurve& c : sections) column.push_back(project(c.poles()[j]));
    const std::vector<double> t = parameters_of(column, Spacing::ChordLength);
    if (!(t.back() > 0) || !is_finite(column.front())) continue;
    used += 1;
    for (std::size_t k = 0; k < t.size(); ++k) mean[k] += (t[k] - mean[k]) / used;
  }
  if (!mean.empty()) mean.back() = used > 0 ? 1 : 0;
  return mean;
}

Result<void> check_ascending(std::span<const double> t, std::size_t count, const char* what) {
  if (t.size() != count)
    return fail(ErrorCode::InvalidArgument, fmt::format("there are {} parameters for {} {}", t.size(), count, what));
  for (std::size_t i = 1; i < t.size(); ++i)
    if (!(t[i - 1] < t[i]))
      return fail(ErrorCode::Degenerate,
                  fmt::format("{} {} and {} have parameters {} and {}", what, i - 1, i, t[i - 1], t[i]));
  return {};
}

// Homogeneous interpolation across curves that are compatible: rows along v.
Result<NurbsSurface> across(const std::vector<NurbsCurve>& sections, int degree_v, std::span<const double> v) {
  const std::size_t n = sections[0].poles().size(), m = sections.size();
  std::vector<Hpoint> right(m * n);  // row k is section k
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t i = 0; i < n; ++i) right[k * n + i] = sections[k].poles()[i];
  const std::vector<double> knots = detail::averaged_knots(v, degree_v);
  if (!detail::collocate(degree_v, knots, {{v.begin(), v.end()}, std::vector<int>(m, 0)}, right, n))
    return fail(ErrorCode::Degenerate, "the sections are spaced too unevenly to be interpolated");
  std::vector<Hpoint> poles(right.size());
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t i = 0; i < n; ++i) poles[i * m + k] = right[k * n + i];
  bool rational = false, positive = true;
  for (const NurbsCurve& c : sections) rational = rational || c.is_rational();
  for (Hpoint& h : poles) {
    if (!rational) h.w = 1;
    positive = positive && h.w > 0;
  }
  if (!positive)
    return fail(ErrorCode::Unsupported, "interpolating the weights of the sections gives one that is not positive");
  return NurbsSurface::from_homogeneous(sections[0].degree(), degree_v, sections[0].knots(), knots, std::move(poles));
}

// Surfaces over one degree and one set of knots in u.
void to_common_u(std::vector<NurbsSurface>& all) {
  int degree = 1;
  for (const NurbsSurface& s : all) degree = std::max(degree, s.degree_u());
  std::vector<double> knots;
  for (NurbsSurface& s : all) {
    s = elevate(s, degree - s.degree_u(), 0);
    std::vector<double> joined;
    std::set_union(knots.begin(), knots.end(), s.knots_u().begin(), s.knots_u().end(), std::back_inserter(joined));
    knots = std::move(joined);
  }
  for (NurbsSurface& s : all) {
    std::vector<double> missing;
    std::set_difference(knots.begin(), knots.end(), s.knots_u().begin(), s.knots_u().end(),
                        std::back_inserter(missing));
    s = refine_u(s, missing);
  }
}

// a + b - c of homogeneous points.
Result<NurbsSurface> boolean_sum(NurbsSurface a, NurbsSurface b, NurbsSurface c) {
  std::vector<NurbsSurface> all{std::move(a), std::move(b), std::move(c)};
  for (int turn = 0; turn < 2; ++turn) {
    to_common_u(all);
    for (NurbsSurface& s : all) s = swapped(s);
  }
  std::vector<Hpoint> poles;
  for (std::size_t i = 0; i < all[0].poles().size(); ++i)
    poles.push_back(all[0].poles()[i] + all[1].poles()[i] - all[2].poles()[i]);
  if (!all[0].is_rational() && !all[1].is_rational())
    for (Hpoint& h : poles) h.w = 1;
  return NurbsSurface::from_homogeneous(all[0].degree_u(), all[0].degree_v(), all[0].knots_u(), all[0].knots_v(),
                                        std::move(poles));
}

NurbsCurve over_unit(const NurbsCurve& c) { return reparametrized(trimmed(c, c.range()), {0, 1}); }

// ---- Frames along a path

struct Placed {
  Point origin;
  Vector tangent, normal;
};

// Double reflection from one sample to the next; exact enough at many samples, fourth order in their distance.
std::vector<Placed> minimizing_frames(const NurbsCurve& path, int count) {
  std::vector<Placed> out;
  for (int i = 0; i < count; ++i) {
    const CurveJet j = jet(path, path.range().at(i / double(count - 1)));
    Placed next{j.point, normalized(j.d1), {}};
    if (i == 0) {
      next.normal = make_frame({}, next.tangent).x;
    } else {
      const Placed& last = out.back();
      const Vector v1 = next.origin - last.origin;
      const double c1 = dot(v1, v1);
      Vector n = last.normal, t = last.tangent;
      if (c1 > 0) n = n - 2 / c1 * dot(v1, n) * v1, t = t - 2 / c1 * dot(v1, t) * v1;
      const Vector v2 = next.tangent - t;
      const double c2 = dot(v2, v2);
      next.normal = c2 > 0 ? n - 2 / c2 * dot(v2, n) * v2 : n;
    }
    out.push_back(next);
  }
  return out;
}

// The rigid motion from one frame to another.
Transform motion(const Placed& from, const Placed& to) {
  const Vector a[3] = {from.tangent, from.normal, cross(from.tangent, from.normal)};
  const Vector b[3] = {to.tangent, to.normal, cross(to.tangent, to.normal)};
  Transform m;
  const auto part = [](Vector v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      m.r[i][j] = 0;
      for (const std::size_t k : {0, 1, 2}) m.r[i][j] += part(b[k], i) * part(a[k], j);
    }
  m.t = to_vector(to.origin) - apply(m, to_vector(from.origin));
  return m;
}

// The axis and angle of a path that is one circular arc to 1e-12 of its size; nothing otherwise.
struct Turn {
  Point centre;
  Vector axis;
  double angle_rad;
};
std::optional<Turn> circular(const NurbsCurve& path) {
  constexpr int samples = 32;
  const CurveJet j = jet(path, path.range().mid());
  const Vector b = cross(j.d1, j.d2);
  if (!(norm(b) > 1e-9 * norm(j.d1) * norm(j.d2))) return std::nullopt;
  const Vector axis = normalized(b), side = normalized(cross(axis, j.d1));
  const double radius = std::pow(norm(j.d1), 3) / norm(b);
  const Point centre = j.point + radius * side;
  double angle = 0;
  Vector last = evaluate(path, path.range().lo) - centre;
  for (int i = 0; i <= samples; ++i) {
    const Vector arm = evaluate(path, path.range().at(i / double{samples})) - centre;
    if (std::abs(norm(arm) - radius) > 1e-12 * radius || std::abs(dot(arm, axis)) > 1e-12 * radius) return std::nullopt;
    angle += std::atan2(dot(cross(last, arm), axis), dot(last, arm));
    last = arm;
  }
  if (!(angle > 0) || angle > two_pi * (1 + 1e-12)) return std::nullopt;
  return Turn{centre, axis, std::min(angle, two_pi)};
}

bool straight(const NurbsCurve& path) {
  const Point a = evaluate(path, path.range().lo), b = evaluate(path, path.range().hi);
  const Vector along = normalized(b - a);
  const NurbsCurve active = trimmed(path, path.range());
  for (const Hpoint& h : active.poles())
    if (!(h.w > 0) || norm(cross(along, project(h) - a)) > 1e-14 * distance(a, b)) return false;
  return norm(along) > 0;
}

}  // namespace

Result<Skin> skinned(std::span<const NurbsCurve> given, int degree_v, std::span<const double> parameters) {
  if (given.size() < 2)
    return fail(ErrorCode::InvalidArgument, "a skin needs two sections", static_cast<double>(given.size()), 2);
  if (degree_v < 1 || static_cast<std::size_t>(degree_v) >= given.size() || degree_v > 64)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} sections allow no degree {}", given.size(), degree_v),
                degree_v);
  const std::vector<NurbsCurve> sections = made_compatible(given);
  std::vector<double> v(parameters.begin(), parameters.end());
  if (v.empty()) v = section_parameters(sections);
  if (auto ok = check_ascending(v, sections.size(), "sections"); !ok) return tl::unexpected<Error>(ok.error());
  auto surface = across(sections, degree_v, v);
  if (!surface) return tl::unexpected<Error>(surface.error());
  double error = 0;
  for (std::size_t k = 0; k < v.size(); ++k)
    error = std::max(error, deviation_bound(sections[k], isocurve_v(*surface, v[k]), 0));
  return Skin{std::move(*surface), std::move(v), error};
}

Result<Gordon> gordon(std::span<const NurbsCurve> along_u, std::span<const double> v,
                      std::span<const NurbsCurve> along_v, std::span<const double> u, double tolerance) {
  if (auto ok = check_ascending(v, along_u.size(), "curves along u"); !ok) return tl::unexpected<Error>(ok.error());
  if (auto ok = check_ascending(u, along_v.size(), "curves along v"); !ok) return tl::unexpected<Error>(ok.error());
  if (along_u.size() < 2 || along_v.size() < 2) return fail(ErrorCode::InvalidArgument, "each family needs two curves");
  std::vector<NurbsCurve> rows, columns;
  for (const NurbsCurve& c : along_u) rows.push_back(reparametrized(trimmed(c, c.range()), {u.front(), u.back()}));
  for (const NurbsCurve& c : along_v) columns.push_back(reparametrized(trimmed(c, c.range()), {v.front(), v.back()}));
  for (const auto* family : {&rows, &columns})
    for (const NurbsCurve& c : *family)
      if (c.is_rational()) return fail(ErrorCode::Unsupported, "a Gordon surface is made of polynomial curves");
  double miss = 0;
  std::vector<Point> crossings;
  for (std::size_t l = 0; l < u.size(); ++l)
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Point a = evaluate(rows[k], u[l]), b = evaluate(columns[l], v[k]);
      miss = std::max(miss, distance(a, b));
      crossings.push_back(midpoint(a, b));
    }
  if (!(miss <= tolerance))
    return fail(ErrorCode::Degenerate, "the two families of curves do not meet", miss, tolerance);
  const int q = std::min<int>(3, static_cast<int>(v.size()) - 1), p = std::min<int>(3, static_cast<int>(u.size()) - 1);
  const auto skin_v = across(made_compatible(rows), q, v);
  const auto skin_u = across(made_compatible(columns), p, u);
  if (!skin_v || !skin_u) return tl::unexpected<Error>((skin_v ? skin_u : skin_v).error());
  // The crossings over the same parameters and knots: columns of points as curves of degree q, then across.
  std::vector<NurbsCurve> lines;
  const std::vector<double> knots_v = detail::averaged_knots(v, q);
  for (std::size_t l = 0; l < u.size(); ++l) {
    std::vector<Hpoint> right;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Point& c = crossings[l * v.size() + k];
      right.push_back({c.x, c.y, c.z, 1});
    }
    if (!detail::collocate(q, knots_v, {{v.begin(), v.end()}, std::vector<int>(v.size(), 0)}, right, 1))
      return fail(ErrorCode::Degenerate, "the curves are spaced too unevenly");
    for (Hpoint& h : right) h.w = 1;
    auto line = NurbsCurve::from_homogeneous(q, knots_v, std::move(right));
    if (!line) return tl::unexpected<Error>(line.error());
    lines.push_back(std::move(*line));
  }
  const auto both = across(lines, p, u);
  if (!both) return tl::unexpected<Error>(both.error());
  auto surface = boolean_sum(*skin_v, swapped(*skin_u), swapped(*both));
  if (!surface) return tl::unexpected<Error>(surface.error());
  return Gordon{std::move(*surface), miss};
}

Result<Coons> coons(const NurbsCurve& bottom, const NurbsCurve& top, const NurbsCurve& left, const NurbsCurve& right,
                    double tolerance) {
  std::vector<NurbsCurve> side{over_unit(bottom), over_unit(top), over_unit(left), over_unit(right)};
  for (NurbsCurve& c : side) {
    if (!c.is_rational()) continue;
    auto normal = with_end_weights_one(c);
    if (!normal) return tl::unexpected<Error>(normal.error());
    c = std::move(normal->curve);
  }
  const auto end = [&](std::size_t k, bool last) {
    return project(last ? side[k].poles().back() : side[k].poles().front());
  };
  const Point corner[4][2] = {{end(0, false), end(2, false)},
                              {end(0, true), end(3, false)},
                              {end(1, false), end(2, true)},
                              {end(1, true), end(3, true)}};
  double miss = 0;
  Point mean[4];
  for (std::size_t k = 0; k < 4; ++k) {
    miss = std::max(miss, distance(corner[k][0], corner[k][1]));
    mean[k] = midpoint(corner[k][0], corner[k][1]);
  }
  if (!(miss <= tolerance)) return fail(ErrorCode::Degenerate, "the sides do not meet at the corners", miss, tolerance);
  const auto in_v = ruled(side[0], side[1]), in_u = ruled(side[2], side[3]);
  const auto flat = bilinear(mean[0], mean[1], mean[2], mean[3]);
  if (!in_v || !in_u || !flat) return tl::unexpected<Error>((!in_v ? in_v : !in_u ? in_u : flat).error());
  auto surface = boolean_sum(*in_v, swapped(*in_u), *flat);
  if (!surface) return tl::unexpected<Error>(surface.error());
  return Coons{std::move(*surface), miss};
}

Result<Sweep> swept(const NurbsCurve& section, const NurbsCurve& path, Frames frames, double tolerance,
                    int most_sections) {
  if (frames == Frames::Parallel || straight(path)) {
    auto surface = translational(section, path);
    if (!surface) return tl::unexpected<Error>(surface.error());
    return Sweep{std::move(*surface)};
  }
  if (const auto turn = circular(path)) {
    auto surface = revolved(section, turn->centre, turn->axis, {0, turn->angle_rad});
    if (!surface) return tl::unexpected<Error>(surface.error());
    return Sweep{swapped(*surface)};
  }
  // Frames at four times the sections, so that those in between are there to check with.
  double deviation = infinity;
  for (int count = 5; count <= most_sections; count = 2 * count - 1) {
    const int fine = 4 * (count - 1) + 1;
    const std::vector<Placed> all = minimizing_frames(path, 8 * (fine - 1) + 1);
    const auto placed = [&](int i) {
      return transformed(section, motion(all[0], all[static_cast<std::size_t>(8 * i)]));
    };
    std::vector<NurbsCurve> sections;
    std::vector<double> v;
    for (int i = 0; i < fine; i += 4) {
      if (!(norm(all[static_cast<std::size_t>(8 * i)].tangent) > 0))
        return fail(ErrorCode::Degenerate, "the path comes to rest, so that a section has no direction there");
      sections.push_back(placed(i));
      v.push_back(path.range().at(i / double(fine - 1)));
    }
    auto skin = skinned(sections, 3, v);
    if (!skin) return tl::unexpected<Error>(skin.error());
    deviation = skin->error;
    for (int i = 0; i < fine; ++i)
      if (i % 4 != 0) {
        const NurbsCurve iso = isocurve_v(skin->surface, path.range().at(i / double(fine - 1))), right = placed(i);
        for (int k = 0; k <= 16; ++k) {
          const double t = section.range().at(k / 16.0);
          deviation = std::max(deviation, distance(evaluate(iso, t), evaluate(right, t)));
        }
      }
    if (deviation <= tolerance) return Sweep{std::move(skin->surface), deviation, false};
  }
  return fail(ErrorCode::NoConvergence, fmt::format("{} sections do not make the sweep", most_sections), deviation,
              tolerance);
}

}  // namespace trimloop
