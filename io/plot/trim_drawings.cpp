// The loops of a face in its parameter plane: as they are used, as they were given, and where they were repaired or why
// they could not be.

#include <fmt/format.h>

#include <algorithm>

#include "io/plot/drawings.h"
#include "kernel/heal/make_face.h"
#include "kernel/pcurve/sheet.h"

namespace trimloop::io::plot {
namespace {

constexpr double wide = 900, high = 640;

// One segment or coedge on the page.
struct Stroke {
  std::vector<Point> points;  // u, v
  std::size_t loop = 0, index = 0;
  bool is_pole = false;
  double gap_mm = 0;          // of a coedge: pcurve against edge
};

struct Mark {
  Point at;
  std::string text;
  std::optional<Point> from;  // of a gap: its ends, `at` is the other
};

class TrimDrawing {
 public:
  TrimDrawing(const Body& body, const Face& face)
      : body_(body), face_(face), repair_(face.repair.get()), sheet_(*face.surface, repair_ ? repair_->tolerance_mm : 1e-6) {}

  Canvas draw(const std::string& title) {
    for (std::size_t l = 0; l < face_.loops.size(); ++l) take_loop(l);
    if (repair_) {
      for (std::size_t l = 0; l < repair_->loops.size(); ++l) take_given(l);
      find_gaps();
      take_steps();
    }
    const SurfaceDomain d = sheet_.domain();
    Box box;
    for (const auto* all : {&used_, &given_})
      for (const Stroke& s : *all)
        for (const Point& p : s.points) box.add(p);
    for (const Mark& m : marks_) box.add(m.at);
    if (d.is_bounded()) box.add(Point{d.u.lo, d.v.lo, 0}), box.add(Point{d.u.hi, d.v.hi, 0});
    const std::vector<std::string> notes = notes_of();
    Canvas canvas(title, box, wide, high, true, notes.size());
    for (const std::string& n : notes) canvas.note(n);
    canvas.axes("u", "v");
    if (d.is_bounded())
      canvas.polygon({{d.u.lo, d.v.lo, 0}, {d.u.hi, d.v.lo, 0}, {d.u.hi, d.v.hi, 0}, {d.u.lo, d.v.hi, 0}}, {grey, 1.5, "none", "8 4"});
    const bool failed = used_.empty();
    for (const Stroke& s : given_) stroke(canvas, s, {failed ? series_colour(s.loop) : grey, failed ? 2.0 : 4.0, "none", failed ? "" : "2 4"}, failed);
    for (const Stroke& s : used_) stroke(canvas, s, {s.is_pole ? grey : series_colour(s.loop), 2}, true);
    for (const Mark& m : marks_) {
      if (m.from) canvas.line(*m.from, m.at, {red, 1.5, "none", "3 3"}), canvas.square(*m.from, 6, {red, 2});
      canvas.square(m.at, 6, {red, 2});
      canvas.label(m.at, m.text, red, 10, -8);
    }
    return canvas;
  }

 private:
  static constexpr std::size_t most_strokes = 20'000, most_marks = 40;

  void take_loop(std::size_t l) {
    std::size_t index = 0;
    for (const Coedge& c : body_[face_.loops[l]].coedges) {
      if (used_.size() == most_strokes) return;
      Stroke s{{}, l, index++, body_[c.edge].is_pole, c.gap_mm};
      for (const double t : stops_of(c)) s.points.push_back(evaluate(c.pcurve.curve, t));
      keep(std::move(s), used_);
    }
  }

  // Parameters of the pcurve in loop direction, its corners among them.
  static std::vector<double> stops_of(const Coedge& c) {
    const double from = c.reversed ? c.pcurve_range.hi : c.pcurve_range.lo, to = c.reversed ? c.pcurve_range.lo : c.pcurve_range.hi;
    std::vector<double> stops;
    for (int i = 0; i <= 64; ++i) stops.push_back(from + i / 64.0 * (to - from));
    for (const double b : breaks(c.pcurve.curve))
      if ((b - from) * (to - b) > 0) stops.push_back(b);
    std::sort(stops.begin(), stops.end());
    if (from > to) std::reverse(stops.begin(), stops.end());
    return stops;
  }

  void take_given(std::size_t l) {
    std::size_t index = 0;
    for (const heal::TrimSegment& segment : repair_->loops[l].segments) {
      if (given_.size() == most_strokes) return;
      Stroke s{{}, l, index++};
      if (segment.pcurve && is_bounded(segment.pcurve->curve)) {
        s.points = sampled(segment.pcurve->curve);
        if (segment.pcurve_reversed) std::reverse(s.points.begin(), s.points.end());
      } else if (segment.curve && is_bounded(*segment.curve)) {
        std::vector<Point> points = sampled(*segment.curve);
        if (segment.curve_reversed) std::reverse(points.begin(), points.end());
        std::optional<Uv> last = given_.empty() ? std::nullopt : std::optional(Uv{given_.back().points.back().x, given_.back().points.back().y});
        for (const Point& p : points) {
          last = last ? sheet_.foot_near(p, *last).uv : sheet_.foot(p).uv;
          s.points.push_back({last->u, last->v, 0});
        }
      }
      keep(std::move(s), given_);
    }
  }

  static void keep(Stroke s, std::vector<Stroke>& out) {
    std::erase_if(s.points, [](const Point& p) { return !is_finite(p); });
    if (s.points.size() > 1) out.push_back(std::move(s));
  }

  void mark(Point at, std::string text, std::optional<Point> from = std::nullopt) {
    if (is_finite(at) && marks_.size() < most_marks) marks_.push_back({at, std::move(text), from});
  }

  // Between neighbours as given; in space, so that a jump over a seam or at a pole is none.
  void find_gaps() {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const bool ends = i + 1 == given_.size() || given_[i + 1].loop != given_[i].loop;
      std::size_t next = i + 1;
      if (ends)
        for (next = i; next > 0 && given_[next - 1].loop == given_[i].loop;) --next;
      const Point a = given_[i].points.back(), b = given_[next].points.front();
      const double gap = distance(sheet_.point({a.x, a.y}), sheet_.point({b.x, b.y}));
      if (gap > repair_->tolerance_mm)
        mark(b, fmt::format("gap of {:.3g} mm, from segment {} of loop {}", gap, given_[i].index + 1, given_[i].loop + 1), a);
    }
  }

  void take_steps() {
    for (const heal::StepRecord& s : repair_->steps) {
      using heal::Step;
      const bool shown = s.step == Step::LoopSplit || s.step == Step::LoopsParted || s.step == Step::SelfTouching || s.step == Step::Clamped || s.step == Step::LoopDropped ||
                         s.step == Step::DuplicateRemoved || s.step == Step::CurveDropped || s.step == Step::PcurveReplaced;
      if (!shown || !is_finite(s.at)) continue;
      const Uv uv = sheet_.foot(s.at).uv;
      const double size = std::max(s.before_mm, s.after_mm);
      mark({uv.u, uv.v, 0}, size > 0 ? fmt::format("{} {:.3g} mm", to_string(s.step), size) : std::string(to_string(s.step)));
    }
  }

  std::vector<std::string> notes_of() const {
    constexpr std::size_t column = 118;
    std::vector<std::string> out;
    const std::string_view status = face_.status == FaceStatus::Ok ? "ok" : face_.status == FaceStatus::Healed ? "healed" : "failed";
    std::string text(status);
    if (!face_.reason.empty()) text += ": " + face_.reason;
    while (text.size() > column) {
      const std::size_t space = text.rfind(' ', column);
      const std::size_t end = space == std::string::npos || space == 0 ? column : space;
      out.push_back(text.substr(0, end));
      text.erase(0, end + (text[end] == ' '));
    }
    out.push_back(text);
    if (repair_ && !used_.empty()) out.emplace_back("colours: as used; dotted grey: as given; red: places of gaps and repairs; dashed: border of the surface");
    else if (repair_) out.emplace_back("the loops as given; red: places of gaps and repairs; dashed: border of the surface");
    return out;
  }

  static void stroke(Canvas& canvas, const Stroke& s, const Pen& pen, bool with_arrow) {
    canvas.polyline(s.points, pen);
    if (!with_arrow) return;
    const std::size_t m = s.points.size() / 2;
    canvas.arrow(s.points[m > 0 ? m - 1 : 0], s.points[m], {pen.colour, 2});
    canvas.dot(s.points.front(), 3, ink, fmt::format("loop {}, part {} starts; curve and surface {:.3g} mm apart", s.loop + 1, s.index + 1, s.gap_mm));
    if (s.index == 0) canvas.label(s.points.front(), fmt::format("loop {}", s.loop + 1), pen.colour, 6, 14);
  }

  const Body& body_;
  const Face& face_;
  const heal::Repair* repair_;
  const pcurve::Sheet sheet_;
  std::vector<Stroke> used_, given_;
  std::vector<Mark> marks_;
};

}  // namespace

Canvas draw_trims(const std::string& title, const Body& body, FaceId id) {
  return TrimDrawing(body, body.faces[id.index]).draw(title);
}

}  // namespace trimloop::io::plot
