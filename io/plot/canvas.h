#pragma once
// A plane drawing as SVG: mathematical axes (y upwards), sizes of strokes and letters in pixels. Plain enough to edit.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/math/vec.h"

namespace trimloop::io::plot {

struct Pen {
  std::string_view colour = "#1f2933";
  double width = 1.5;           // pixels
  std::string_view fill = "none";
  std::string_view dash = "";   // "6 4"
  double opacity = 1;
};

inline constexpr std::string_view ink = "#1f2933", blue = "#1d6fb8", red = "#c2410c", green = "#2f855a", grey = "#9aa5b1",
                                  light = "#e4e7eb";
std::string_view series_colour(std::size_t i);  // of the i-th of several curves

class Canvas {
 public:
  // The drawing shows `view` with the same scale both ways unless `stretched`; width and height in pixels, margins inside,
  // with room for so many notes.
  Canvas(std::string title, Box view, double width, double height, bool stretched = false, std::size_t notes = 1);

  void polyline(const std::vector<Point>& points, const Pen& pen, bool closed = false);
  void polygon(const std::vector<Point>& points, const Pen& pen) { polyline(points, pen, true); }
  // Of a shaded picture, the joints covered. Nothing else is drawn after the first one.
  void tile(const std::array<Point, 3>& corners, std::string_view colour);
  void line(Point a, Point b, const Pen& pen) { polyline({a, b}, pen); }
  void arrow(Point from, Point to, const Pen& pen);  // a head at `to`, of fixed size
  void dot(Point at, double radius_px, std::string_view fill, std::string_view hint = {});
  void square(Point at, double half_px, const Pen& pen);
  void label(Point at, std::string_view text, std::string_view colour = ink, double dx_px = 6, double dy_px = -6);
  void note(std::string_view text);                  // below the title
  void axes(std::string_view x, std::string_view y);  // frame, ticks at round numbers, names

  std::string body() const;  // <g> of this drawing, to be placed on a sheet
  double width() const { return width_; }
  double height() const { return height_; }

 private:
  std::string place(Point p) const;
  double px(double x) const { return left_ + (x - origin_x_) * scale_x_; }
  double py(double y) const { return bottom_ - (y - origin_y_) * scale_y_; }

  std::string title_, text_, notes_;
  double width_, height_, left_ = 0, bottom_ = 0, origin_x_ = 0, origin_y_ = 0, scale_x_ = 1, scale_y_ = 1;
  Box view_;
  int note_count_ = 0;
  bool in_tiles_ = false;
};

// All drawings below one another as one SVG document.
std::string sheet(const std::vector<Canvas>& drawings);

}  // namespace trimloop::io::plot
