#include "formats/iges/names.h"
#include "formats/iges/records/curves.h"
#include "io/iges/annotation.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

using Stroke = std::vector<Point>;

// Chords per smooth piece of a curve that is drawn, not measured.
constexpr int chords = 24;
constexpr std::size_t most_hatch_lines = 10'000;

class Drafter {
 public:
  Drafter(Context& context, Annotation& out) : context_(context), out_(out) {}

  void add(const DirectoryEntry& entry, const Transform& outer) {
    Visit visit(context_, entry);
    if (!visit) return;
    context_.state(entry).consumed = true;
    const Transform around = std::exchange(place_, outer * model_placement(context_, entry));
    entity(entry);
    place_ = around;
  }

 private:
  double mm() const { return context_.unit.scale; }
  Point at(double x, double y, double z) const { return apply(place_, Point{x * mm(), y * mm(), z * mm()}); }
  Vector along(double x, double y) const { return apply(place_, Vector{x * mm(), y * mm(), 0}); }

  void stroke(Stroke points) {
    for (const Point& p : points)
      if (!is_finite(p)) return;
    if (points.size() > 1) out_.strokes.push_back(std::move(points));
  }

  // A part that is an annotation of its own, or a curve. The part's matrix is taken first, then that of the whole.
  void part(Ref ref) {
    const DirectoryEntry* e = ref ? context_.file.find(ref) : nullptr;
    if (!e) return;
    if (is_annotation(*e)) {
      add(*e, place_);
    } else if (is_curve(*e)) {
      context_.state(*e).consumed = true;
      curve(moved(context_, model_curve(context_, *e), place_));
    }
  }

  void curve(const CurvePtr& c) {
    if (c && is_bounded(*c)) stroke(sampled(*c));
  }
  static Stroke sampled(const Curve& c) {
    const std::vector<double> pieces = breaks(c);
    const bool straight = std::holds_alternative<Line>(c.shape) || std::holds_alternative<Polyline>(c.shape);
    Stroke out{evaluate(c, pieces.front())};
    for (std::size_t i = 1; i < pieces.size(); ++i)
      for (int k = 1, n = straight ? 1 : chords; k <= n; ++k)
        out.push_back(evaluate(c, Interval{pieces[i - 1], pieces[i]}.at(static_cast<double>(k) / n)));
    return out;
  }

  void entity(const DirectoryEntry& e) {
    if (e.type == iges::CopiousData::type) return segments(e);
    const iges::TableRecord* r = context_.table(e);
    if (!r) return;
    switch (e.type) {
      case 212: case 213: return note(*r);
      case 214: return leader(e, *r);
      case 202: return angular(*r);
      case 208: flag(*r); break;
      case 230: return section(*r);
      default: break;
    }
    for (const Ref ref : pointers(*r)) part(ref);
  }

  // 106: centre lines (20, 21) and section lines (31-38) join points in pairs; a witness line (40) starts at its second.
  void segments(const DirectoryEntry& e) {
    const auto r = context_.decode<iges::CopiousData>(e);
    if (!r) return;
    const std::size_t stride = r->stride(), count = r->values.size() / stride;
    const auto point = [&](std::size_t i) {
      const double* v = r->values.data() + i * stride;
      return at(v[0], v[1], stride == 2 ? r->common_z : v[2]);
    };
    constexpr int witness_line = 40;
    for (std::size_t i = e.form == witness_line ? 1 : 0; i + 1 < count; i += 2) stroke({point(i), point(i + 1)});
  }

  void note(const iges::TableRecord& r) {
    const bool new_note = r.layout->type == 213;
    for (std::size_t i = 1, n = r.count("NS"); i <= n; ++i) {
      TextRun run;
      run.text = r.string("TEXT", {i});
      const iges::Xyz start = r.xyz("XS", "YS", "ZS", {i});
      run.origin = at(start.x, start.y, start.z);
      const double width = r.real(new_note ? "BW" : "WT", {i}), height = r.real(new_note ? "BH" : "HT", {i});
      const double turn = r.real("A", {i}), c = std::cos(turn), s = std::sin(turn);
      const std::int64_t mirror = r.integer("M", {i});
      run.along = (mirror == 1 ? -1.0 : 1.0) * along(width * c, width * s);
      run.up = (mirror == 2 ? -1.0 : 1.0) * along(-height * s, height * c);
      run.slant_rad = r.real("SL", {i});
      run.vertical = r.integer("VH", {i}) == 1;
      if (is_finite(run.origin) && is_finite(run.along) && is_finite(run.up)) out_.texts.push_back(std::move(run));
    }
  }

  // 214: a line from the arrow head along the tail points, and the head.
  void leader(const DirectoryEntry& e, const iges::TableRecord& r) {
    const double z = r.real("ZT"), x = r.real("XH"), y = r.real("YH");
    Stroke line{at(x, y, z)};
    for (std::size_t i = 1, n = r.count("N"); i <= n; ++i) line.push_back(at(r.real("X", {i}), r.real("Y", {i}), z));
    if (r.count("N") > 0) head(e.form, {x, y}, {r.real("X", {1}), r.real("Y", {1})}, z, r.real("AD1"), r.real("AD2"));
    if (arc_centre_ && line.size() == 2)
      arc(*arc_centre_, {x, y}, {r.real("X", {1}), r.real("Y", {1})}, z);
    else
      stroke(std::move(line));
  }

  // Arrow heads by form: open 1, 11; triangles 2, 3; none 4; circles 5, 6; boxes 7, 8; slashes 9, 10; origin 12.
  void head(int form, Uv tip, Uv tail, double z, double length, double width) {
    const Uv back = tail - tip;
    const double size = norm(back);
    if (!(size > 0)) return;
    const Uv d = (1 / size) * back, n{-d.v, d.u};
    const auto p = [&](double along_leader, double beside) {
      const Uv q = tip + along_leader * d + beside * n;
      return at(q.u, q.v, z);
    };
    const double half = width / 2;
    switch (form) {
      case 4: return;
      case 2: case 3: return stroke({p(0, 0), p(length, half), p(length, -half), p(0, 0)});
      case 5: case 6: case 12: {
        Stroke circle;
        for (int i = 0; i <= chords; ++i) {
          const double a = two_pi * i / chords;
          circle.push_back(p(length / 2 * std::cos(a), half * std::sin(a)));
        }
        return stroke(std::move(circle));
      }
      case 7: case 8:
        return stroke({p(-length / 2, half), p(length / 2, half), p(length / 2, -half), p(-length / 2, -half), p(-length / 2, half)});
      case 9: case 10: return stroke({p(length / 2, half), p(-length / 2, -half)});
      default: return stroke({p(length, half), p(0, 0), p(length, -half)});
    }
  }

  void arc(Uv centre, Uv from, Uv to, double z) {
    const Uv a = from - centre, b = to - centre;
    const double turn = std::atan2(cross(a, b), dot(a, b));
    Stroke out;
    for (int i = 0; i <= chords; ++i) {
      const double t = turn * i / chords, c = std::cos(t), s = std::sin(t);
      out.push_back(at(centre.u + c * a.u - s * a.v, centre.v + s * a.u + c * a.v, z));
    }
    stroke(std::move(out));
  }

  // 202: its leaders are arcs about the vertex of the angle.
  void angular(const iges::TableRecord& r) {
    part(r.ref("DENOTE"));
    part(r.ref("DEWIT1"));
    part(r.ref("DEWIT2"));
    arc_centre_ = Uv{r.real("XT"), r.real("YT")};
    part(r.ref("DEARRW1"));
    part(r.ref("DEARRW2"));
    arc_centre_.reset();
  }

  // 208: a flag around its text: twice its letters high, with a tip of 35 degrees.
  void flag(const iges::TableRecord& r) {
    const DirectoryEntry* e = context_.file.find(r.ref("DENOTE"));
    const iges::TableRecord* text = e && e->type == 212 ? context_.table(*e) : nullptr;
    if (!text || text->count("NS") == 0) return;
    const double letter = text->real("HT", {1}), h = 2 * letter, l = text->real("WT", {1}) + 0.4 * letter;
    const double tip = 0.5 * h / std::tan(35 * pi / 180), c = std::cos(r.real("A")), s = std::sin(r.real("A"));
    const iges::Xyz o = r.xyz("XT", "YT", "ZT");
    const auto p = [&](double x, double y) { return at(o.x + c * x - s * y, o.y + s * x + c * y, o.z); };
    stroke({p(0, 0), p(l, 0), p(l + tip, h / 2), p(l, h), p(0, h), p(0, 0)});
  }

  // 230: the hatch lines of the area between boundary and islands, even-odd; the boundary is drawn by itself.
  void section(const iges::TableRecord& r) {
    std::vector<Stroke> rings;
    const auto add_ring = [&](Ref ref) {
      const DirectoryEntry* e = ref ? context_.file.find(ref) : nullptr;
      const CurvePtr c = e && is_curve(*e) ? model_curve(context_, *e) : nullptr;
      if (c && is_bounded(*c)) rings.push_back(sampled(*c));
    };
    add_ring(r.ref("BNDP"));
    for (std::size_t i = 1, n = r.count("N"); i <= n; ++i) add_ring(r.ref("ISLNDP", {i}));
    if (rings.empty()) return;
    const double spacing = r.real("DIST") * mm(), angle = r.real("ANGLE");
    const Vector d{std::cos(angle), std::sin(angle), 0}, n{-d.y, d.x, 0};
    const iges::Xyz o = r.xyz("XT", "YT", "ZT");
    const Point origin{o.x * mm(), o.y * mm(), o.z * mm()};
    Interval reach{infinity, -infinity};
    for (const Stroke& ring : rings)
      for (const Point& p : ring) {
        const double h = dot(p - origin, n);
        reach = {std::min(reach.lo, h), std::max(reach.hi, h)};
      }
    if (r.integer("PATRN") != 0 && spacing > 0 && reach.length() / spacing < static_cast<double>(most_hatch_lines))
      for (double k = std::ceil(reach.lo / spacing); k * spacing <= reach.hi; ++k) hatch(rings, origin, d, n, k * spacing);
    for (Stroke& ring : rings) {
      for (Point& p : ring) p = apply(place_, p);
      stroke(std::move(ring));
    }
  }

  void hatch(const std::vector<Stroke>& rings, Point origin, Vector d, Vector n, double height) {
    std::vector<double> crossings;
    for (const Stroke& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector a = ring[i] - origin, b = ring[(i + 1) % ring.size()] - origin;
        const double ha = dot(a, n) - height, hb = dot(b, n) - height;
        if ((ha < 0) == (hb < 0)) continue;
        crossings.push_back(dot(a, d) + ha / (ha - hb) * dot(b - a, d));
      }
    std::sort(crossings.begin(), crossings.end());
    const auto p = [&](double t) { return apply(place_, origin + height * n + t * d); };
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) stroke({p(crossings[i]), p(crossings[i + 1])});
  }

  Context& context_;
  Annotation& out_;
  Transform place_;                // of the entity being drawn: its own matrix, then those of its owners
  std::optional<Uv> arc_centre_;   // leaders of an angular dimension
};

}  // namespace

bool is_annotation(const DirectoryEntry& e) {
  switch (e.type) {
    case 202: case 204: case 206: case 208: case 210: case 212: case 213: case 214: case 216: case 218: case 220:
    case 222: case 228: case 230: return true;
    case 106: return e.form >= 20 && e.form <= 40;
    default: return false;
  }
}

Annotation read_annotation(Context& context, const DirectoryEntry& entry) {
  Annotation out;
  out.kind = iges::form_name(entry.type, entry.form);
  if (out.kind.empty()) out.kind = iges::entity_name(entry.type);
  out.source.push_back(source_of(entry));
  Drafter(context, out).add(entry, {});
  return out;
}

}  // namespace trimloop::io::iges_import
