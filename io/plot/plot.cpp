#include "io/plot/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/plot/drawings.h"

namespace trimloop::io::plot {

namespace {

struct Word {
  std::string_view name;
  What what;
};
constexpr std::array<Word, 13> words{{{"curve", What::Curve}, {"hodograph", What::Hodograph}, {"comb", What::Comb}, {"basis", What::Basis},
                                      {"blossom", What::Blossom}, {"knots", What::Knots}, {"net", What::Net}, {"isocurves", What::Isocurves},
                                      {"trims", What::Trims}, {"annotation", What::Annotation}, {"gaussian", What::Gaussian}, {"zebra", What::Zebra},
                                      {"shaded", What::Shaded}}};

bool of_curves(What w) { return w <= What::Knots; }

class Drawer {
 public:
  Drawer(const Model& model, const SourceInfo& source, const Options& options) : model_(model), source_(source), options_(options) {}

  Result<Picture> run() {
    What what = options_.what.value_or(has_faces() ? What::Trims : has_curves() ? What::Curve : What::Annotation);
    // Without a question: what went wrong, if anything did.
    only_trouble_ = !options_.what && options_.entity.empty() && what == What::Trims && has_trouble();
    for (const Part& part : model_.parts) {
      if (what == What::Annotation) {
        annotation(part);
      } else if (of_curves(what)) {
        for (const FreeCurve& c : part.curves)
          if (wanted(c.source)) curve(c, what);
      } else {
        for (const Body& body : part.bodies) faces(body, what);
      }
    }
    if (!error_.text.empty()) return tl::unexpected(error_);
    if (drawings_.empty()) return fail(ErrorCode::NotFound, "nothing in the model has such a picture");
    return Picture{sheet(drawings_), drawn_, left_out_};
  }

 private:
  bool has_faces() const {
    return std::any_of(model_.parts.begin(), model_.parts.end(), [](const Part& p) {
      return std::any_of(p.bodies.begin(), p.bodies.end(), [](const Body& b) { return !b.faces.empty(); });
    });
  }
  bool has_curves() const {
    return std::any_of(model_.parts.begin(), model_.parts.end(), [](const Part& p) { return !p.curves.empty(); });
  }
  bool has_trouble() const {
    for (const Part& p : model_.parts)
      for (const Body& b : p.bodies)
        for (const Face& f : b.faces)
          if (f.status != FaceStatus::Ok) return true;
    return false;
  }
  bool wanted(const SourceRefs& source) const {
    if (options_.entity.empty()) return true;
    return std::any_of(source.begin(), source.end(), [&](const SourceRef& r) { return source_name(source_.format, r) == options_.entity; });
  }
  std::string title(const SourceRefs& source, AttributesId attributes, std::string_view kind, std::size_t number) const {
    const std::string& name = model_[attributes].name;
    std::string out = name.empty() ? fmt::format("{} {}", kind, number) : name;
    if (!source.empty() && (source_.format == Format::Iges || source_.format == Format::Step)) out += " (" + source_name(source_.format, source.front()) + ")";
    return out;
  }
  bool room() {
    if (drawn_ < options_.most_drawings) return ++drawn_, true;
    ++left_out_;
    return false;
  }
  void add(std::vector<Canvas> canvases) { drawings_.insert(drawings_.end(), canvases.begin(), canvases.end()); }

  // All of a part on one page.
  void annotation(const Part& part) {
    std::vector<trimloop::Annotation> shown;
    for (const trimloop::Annotation& a : part.annotation)
      if (wanted(a.source)) shown.push_back(a);
    if (!shown.empty() && room()) drawings_.push_back(draw_annotation(part.name.empty() ? "annotation" : part.name, shown));
  }

  void curve(const FreeCurve& c, What what) {
    if (!is_bounded(c.curve)) return;
    const std::string name = title(c.source, c.attributes, "curve", ++number_);
    if (what == What::Curve || what == What::Hodograph || what == What::Comb) {
      if (room()) add(what == What::Curve ? draw_curve(name, c.curve) : what == What::Hodograph ? draw_hodograph(name, c.curve) : draw_comb(name, c.curve));
      return;
    }
    const auto nurbs = to_nurbs(c.curve);
    if (!nurbs || !room()) return;
    add(what == What::Basis ? draw_basis(name, nurbs->curve) : what == What::Blossom ? draw_blossom(name, nurbs->curve, options_.at) : draw_knots(name, nurbs->curve));
  }

  void faces(const Body& body, What what) {
    if (what >= What::Gaussian) {
      if (body.faces.empty() || !room()) return;
      const Colour colour = model_[body.attributes].colour.value_or(Colour{0.45, 0.6, 0.75});
      auto canvas = draw_shaded(title(body.source, body.attributes, "body", ++number_), body, what, colour, options_.execution);
      if (canvas) drawings_.push_back(*canvas);
      else error_ = canvas.error();
      return;
    }
    for (std::uint32_t i = 0; i < body.faces.size(); ++i) {
      const Face& face = body.faces[i];
      ++number_;
      if (!wanted(face.source) || (only_trouble_ && face.status == FaceStatus::Ok) || !face.surface) continue;
      const std::string name = title(face.source, face.attributes, "face", number_);
      if (what == What::Trims) {
        if (room()) drawings_.push_back(draw_trims(name, body, FaceId{i}));
        continue;
      }
      SurfaceDomain d = domain(*face.surface);
      for (const LoopId loop : d.is_bounded() ? std::vector<LoopId>{} : face.loops)  // a plane is shown over its loops
        for (const Coedge& c : body[loop].coedges)
          for (int k = 0; k <= 16; ++k) {
            const Uv uv = uv_at(body, c, body[c.edge].range.at(k / 16.0));
            if (k == 0 && &c == body[loop].coedges.data() && loop.index == face.loops[0].index) d.u = {uv.u, uv.u}, d.v = {uv.v, uv.v};
            d.u = {std::min(d.u.lo, uv.u), std::max(d.u.hi, uv.u)};
            d.v = {std::min(d.v.lo, uv.v), std::max(d.v.hi, uv.v)};
          }
      if (!d.is_bounded() || !room()) continue;
      add(what == What::Net ? draw_net(name, *face.surface, d.u, d.v) : draw_isocurves(name, *face.surface, d.u, d.v));
    }
  }

  const Model& model_;
  const SourceInfo& source_;
  const Options& options_;
  bool only_trouble_ = false;
  std::size_t number_ = 0, drawn_ = 0, left_out_ = 0;
  std::vector<Canvas> drawings_;
  Error error_;
};

}  // namespace

std::optional<What> what_from_name(std::string_view name) {
  for (const Word& w : words)
    if (w.name == name) return w.what;
  return std::nullopt;
}

Result<Picture> draw(const Model& model, const SourceInfo& source, const Options& options) { return Drawer(model, source, options).run(); }

Result<Picture> draw_subdivision(const subdivision::ControlMesh& mesh, subdivision::Scheme scheme, int rounds) {
  std::vector<Canvas> drawings;
  Result<subdivision::ControlMesh> at = mesh;
  const View view{false};
  const Box box = page_box(view, mesh.points);
  for (int round = 0; round <= rounds; ++round) {
    if (round > 0) at = subdivision::refined(*at, scheme, round - 1, 400'000);
    if (!at) return tl::unexpected(at.error());
    Canvas canvas(fmt::format("{}, round {}: {} points, {} faces", to_string(scheme), round, at->points.size(), at->face_count()), box, 700, 520);
    // Painter's order: what is nearer to the eye is drawn later.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t f = 0; f < at->face_count(); ++f) {
      double depth = 0;
      for (const std::uint32_t v : at->face(f)) depth += view.depth(at->points[v]) / static_cast<double>(at->face(f).size());
      order.emplace_back(depth, f);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [depth, f] : order) {
      std::vector<Point> corners;
      for (const std::uint32_t v : at->face(f)) corners.push_back(view(at->points[v]));
      canvas.polygon(corners, {blue, round > 2 ? 0.5 : 1.0, "#eaf2f8"});
    }
    drawings.push_back(std::move(canvas));
  }
  return Picture{sheet(drawings), drawings.size(), 0};
}

}  // namespace trimloop::io::plot
