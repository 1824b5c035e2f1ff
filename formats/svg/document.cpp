#include "formats/svg/document.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <pugixml.hpp>

#include "base/number.h"

namespace trimloop::svg {

namespace {

Matrix operator*(const Matrix& m, const Matrix& n) {
  return {m[0] * n[0] + m[2] * n[1],        m[1] * n[0] + m[3] * n[1],        m[0] * n[2] + m[2] * n[3],
          m[1] * n[2] + m[3] * n[3],        m[0] * n[4] + m[2] * n[5] + m[4], m[1] * n[4] + m[3] * n[5] + m[5]};
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> out;
  std::size_t at = 0;
  while (at < text.size()) {
    at = text.find_first_not_of(" \t\r\n,", at);
    if (at == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n,", at), text.size());
    const auto number = read_real(text.substr(at, end - at));
    if (!number) return {};
    out.push_back(number.value);
    at = end;
  }
  return out;
}

// transform="matrix(...) translate(...) ..." (SVG 1.1 §7.6); nothing when it cannot be read.
std::optional<Matrix> transform(std::string_view text) {
  Matrix all = identity;
  while (true) {
    const std::size_t from = text.find_first_not_of(" \t\r\n,");
    if (from == std::string_view::npos) return all;
    const std::size_t open = text.find('(', from), close = text.find(')', from);
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
    std::string_view name = text.substr(from, open - from);
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    const std::vector<double> n = numbers(text.substr(open + 1, close - open - 1));
    const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
    Matrix m = identity;
    if (name == "matrix" && n.size() == 6) m = {n[0], n[1], n[2], n[3], n[4], n[5]};
    else if (name == "translate" && !n.empty()) m = {1, 0, 0, 1, n[0], n.size() > 1 ? n[1] : 0};
    else if (name == "scale" && !n.empty()) m = {n[0], 0, 0, n.size() > 1 ? n[1] : n[0], 0, 0};
    else if (name == "skewX" && n.size() == 1) m = {1, 0, std::tan(radians(n[0])), 1, 0, 0};
    else if (name == "skewY" && n.size() == 1) m = {1, std::tan(radians(n[0])), 0, 1, 0, 0};
    else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
      const double c = std::cos(radians(n[0])), s = std::sin(radians(n[0]));
      m = {c, s, -s, c, 0, 0};
      if (n.size() == 3) m = Matrix{1, 0, 0, 1, n[1], n[2]} * m * Matrix{1, 0, 0, 1, -n[1], -n[2]};
    } else return std::nullopt;
    all = all * m;
    text.remove_prefix(close + 1);
  }
}

// Millimetres of a length with a physical unit; nothing for user units, pixels and shares.
std::optional<double> physical(std::string_view text) {
  static constexpr std::pair<std::string_view, double> units[] = {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}, {"pc", 25.4 / 6}};
  for (const auto& [unit, mm] : units) {
    if (text.size() <= unit.size() || text.substr(text.size() - unit.size()) != unit) continue;
    const auto number = read_real(text.substr(0, text.size() - unit.size()));
    if (number && number.value > 0) return number.value * mm;
  }
  return std::nullopt;
}

Segment to(Segment::Kind kind, double x, double y) {
  Segment s;
  s.kind = kind;
  s.at[0] = {x, y};
  return s;
}

std::vector<Segment> ellipse(double cx, double cy, double rx, double ry) {
  std::vector<Segment> path{to(Segment::Kind::Move, cx + rx, cy)};
  for (const double x : {cx - rx, cx + rx}) {
    Segment half = to(Segment::Kind::Arc, x, cy);
    half.rx = rx, half.ry = ry, half.sweep = true;
    path.push_back(half);
  }
  path.push_back(to(Segment::Kind::Close, 0, 0));
  return path;
}

// The path that an element means (SVG 1.1 §9); an empty one when its size is zero.
Result<std::vector<Segment>> outline(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto value = [&node](const char* attribute) { return read_real(node.attribute(attribute).as_string("0")).value; };
  std::vector<Segment> path;
  if (name == "path") return parse_path(node.attribute("d").as_string());
  if (name == "line") return std::vector{to(Segment::Kind::Move, value("x1"), value("y1")), to(Segment::Kind::Line, value("x2"), value("y2"))};
  if (name == "circle") return value("r") > 0 ? ellipse(value("cx"), value("cy"), value("r"), value("r")) : path;
  if (name == "ellipse") return value("rx") > 0 && value("ry") > 0 ? ellipse(value("cx"), value("cy"), value("rx"), value("ry")) : path;
  if (name == "rect") {
    const double x = value("x"), y = value("y"), w = value("width"), h = value("height");
    if (node.attribute("rx") || node.attribute("ry")) return fail(ErrorCode::Unsupported, "rounded rectangles are not read");
    if (w > 0 && h > 0)
      path = {to(Segment::Kind::Move, x, y), to(Segment::Kind::Line, x + w, y), to(Segment::Kind::Line, x + w, y + h),
              to(Segment::Kind::Line, x, y + h), to(Segment::Kind::Close, 0, 0)};
    return path;
  }
  const std::vector<double> n = numbers(node.attribute("points").as_string());  // polyline, polygon
  if (n.size() < 4 || n.size() % 2 != 0) return fail(ErrorCode::InvalidArgument, fmt::format("{} numbers are no list of points", n.size()));
  for (std::size_t i = 0; i < n.size(); i += 2) path.push_back(to(i == 0 ? Segment::Kind::Move : Segment::Kind::Line, n[i], n[i + 1]));
  if (name == "polygon") path.push_back(to(Segment::Kind::Close, 0, 0));
  return path;
}

bool is_shape(std::string_view name) {
  for (const std::string_view shape : {"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})
    if (name == shape) return true;
  return false;
}

bool holds_shapes(std::string_view name) { return name == "svg" || name == "g" || name == "a" || name == "switch"; }

void collect(const pugi::xml_node& root, const Limits& limits, Document& out) {
  struct Open {
    pugi::xml_node node;
    Matrix matrix;
    std::size_t depth;
  };
  std::vector<Open> open{{root, identity, 0}};  // a stack of our own: files nest as deep as they like
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    const std::string_view name = at.node.name();
    const auto fault = [&](std::string text) {
      out.faults.push_back({std::move(text), std::string(name), static_cast<std::size_t>(at.node.offset_debug())});
    };
    Matrix matrix = at.matrix;
    if (const auto attribute = at.node.attribute("transform")) {
      const auto own = transform(attribute.value());
      if (!own) {
        fault(fmt::format("the transform \"{}\" is not understood", attribute.value()));
        continue;
      }
      matrix = matrix * *own;
    }
    if (is_shape(name)) {
      auto path = outline(at.node);
      if (!path) fault(path.error().text);
      else if (!path->empty())
        out.outlines.push_back({at.node.attribute("id").as_string(), std::string(name), std::move(*path), matrix,
                                static_cast<std::size_t>(at.node.offset_debug())});
    } else if (holds_shapes(name)) {
      if (at.depth >= limits.nesting_depth) {
        fault("groups are nested deeper than allowed");
        continue;
      }
      for (pugi::xml_node child = at.node.last_child(); child; child = child.previous_sibling())
        if (child.type() == pugi::node_element) open.push_back({child, matrix, at.depth + 1});
    } else {
      ++out.left_out[std::string(name)];
    }
  }
}

}  // namespace

bool sniff(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && head[first] == '<' && head.find("<svg", first) != std::string_view::npos;
}

Result<Document> parse(std::string_view text, const Limits& limits) {
  pugi::xml_document xml;
  const auto read = xml.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!read) return fail(ErrorCode::InvalidArgument, fmt::format("no XML: {}", read.description()), static_cast<double>(read.offset));
  const pugi::xml_node root = xml.child("svg");
  if (!root) return fail(ErrorCode::InvalidArgument, "the root element is not <svg>", 0);
  Document out;
  const std::vector<double> view = numbers(root.attribute("viewBox").as_string());
  const auto width = physical(root.attribute("width").as_string());
  if (width && view.size() == 4 && view[2] > 0) out.user_unit_mm = *width / view[2];
  collect(root, limits, out);
  return out;
}

}  // namespace trimloop::svg
