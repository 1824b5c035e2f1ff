#include <fmt/format.h>

#include <algorithm>

#include "io/plot/drawings.h"
#include "kernel/geometry/differential.h"
#include "kernel/nurbs/basis_functions.h"
#include "kernel/nurbs/hodograph.h"

namespace trimloop::io::plot {

namespace {

constexpr double wide = 900, high = 560;

std::vector<Point> poles_of(const NurbsCurve& c) {
  std::vector<Point> out;
  for (const Hpoint& h : c.poles())
    if (h.w != 0) out.push_back(project(h));
  return out;
}

std::vector<Point> on_page(const View& view, const std::vector<Point>& points) {
  std::vector<Point> out;
  for (const Point& p : points) out.push_back(view(p));
  return out;
}

Box box_of(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points)
    if (is_finite(p)) box.add(p);
  return box;
}


}  // namespace

Point View::operator()(Point p) const {
  if (flat) return {p.x, p.y, 0};
  // From the right front above: azimuth 35 degrees, elevation 25.
  constexpr double ca = 0.8191520442889918, sa = 0.573576436351046, ce = 0.9063077870366499, se = 0.42261826174069944;
  const double x = ca * p.x + sa * p.y, y = -sa * p.x + ca * p.y;
  return {x, ce * p.z + se * y, 0};
}

double View::depth(Point p) const {
  constexpr double ca = 0.8191520442889918, sa = 0.573576436351046, ce = 0.9063077870366499, se = 0.42261826174069944;
  if (flat) return p.z;
  return se * p.z - ce * (-sa * p.x + ca * p.y);
}

View view_of(const Box& box) {
  return {!box.empty() && box.hi.z - box.lo.z <= 1e-9 * std::max(1e-300, box.diagonal())};
}

Box page_box(const View& view, const std::vector<Point>& points) { return box_of(on_page(view, points)); }

std::vector<Point> sampled(const Curve& c, std::size_t per_span) {
  std::vector<Point> out;
  const std::vector<double> ends = breaks(c);
  // Many spans need few points each, and straight ones two.
  const bool straight = std::holds_alternative<Polyline>(c.shape) || std::holds_alternative<Line>(c.shape);
  per_span = straight ? 1 : std::clamp<std::size_t>(1000 / ends.size(), std::min<std::size_t>(6, per_span), per_span);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (std::size_t k = i == 0 ? 0 : 1; k <= per_span; ++k)
      out.push_back(evaluate(c, Interval{ends[i], ends[i + 1]}.at(static_cast<double>(k) / static_cast<double>(per_span))));
  return out;
}

std::vector<Canvas> draw_curve(const std::string& title, const Curve& c) {
  const std::vector<Point> points = sampled(c);
  std::vector<Point> all = points, polygon;
  const auto* nurbs = std::get_if<NurbsCurve>(&c.shape);
  if (nurbs) polygon = poles_of(*nurbs);
  all.insert(all.end(), polygon.begin(), polygon.end());
  const View view = view_of(box_of(all));
  Canvas canvas(title, page_box(view, all), wide, high);
  if (nurbs) {
    canvas.note(fmt::format("degree {}, {} poles, {}; polygon with poles, knots as squares", nurbs->degree(), nurbs->poles().size(),
                            nurbs->is_rational() ? "rational" : "polynomial"));
    canvas.polyline(on_page(view, polygon), {grey, 1.2, "none", "5 4"});
  }
  canvas.polyline(on_page(view, points), {blue, 2.2});
  if (nurbs) {
    std::size_t i = 0;
    for (const Hpoint& h : nurbs->poles()) {
      if (h.w != 0) {
        canvas.dot(view(project(h)), 3.5, red, fmt::format("P{} weight {:.6g}", i, h.w));
        if (nurbs->poles().size() <= 24) canvas.label(view(project(h)), fmt::format("P{}", i), red);
      }
      ++i;
    }
    for (const double t : breaks(*nurbs)) canvas.square(view(evaluate(c, t)), 3, {blue, 1.5, "white"});
  }
  return {canvas};
}

std::vector<Canvas> draw_hodograph(const std::string& title, const Curve& c) {
  std::vector<Canvas> out = draw_curve(title, c);
  std::vector<Point> points{Point{}}, speed;
  const std::vector<double> ends = breaks(c);
  std::vector<std::vector<Point>> pieces;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    pieces.emplace_back();
    for (int k = 0; k <= 48; ++k) {  // just inside the piece at its ends, where the derivative may jump
      const double inset = k == 0 ? 1e-9 : k == 48 ? -1e-9 : 0, t = Interval{ends[i], ends[i + 1]}.at(k / 48.0 + inset);
      const Vector d = jet(c, t).d1;
      pieces.back().push_back(to_point(d));
      speed.push_back({t, norm(d), 0});
    }
    points.insert(points.end(), pieces.back().begin(), pieces.back().end());
  }
  std::vector<std::vector<Point>> polygons;
  if (const auto* nurbs = std::get_if<NurbsCurve>(&c.shape); nurbs && !nurbs->is_rational() && nurbs->degree() >= 2) {
    if (const auto pieces_of = hodograph(*nurbs))
      for (const NurbsCurve& h : *pieces_of) polygons.push_back(poles_of(h)), points.insert(points.end(), polygons.back().begin(), polygons.back().end());
  }
  const View view = view_of(box_of(points));
  Canvas canvas("Hodograph", page_box(view, points), wide, high);
  canvas.note("the derivative as a curve from the origin, with its control polygon");
  for (const auto& polygon : polygons) canvas.polyline(on_page(view, polygon), {grey, 1.2, "none", "5 4"});
  for (const auto& piece : pieces) canvas.polyline(on_page(view, piece), {blue, 2.2});
  canvas.dot(view(Point{}), 4, red, "origin");
  canvas.label(view(Point{}), "0", red);
  out.push_back(canvas);
  Box box = box_of(speed);
  box.add(Point{box.lo.x, 0, 0});
  Canvas graph("Speed", box, wide, 300, true);
  graph.axes("t", "|C'|");
  graph.polyline(speed, {blue, 2});
  out.push_back(graph);
  return out;
}

std::vector<Canvas> draw_comb(const std::string& title, const Curve& c) {
  struct Tooth {
    Point foot;
    Vector towards;  // against the normal, length the curvature
    double curvature;
    double t;
  };
  std::vector<Tooth> teeth;
  const std::vector<double> ends = breaks(c);
  double largest = 0;
  std::vector<Point> all = sampled(c);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    for (int k = 0; k <= 40; ++k) {
      const double inset = k == 0 ? 1e-9 : k == 40 ? -1e-9 : 0, t = Interval{ends[i], ends[i + 1]}.at(k / 40.0 + inset);
      const auto frame = frenet_frame(c, t);
      if (!frame) continue;
      teeth.push_back({frame->point, -(frame->curvature * frame->normal), frame->curvature, t});
      largest = std::max(largest, frame->curvature);
    }
  }
  const double reach = largest > 0 ? 0.25 * box_of(all).diagonal() / largest : 0;
  std::vector<Point> tips;
  for (const Tooth& t : teeth) tips.push_back(t.foot + reach * t.towards);
  std::vector<Point> everything = all;
  everything.insert(everything.end(), tips.begin(), tips.end());
  const View view = view_of(box_of(everything));
  Canvas canvas(title + ": curvature comb", page_box(view, everything), wide, high);
  canvas.note(fmt::format("largest curvature {:.6g} / mm, radius {:.6g} mm", largest, largest > 0 ? 1 / largest : 0));
  for (std::size_t i = 0; i < teeth.size(); ++i) canvas.line(view(teeth[i].foot), view(tips[i]), {green, 0.8});
  canvas.polyline(on_page(view, tips), {green, 1.4});
  canvas.polyline(on_page(view, all), {blue, 2.2});
  std::vector<Point> graph_points;
  for (const Tooth& t : teeth) graph_points.push_back({t.t, t.curvature, 0});
  Box box = box_of(graph_points);
  if (box.empty()) return {canvas};
  box.add(Point{box.lo.x, 0, 0});
  Canvas graph("Curvature over the parameter", box, wide, 300, true);
  graph.axes("t", "1 / mm");
  graph.polyline(graph_points, {green, 2});
  return {canvas, graph};
}

std::vector<Canvas> draw_basis(const std::string& title, const NurbsCurve& c) {
  const Interval domain = c.domain();
  Canvas canvas(title + ": basis functions", {{domain.lo, 0, 0}, {domain.hi, 1, 0}}, wide, 400, true);
  canvas.note(fmt::format("degree {}; they are never negative and add up to one", c.degree()));
  canvas.axes("t", "N");
  for (std::size_t i = 0; i < c.poles().size(); ++i) {
    std::vector<Point> points;
    const Interval support{std::max(domain.lo, c.knots()[i]), std::min(domain.hi, c.knots()[i + static_cast<std::size_t>(c.degree()) + 1])};
    Point top{0, -1, 0};
    for (int k = 0; k <= 200 && support.lo < support.hi; ++k) {
      const double t = support.at(k / 200.0);
      points.push_back({t, basis_function(c.degree(), c.knots(), i, t), 0});
      if (points.back().y > top.y) top = points.back();
    }
    canvas.polyline(points, {series_colour(i), 2});
    if (!points.empty() && c.poles().size() <= 24) canvas.label(top, fmt::format("N{}", i), series_colour(i), top.x == domain.lo ? 5 : -8, -6);
  }
  for (const double t : breaks(c)) canvas.line({t, 0, 0}, {t, 1, 0}, {grey, 1, "none", "2 4"});
  return {canvas};
}

std::vector<Canvas> draw_blossom(const std::string& title, const NurbsCurve& c, std::optional<double> at) {
  const Interval range = c.range();
  const double t = std::clamp(at.value_or(range.mid()), range.lo, range.hi);
  const int p = c.degree();
  const auto k = static_cast<std::size_t>(find_span(p, c.knots(), c.poles().size(), t));
  const auto degree = static_cast<std::size_t>(p);
  std::vector<Point> all = sampled({c}), polygon = poles_of(c);
  all.insert(all.end(), polygon.begin(), polygon.end());
  const View view = view_of(box_of(all));
  Canvas canvas(title + fmt::format(": blossom at t = {:.6g}", t), page_box(view, all), wide, 640);
  canvas.note("every point is the polar form of its arguments; along a side one argument changes (de Boor)");
  canvas.polyline(on_page(view, polygon), {grey, 1.2, "none", "5 4"});
  canvas.polyline(on_page(view, sampled({c})), {blue, 2.2});
  std::vector<Hpoint> level(c.poles().begin() + static_cast<std::ptrdiff_t>(k - degree), c.poles().begin() + static_cast<std::ptrdiff_t>(k + 1));
  const auto name = [&](std::size_t r, std::size_t i) {  // of point i of level r
    std::string text;
    for (std::size_t j = 0; j < r; ++j) text += text.empty() ? "t" : ",t";
    for (std::size_t j = r; j < degree; ++j) text += fmt::format("{}{:.4g}", text.empty() ? "" : ",", c.knots()[k - degree + i + j + 1]);
    return "f(" + text + ")";
  };
  for (std::size_t r = 0; r <= degree; ++r) {
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (level[i].w == 0) continue;
      const Point here = view(project(level[i]));
      canvas.dot(here, r == degree ? 5 : 3.5, r == degree ? ink : series_colour(r + 1));
      canvas.label(here, name(r, i), r == degree ? ink : series_colour(r + 1));
    }
    if (r == degree) break;
    std::vector<Hpoint> next;
    std::vector<Point> chord;
    for (std::size_t i = 0; i + 1 < level.size(); ++i) {
      const double lo = c.knots()[k - degree + i + r + 1], hi = c.knots()[k + i + 1], s = (t - lo) / (hi - lo);
      next.push_back((1 - s) * level[i] + s * level[i + 1]);
      if (next.back().w != 0) chord.push_back(view(project(next.back())));
    }
    canvas.polyline(chord, {series_colour(r + 2), 1.4});
    level = std::move(next);
  }
  return {canvas};
}

std::vector<Canvas> draw_knots(const std::string& title, const NurbsCurve& c) {
  std::vector<std::pair<double, int>> distinct;
  for (const double t : c.knots()) {
    if (distinct.empty() || distinct.back().first != t) distinct.emplace_back(t, 0);
    ++distinct.back().second;
  }
  const double top = c.degree() + 1;
  Canvas canvas(title + ": knots", {{c.knots().front(), 0, 0}, {c.knots().back(), top, 0}}, wide, 260, true);
  canvas.note("height: multiplicity; each repetition costs one order of continuity");
  canvas.axes("t", "multiplicity");
  canvas.line({c.range().lo, 0, 0}, {c.range().hi, 0, 0}, {blue, 4});
  for (const auto& [t, times] : distinct) {
    canvas.line({t, 0, 0}, {t, static_cast<double>(times), 0}, {red, 2});
    canvas.dot({t, static_cast<double>(times), 0}, 4, red, fmt::format("{} x {}, C{}", t, times, c.degree() - times));
    if (times < c.degree() + 1 && t > c.range().lo && t < c.range().hi)
      canvas.label({t, static_cast<double>(times), 0}, fmt::format("C{}", c.degree() - times), ink, -8, -8);
  }
  return {canvas};
}

}  // namespace trimloop::io::plot
