#pragma once
// The drawings of plot.h, one function each (not part of the public face).

#include "io/plot/canvas.h"
#include "io/plot/plot.h"

namespace trimloop::io::plot {

// Space onto the page: seen along z when all lies in a plane z = const, else from the right front above. depth grows
// towards the eye.
struct View {
  bool flat = true;
  Point operator()(Point p) const;
  double depth(Point p) const;
};
View view_of(const Box&);
Box page_box(const View&, const std::vector<Point>&);

std::vector<Point> sampled(const Curve&, std::size_t per_span = 48);

std::vector<Canvas> draw_curve(const std::string& title, const Curve&);
std::vector<Canvas> draw_hodograph(const std::string& title, const Curve&);
std::vector<Canvas> draw_comb(const std::string& title, const Curve&);
std::vector<Canvas> draw_basis(const std::string& title, const NurbsCurve&);
std::vector<Canvas> draw_blossom(const std::string& title, const NurbsCurve&, std::optional<double> at);
std::vector<Canvas> draw_knots(const std::string& title, const NurbsCurve&);

std::vector<Canvas> draw_net(const std::string& title, const Surface&, Interval u, Interval v);
std::vector<Canvas> draw_isocurves(const std::string& title, const Surface&, Interval u, Interval v);
Canvas draw_annotation(const std::string& title, const std::vector<Annotation>&);
Canvas draw_trims(const std::string& title, const Body&, FaceId);
// All faces of a body shaded by what each triangle shows.
Result<Canvas> draw_shaded(const std::string& title, const Body&, What, const Colour&, const Execution&);

}  // namespace trimloop::io::plot
