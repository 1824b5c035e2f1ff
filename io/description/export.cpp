#include "io/description/export.h"

#include <fmt/format.h>

#include <iterator>

#include "base/number.h"
#include "io/outlines.h"

namespace trimloop::io::description {

namespace {

constexpr double drawing_tolerance_mm = 1e-3;

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < 0x20) out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else out += c;
  }
  return out + '"';
}

std::string escaped(std::string_view text) {  // for XML attributes
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '"') out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out;
}

std::string point_text(Point p) { return fmt::format("[{}, {}, {}]", json_real(p.x), json_real(p.y), json_real(p.z)); }

// Points and weights of homogeneous poles; an ideal pole has weight 0 and its direction as point, as descriptions have it.
struct Parts {
  std::string points, weights;
};
Parts parts(std::span<const Hpoint> poles) {
  Parts out;
  for (const Hpoint& h : poles) {
    const Point p = h.w == 0 ? Point{h.x, h.y, h.z} : project(h);
    out.points += (out.points.empty() ? "" : ", ") + point_text(p);
    out.weights += (out.weights.empty() ? "" : ", ") + json_real(h.w);
  }
  return out;
}

class JsonWriter {
 public:
  explicit JsonWriter(const Model& model) : model_(model) {}

  void curve(const NurbsCurve& curve, const std::string& name) {
    for (const NurbsCurve& piece : bezier_pieces(curve)) {
      const Parts p = parts(piece.poles());
      open("bezier", name);
      text_ += fmt::format(", \"points\": [{}]", p.points);
      if (piece.is_rational()) text_ += fmt::format(", \"weights\": [{}]", p.weights);
      text_ += "}";
    }
  }

  void surface(const NurbsSurface& surface, const std::string& name) {
    const auto u = breaks_u(surface), v = breaks_v(surface);
    for (std::size_t i = 0; i + 1 < u.size(); ++i) {
      for (std::size_t j = 0; j + 1 < v.size(); ++j) {
        const NurbsSurface piece = trimmed(surface, {u[i], u[i + 1]}, {v[j], v[j + 1]});
        open("bezier-surface", name);
        std::string points, weights;
        for (std::size_t row = 0; row < piece.poles_u(); ++row) {
          const Parts p = parts(std::span(piece.poles()).subspan(row * piece.poles_v(), piece.poles_v()));
          points += fmt::format("{}[{}]", row ? ", " : "", p.points);
          weights += fmt::format("{}[{}]", row ? ", " : "", p.weights);
        }
        text_ += fmt::format(", \"points\": [{}]", points);
        if (piece.is_rational()) text_ += fmt::format(", \"weights\": [{}]", weights);
        text_ += "}";
      }
    }
  }

  std::string finish() {
    return fmt::format("{{\"name\": {}, \"unit\": \"mm\", \"shapes\": [{}\n]}}\n", json_text(model_.name), text_);
  }
  bool empty() const { return text_.empty(); }

 private:
  void open(std::string_view type, const std::string& name) {
    text_ += fmt::format("{}\n  {{\"type\": \"{}\"", text_.empty() ? "" : ",", type);
    if (!name.empty()) text_ += fmt::format(", \"name\": {}", json_text(name));
  }
  const Model& model_;
  std::string text_;
};

// Occurrences with their transforms; curves and surfaces are written where they stand.
template <class EachPart>
Result<void> for_each_occurrence(const Model& model, const WriteOptions& options, EachPart each) {
  const auto all = occurrences(model, options.execution.limits.instances, options.execution.limits.nesting_depth);
  if (!all) return tl::unexpected(all.error());
  for (const Occurrence& o : *all) each(model.parts[o.part], o.transform);
  return {};
}

void count_losses(std::size_t trims, std::size_t surfaces, std::size_t curves, std::vector<std::string>& losses) {
  if (trims) losses.push_back(fmt::format("trimming loops of {} faces: Bézier pieces cover the whole surface", trims));
  if (surfaces) losses.push_back(fmt::format("{} surfaces without an exact NURBS form", surfaces));
  if (curves) losses.push_back(fmt::format("{} curves without an exact NURBS form", curves));
}

}  // namespace

Result<Exported> write_json(const Model& model, const SourceInfo&, const WriteOptions& options) {
  JsonWriter json(model);
  Exported out;
  std::size_t trims = 0, no_surface = 0, no_curve = 0;
  const auto done = for_each_occurrence(model, options, [&](const Part& part, const Transform& at) {
    for (const FreeCurve& free : part.curves) {
      const auto placed = transformed(free.curve, at);
      const auto nurbs = placed && is_bounded(*placed) ? to_nurbs(*placed) : Result<ToNurbsCurve>(fail(ErrorCode::Unsupported, ""));
      if (!nurbs) {
        ++no_curve;
        continue;
      }
      ++out.nurbs.exact_curves;
      json.curve(nurbs->curve, model[free.attributes].name);
    }
    for (const Body& body : part.bodies) {
      for (const Face& face : body.faces) {
        const auto placed = transformed(*face.surface, at);
        const SurfaceDomain d = placed ? domain(*placed) : SurfaceDomain{};
        const auto nurbs = placed && d.is_bounded() ? to_nurbs(*placed, d.u, d.v) : Result<ToNurbsSurface>(fail(ErrorCode::Unsupported, ""));
        if (!nurbs) {
          ++no_surface;
          continue;
        }
        trims += face.loops.size() != 1 || face.status != FaceStatus::Ok;
        ++out.nurbs.exact_surfaces;
        json.surface(nurbs->surface, model[face.attributes].name);
      }
    }
  });
  if (!done) return tl::unexpected(done.error());
  if (json.empty()) return fail(ErrorCode::NotFound, "there is no curve or surface that has Bézier pieces");
  count_losses(trims, no_surface, no_curve, out.losses);
  out.bytes = json.finish();
  return out;
}

Result<Exported> write_svg(const Model& model, const SourceInfo&, const WriteOptions& options) {
  Exported out;
  std::string paths;
  Box box;
  std::size_t faces = 0, curves = 0;
  Transform down;
  down.r[1][1] = -1;
  const auto done = for_each_occurrence(model, options, [&](const Part& part, const Transform& at) {
    for (const Body& body : part.bodies) faces += body.faces.size();
    for (const FreeCurve& free : part.curves) {
      const auto placed = transformed(free.curve, down * at);
      const auto path = placed ? path_of(*placed, drawing_tolerance_mm) : Result<PathOfCurve>(fail(ErrorCode::Unsupported, ""));
      if (!path) {
        ++curves;
        continue;
      }
      for (const svg::Segment& segment : path->path) {
        const double r = segment.kind == svg::Segment::Kind::Arc ? 2 * std::max(segment.rx, segment.ry) : 0;
        const std::size_t points = segment.kind == svg::Segment::Kind::Cubic ? 3 : segment.kind == svg::Segment::Kind::Quad ? 2 : 1;
        for (std::size_t i = 0; segment.kind != svg::Segment::Kind::Close && i < points; ++i) {
          box.add(Point{segment.at[i][0] - r, segment.at[i][1] - r, 0});
          box.add(Point{segment.at[i][0] + r, segment.at[i][1] + r, 0});
        }
      }
      out.nurbs.max_deviation_mm = std::max(out.nurbs.max_deviation_mm, path->deviation_mm);
      ++out.nurbs.exact_curves;
      const std::string& name = model[free.attributes].name;
      paths += "<path";
      if (!name.empty()) paths += fmt::format(" id=\"{}\"", escaped(name));
      paths += " d=\"";
      svg::append_path_text(paths, path->path);
      paths += "\"/>\n";
    }
  });
  if (!done) return tl::unexpected(done.error());
  if (paths.empty()) return fail(ErrorCode::NotFound, "there is no free curve to draw; `trimloop view` shows faces");
  if (faces) out.losses.push_back(fmt::format("{} faces: a drawing holds curves only", faces));
  if (curves) out.losses.push_back(fmt::format("{} curves that have no outline", curves));
  const double width = box.hi.x - box.lo.x, height = box.hi.y - box.lo.y, line = std::max(width, height) / 500;
  paths.insert(0, fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\" fill=\"none\" stroke=\"black\" stroke-width=\"{}\">\n",
                              json_real(box.lo.x - 2 * line), json_real(box.lo.y - 2 * line), json_real(width + 4 * line),
                              json_real(height + 4 * line), json_real(line)));
  paths += "</svg>\n";
  out.bytes = std::move(paths);
  return out;
}

}  // namespace trimloop::io::description
