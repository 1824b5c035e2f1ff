#include "io/plot/canvas.h"

#include <fmt/format.h>

#include <array>

namespace trimloop::io::plot {

namespace {

constexpr double margin_side = 56, margin_top = 59, margin_bottom = 44, note_height = 17;

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out;
}

std::string pixels(double v) { return std::isfinite(v) ? fmt::format("{:.2f}", std::clamp(v, -1e6, 1e6)) : "0"; }

// 1, 2 or 5 times a power of ten, some five of them over the length.
double tick_step(double length) {
  const double rough = length / 5, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power) return factor * power;
  return 10 * power;
}

}  // namespace

std::string_view series_colour(std::size_t i) {
  static constexpr std::array<std::string_view, 8> colours{"#1d6fb8", "#c2410c", "#2f855a", "#805ad5", "#b7791f", "#0f766e", "#be185d", "#4a5568"};
  return colours[i % colours.size()];
}

Canvas::Canvas(std::string title, Box view, double width, double height, bool stretched, std::size_t notes)
    : title_(std::move(title)), width_(width), height_(height), view_(view) {
  if (view_.empty() || !is_finite(view_.lo) || !is_finite(view_.hi)) view_ = {{0, 0, 0}, {1, 1, 0}};
  double w = view_.hi.x - view_.lo.x, h = view_.hi.y - view_.lo.y;
  if (!(w > 0)) w = h > 0 ? h : 1, view_.lo.x -= w / 2, view_.hi.x += w / 2;
  if (!(h > 0)) h = w, view_.lo.y -= h / 2, view_.hi.y += h / 2;
  const double room_x = width - 2 * margin_side, room_y = height - margin_top - note_height * double(notes) - margin_bottom;
  scale_x_ = room_x / w;
  scale_y_ = room_y / h;
  if (!stretched) scale_x_ = scale_y_ = std::min(scale_x_, scale_y_);
  origin_x_ = view_.lo.x;
  origin_y_ = view_.lo.y;
  left_ = margin_side + (room_x - scale_x_ * w) / 2;
  bottom_ = height - margin_bottom - (room_y - scale_y_ * h) / 2;
}

std::string Canvas::place(Point p) const { return pixels(px(p.x)) + "," + pixels(py(p.y)); }

void Canvas::polyline(const std::vector<Point>& points, const Pen& pen, bool closed) {
  if (points.empty()) return;
  text_ += closed ? "<polygon points=\"" : "<polyline points=\"";
  for (const Point& p : points) text_ += place(p) + " ";
  text_.back() = '"';
  text_ += fmt::format(" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"", pen.fill, pen.colour, pen.width);
  if (!pen.dash.empty()) text_ += fmt::format(" stroke-dasharray=\"{}\"", pen.dash);
  if (pen.opacity < 1) text_ += fmt::format(" opacity=\"{}\"", pen.opacity);
  text_ += "/>\n";
}

void Canvas::tile(const std::array<Point, 3>& corners, std::string_view colour) {
  if (!in_tiles_) text_ += "<g fill=\"currentColor\" stroke=\"currentColor\">\n";
  in_tiles_ = true;
  text_ += "<path d=\"M";
  for (const Point& p : corners) text_ += fmt::format("{:.1f} {:.1f} ", std::clamp(px(p.x), -1e6, 1e6), std::clamp(py(p.y), -1e6, 1e6));
  text_.back() = 'z';
  text_ += fmt::format("\" color=\"{}\"/>\n", colour);
}

void Canvas::arrow(Point from, Point to, const Pen& pen) {
  line(from, to, pen);
  const double dx = px(to.x) - px(from.x), dy = py(to.y) - py(from.y), length = std::hypot(dx, dy);
  if (!(length > 0) || !std::isfinite(length)) return;
  const double ux = dx / length, uy = dy / length, size = 4 + 2 * pen.width, x = px(to.x), y = py(to.y);
  text_ += fmt::format("<polygon points=\"{},{} {},{} {},{}\" fill=\"{}\"/>\n", pixels(x), pixels(y), pixels(x - size * ux + 0.4 * size * uy),
                       pixels(y - size * uy - 0.4 * size * ux), pixels(x - size * ux - 0.4 * size * uy), pixels(y - size * uy + 0.4 * size * ux),
                       pen.colour);
}

void Canvas::dot(Point at, double radius, std::string_view fill, std::string_view hint) {
  text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"", pixels(px(at.x)), pixels(py(at.y)), radius, fill);
  text_ += hint.empty() ? std::string("/>\n") : fmt::format("><title>{}</title></circle>\n", escaped(hint));
}

void Canvas::square(Point at, double half, const Pen& pen) {
  text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                       pixels(px(at.x) - half), pixels(py(at.y) - half), 2 * half, 2 * half, pen.fill, pen.colour, pen.width);
}

void Canvas::label(Point at, std::string_view text, std::string_view colour, double dx, double dy) {
  // One that would leave the drawing stands on the other side of its point.
  const double length = 7.2 * static_cast<double>(text.size());
  const bool flips = px(at.x) + dx + length > width_ - 4 && px(at.x) - dx - length > 4;
  text_ += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\" font-size=\"13\"{}>{}</text>\n", pixels(px(at.x) + (flips ? -dx : dx)),
                       pixels(py(at.y) + dy), colour, flips ? " text-anchor=\"end\"" : "", escaped(text));
}

void Canvas::note(std::string_view text) {
  notes_ += fmt::format("<text x=\"16\" y=\"{}\" fill=\"#52606d\" font-size=\"13\">{}</text>\n", 42 + note_height * note_count_++, escaped(text));
}

void Canvas::axes(std::string_view x, std::string_view y) {
  const Point lo = view_.lo, hi = view_.hi;
  std::string back;
  std::swap(back, text_);  // drawn first, below what is there
  polygon({lo, {hi.x, lo.y, 0}, hi, {lo.x, hi.y, 0}}, {light, 1});
  const auto ticks = [&](bool along_x) {
    const double from = along_x ? lo.x : lo.y, to = along_x ? hi.x : hi.y, step = tick_step(to - from);
    for (double t = std::ceil(from / step) * step; t <= to + 1e-9 * step; t += step) {
      const double value = std::abs(t) < 1e-9 * step ? 0 : t;
      const Point at = along_x ? Point{value, lo.y, 0} : Point{lo.x, value, 0};
      line(at, along_x ? Point{value, hi.y, 0} : Point{hi.x, value, 0}, {light, 1});
      const std::string number = fmt::format("{:.4g}", value);
      if (along_x) label(at, number, "#52606d", -3.5 * static_cast<double>(number.size()), 17);
      else label(at, number, "#52606d", -8 - 7.5 * static_cast<double>(number.size()), 4);
    }
  };
  ticks(true);
  ticks(false);
  label({hi.x, lo.y, 0}, x, "#52606d", 8, 4);
  label({lo.x, hi.y, 0}, y, "#52606d", -4, -8);
  text_ += back;
}

std::string Canvas::body() const {
  return fmt::format("<text x=\"16\" y=\"24\" font-size=\"16\" font-weight=\"600\" fill=\"{}\">{}</text>\n{}{}{}", ink, escaped(title_), notes_,
                     text_, in_tiles_ ? "</g>\n" : "");
}

std::string sheet(const std::vector<Canvas>& drawings) {
  double width = 0, height = 0;
  for (const Canvas& c : drawings) width = std::max(width, c.width()), height += c.height();
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                                "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                                width, height);
  double y = 0;
  for (const Canvas& c : drawings) {
    out += fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n", y, c.body());
    y += c.height();
  }
  return out + "</svg>\n";
}

}  // namespace trimloop::io::plot
