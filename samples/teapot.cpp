// Newell's patches run through one another: the spout and the handle stick into the body. Here each pair that meets is
// intersected, the pieces of the intersection are chained in the parameter plane of each patch, and the patch keeps
// what lies to the left of its chains.

#include "samples/teapot.h"

#include <algorithm>
#include <array>

#include "samples/teapot_data.h"

namespace samples {

using namespace trimloop;

namespace {

constexpr double scale_mm = 20;      // the body is 80 mm across
constexpr double same_place = 1e-5;  // mm; branches of an intersection meet at their ends to 1e-6

// One patch of the model, and the curves that cut it.
struct Patch {
  NurbsSurface surface;
  bool reversed = false;
  Uv keep;  // a place that is not cut off
  struct Cut {
    CurvePtr curve;
    Curve2 image;
  };
  std::vector<Cut> cuts;
};

NurbsSurface bezier(int which, double mirror_x, double mirror_y) {
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<Point> points;
  for (const int i : teapot::patches[static_cast<std::size_t>(which)]) {
    const auto& c = teapot::points[static_cast<std::size_t>(i)];
    points.push_back({scale_mm * mirror_x * c[0], scale_mm * mirror_y * c[1], scale_mm * c[2]});
  }
  return *NurbsSurface::from_cartesian(3, 3, knots, knots, points, {});
}

// Both patches get the curves in which they meet.
void cut(Patch& a, Patch& b) {
  const auto meeting = intersect(Surface{a.surface}, Surface{b.surface});
  if (!meeting) return;
  for (const IntersectionBranch& branch : meeting->branches) {
    if (range(branch.curve).length() < 1e-3) continue;  // mm: the handle touches the body's upper patch in its corner
    const auto curve = std::make_shared<const Curve>(branch.curve);
    a.cuts.push_back({curve, branch.first});
    b.cuts.push_back({curve, branch.second});
  }
}

// ---- A loop around what is kept

Uv end_of(const Curve2& c, bool first) {
  const Interval r = range(c.curve);
  const Point p = evaluate(c.curve, first ? r.lo : r.hi);
  return {p.x, p.y};
}

// Where a place on the border stands along it, 0 .. 4 counter-clockwise from the corner (lo, lo).
double along_border(const NurbsSurface& s, Uv at) {
  const Interval u = s.range_u(), v = s.range_v();
  const double x = (at.u - u.lo) / u.length(), y = (at.v - v.lo) / v.length();
  const std::array<double, 4> off{y, 1 - x, 1 - y, x}, place{x, 1 + y, 3 - x, 4 - y};
  const auto side = static_cast<std::size_t>(std::min_element(off.begin(), off.end()) - off.begin());
  return place[side];
}
Uv on_border(const NurbsSurface& s, double place) {
  static constexpr std::array<Uv, 5> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  const double turn = place >= 4 ? place - 4 : place;
  const auto side = static_cast<std::size_t>(turn);
  const double t = turn - static_cast<double>(side);
  const Uv a = corners[side], b = corners[side + 1];
  return {s.range_u().at(a.u + t * (b.u - a.u)), s.range_v().at(a.v + t * (b.v - a.v))};
}

struct Chain {
  std::vector<heal::TrimSegment> segments;
  Uv start, end;
};

// Cuts end to end, from border to border.
std::vector<Chain> chains_of(const Patch& patch) {
  std::vector<Patch::Cut> left = patch.cuts;
  std::vector<Chain> out;
  const auto apart = [&patch](Uv a, Uv b) { return distance(evaluate(patch.surface, a), evaluate(patch.surface, b)); };
  while (!left.empty()) {
    Chain chain{{}, end_of(left[0].image, true), end_of(left[0].image, true)};
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t i = 0; i < left.size() && !grown; ++i)
        for (const bool turned : {false, true}) {
          const Uv from = end_of(left[i].image, !turned), to = end_of(left[i].image, turned);
          const bool behind = apart(chain.end, from) <= same_place;
          if (!behind && apart(chain.start, to) > same_place) continue;
          heal::TrimSegment segment;
          segment.curve = left[i].curve;
          segment.pcurve = left[i].image;
          segment.curve_reversed = segment.pcurve_reversed = turned;
          chain.segments.insert(behind ? chain.segments.end() : chain.segments.begin(), segment);
          (behind ? chain.end : chain.start) = behind ? to : from;
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
          grown = true;
          break;
        }
    }
    out.push_back(std::move(chain));
  }
  return out;
}

void turn(Chain& chain) {
  std::swap(chain.start, chain.end);
  std::reverse(chain.segments.begin(), chain.segments.end());
  for (heal::TrimSegment& s : chain.segments) {
    s.curve_reversed = !s.curve_reversed;
    s.pcurve_reversed = !s.pcurve_reversed;
  }
}

// Counter-clockwise along the border, corners included.
void walk(const NurbsSurface& s, double from, double to, heal::TrimLoop& loop) {
  if (to <= from) to += 4;
  for (double at = from; at < to;) {
    const double next = std::min(to, std::floor(at) + 1);
    heal::TrimSegment side;
    side.pcurve = make_line2(on_border(s, at), on_border(s, next));
    loop.segments.push_back(side);
    at = next;
  }
}

heal::TrimLoop loop_of(const NurbsSurface& s, const Chain& chain) {
  heal::TrimLoop loop;
  loop.segments = chain.segments;
  walk(s, along_border(s, chain.end), along_border(s, chain.start), loop);
  return loop;
}

// Even-odd over samples of the loop.
bool contains(const heal::TrimLoop& loop, Uv at) {
  bool inside = false;
  for (const heal::TrimSegment& s : loop.segments) {
    const Interval r = range(s.pcurve->curve);
    for (int i = 0; i < 32; ++i) {
      const Point a = evaluate(s.pcurve->curve, r.at(i / 32.0)), b = evaluate(s.pcurve->curve, r.at((i + 1) / 32.0));
      if ((a.y > at.v) != (b.y > at.v) && at.u < a.x + (b.x - a.x) * (at.v - a.y) / (b.y - a.y)) inside = !inside;
    }
  }
  return inside;
}

heal::FaceInput face_of(const Patch& patch) {
  heal::FaceInput face;
  face.surface = std::make_shared<const Surface>(Surface{patch.surface});
  face.reversed = patch.reversed;
  face.tolerance_mm = same_place;
  std::vector<Chain> chains = chains_of(patch);
  if (chains.empty()) return face;
  for (Chain& chain : chains)
    if (!contains(loop_of(patch.surface, chain), patch.keep)) turn(chain);
  // From the end of each chain along the border to the chain that begins next, until all have been passed.
  std::vector<bool> passed(chains.size(), false);
  for (std::size_t first = 0; first < chains.size(); ++first) {
    heal::TrimLoop loop;
    for (std::size_t at = first; !passed[at];) {
      passed[at] = true;
      loop.segments.insert(loop.segments.end(), chains[at].segments.begin(), chains[at].segments.end());
      const double end = along_border(patch.surface, chains[at].end);
      const auto ahead = [&](std::size_t i) {
        const double start = along_border(patch.surface, chains[i].start);
        return start > end ? start - end : start - end + 4;
      };
      std::size_t next = 0;
      for (std::size_t i = 1; i < chains.size(); ++i)
        if (ahead(i) < ahead(next)) next = i;
      walk(patch.surface, end, along_border(patch.surface, chains[next].start), loop);
      at = next;
    }
    if (!loop.segments.empty()) face.loops.push_back(std::move(loop));
  }
  return face;
}

// ---- The pot and its lid

enum Part { Rim, Upper, Lower, Knob, Lid, Bottom, HandleUpper, HandleLower, SpoutLower, SpoutUpper };

Body body_of(std::vector<Patch>& patches, AttributesId attributes) {
  Body body;
  body.attributes = attributes;
  for (const Patch& patch : patches) {
    heal::FaceInput face = face_of(patch);
    face.attributes = attributes;
    heal::add_face(body, face);
  }
  return body;
}

}  // namespace

Model utah_teapot() {
  std::vector<Patch> pot, lid;
  const auto add = [](std::vector<Patch>& to, Part part, double mx, double my, Uv keep) {
    to.push_back({bezier(part, mx, my), mx * my > 0, keep, {}});  // the original patches face inward
    return to.size() - 1;
  };
  for (const double my : {1.0, -1.0}) {
    std::array<std::size_t, 2> upper{}, lower{};  // at x > 0 and at x < 0
    for (const std::size_t side : {0u, 1u}) {
      const double mx = side == 0 ? 1 : -1;
      add(pot, Rim, mx, my, {0.5, 0.5});
      upper[side] = add(pot, Upper, mx, my, {0.5, 0.9});
      lower[side] = add(pot, Lower, mx, my, {0.5, 0.9});
      add(pot, Bottom, mx, my, {0.5, 0.5});
      add(lid, Knob, mx, my, {0.5, 0.5});
      add(lid, Lid, mx, my, {0.5, 0.5});
    }
    const std::size_t spout = add(pot, SpoutLower, 1, my, {0.9, 0.5});
    add(pot, SpoutUpper, 1, my, {0.5, 0.5});
    const std::size_t handle_top = add(pot, HandleUpper, 1, my, {0.9, 0.5}), handle_end = add(pot, HandleLower, 1, my, {0.1, 0.5});
    // The handle as drawn ends short of the body beside the middle: carried on until it is through.
    pot[handle_end].surface = *extended_u(pot[handle_end].surface, End::Finish, 0.15);
    cut(pot[spout], pot[upper[0]]);
    cut(pot[spout], pot[lower[0]]);
    cut(pot[handle_top], pot[upper[1]]);
    cut(pot[handle_end], pot[upper[1]]);
    cut(pot[handle_end], pot[lower[1]]);
  }
  Model model;
  model.name = "teapot";
  model.parts.emplace_back();
  Attributes porcelain;
  porcelain.colour = Colour{0.75, 0.78, 0.82};
  std::vector<Body> bodies;
  for (auto& [name, patches] : {std::pair<const char*, std::vector<Patch>*>{"pot", &pot}, {"lid", &lid}}) {
    porcelain.name = name;
    bodies.push_back(body_of(*patches, model.add(porcelain)));
  }
  heal::SewOptions how;
  how.tolerance_mm = same_place;
  for (Body& body : bodies)
    for (Body& sewn : heal::sew({std::move(body)}, how).bodies) model.parts[0].bodies.push_back(std::move(sewn));
  return model;
}

}  // namespace samples
