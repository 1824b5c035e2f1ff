#include "tests/support/builders.h"

#include <array>
#include <map>

#include "kernel/heal/make_face.h"

namespace trimloop::test {
namespace {

template <class T>
CurvePtr curve(T shape) {
  return std::make_shared<const Curve>(Curve{std::move(shape)});
}
template <class T>
SurfacePtr surface(T shape) {
  return std::make_shared<const Surface>(Surface{std::move(shape)});
}
Frame frame_at(Point origin) {
  Frame f;
  f.origin = origin;
  return f;
}
Frame facing_down(Point origin) {
  Frame f;
  f.origin = origin;
  f.y = {0, -1, 0};
  f.z = {0, 0, -1};
  return f;
}

EdgeId edge(Body& body, CurvePtr c, VertexId start, VertexId end) {
  Edge e;
  e.curve = c;
  e.range = range(*c);
  e.start = start;
  e.end = end;
  // sin(2 pi) is not quite 0.
  for (const auto& [id, t] : {std::pair{start, e.range.lo}, std::pair{end, e.range.hi}})
    body[id].gap_mm = std::max(body[id].gap_mm, distance(body[id].point, evaluate(*c, t)));
  return body.add(std::move(e));
}

EdgeId pole(Body& body, VertexId at, Interval range) {
  Edge e;
  e.range = range;
  e.start = e.end = at;
  e.is_pole = true;
  return body.add(std::move(e));
}

Coedge use(EdgeId id, Curve2 pcurve, bool reversed = false) {
  Coedge c;
  c.edge = id;
  c.reversed = reversed;
  c.pcurve_range = range(pcurve);
  c.pcurve = std::move(pcurve);
  c.gap_mm = 1e-12;
  return c;
}

FaceId face(Body& body, SurfacePtr s, std::vector<std::vector<Coedge>> loops) {
  Face f;
  f.surface = std::move(s);
  for (auto& coedges : loops) {
    Loop loop;
    loop.coedges = std::move(coedges);
    f.loops.push_back(body.add(std::move(loop)));
  }
  return body.add(std::move(f));
}

void close_solid(Body& body) {
  body.kind = BodyKind::Solid;
  Shell shell;
  for (std::uint32_t i = 0; i < body.faces.size(); ++i) shell.faces.push_back({FaceId{i}, false});
  heal::finish_shell(body, body.add(std::move(shell)));
}

Circle horizontal_circle(Point centre, double radius) { return {frame_at(centre), radius, {0, two_pi}}; }

// The disc under or over a horizontal circle edge, facing down or up.
void add_cap(Body& body, EdgeId rim, Point centre, double radius, bool up) {
  Circle in_plane{up ? frame_at({0, 0, 0}) : facing_down({0, 0, 0}), radius, {0, two_pi}};
  face(body, surface(Plane{up ? frame_at(centre) : facing_down(centre)}), {{use(rim, Curve2{Curve{in_plane}}, !up)}});
}

}  // namespace

Body box(Point lo, Point hi) {
  Body body;
  std::array<VertexId, 8> corner;
  for (unsigned k = 0; k < 8; ++k)
    corner[k] = body.add(Vertex{{k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y, k & 4 ? hi.z : lo.z}, 0});
  std::map<std::pair<unsigned, unsigned>, EdgeId> edges;
  const auto edge_between = [&](unsigned a, unsigned b) {
    EdgeId& id = edges[{std::min(a, b), std::max(a, b)}];
    const VertexId start = corner[std::min(a, b)], end = corner[std::max(a, b)];
    if (!id) id = edge(body, curve(Line{body[start].point, body[end].point}), start, end);
    return id;
  };
  // Corners counter-clockwise seen from outside.
  const unsigned sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& side : sides) {
    const Point o = body[corner[side[0]]].point;
    Frame f;
    f.origin = o;
    f.x = normalized(body[corner[side[1]]].point - o);
    f.y = normalized(body[corner[side[3]]].point - o);
    f.z = cross(f.x, f.y);
    std::vector<Coedge> loop;
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned a = side[i], b = side[(i + 1) % 4];
      const auto uv = [&](unsigned k) {
        const Vector d = body[corner[k]].point - o;
        return Uv{dot(d, f.x), dot(d, f.y)};
      };
      loop.push_back(use(edge_between(a, b), make_line2(uv(std::min(a, b)), uv(std::max(a, b))), a > b));
    }
    face(body, surface(Plane{f}), {loop});
  }
  close_solid(body);
  return body;
}

Body cylinder(Point base, double r, double h) {
  Body body;
  const Point top = base + Vector{0, 0, h};
  const VertexId low = body.add(Vertex{base + Vector{r, 0, 0}, 0}), high = body.add(Vertex{top + Vector{r, 0, 0}, 0});
  const EdgeId bottom_rim = edge(body, curve(horizontal_circle(base, r)), low, low);
  const EdgeId top_rim = edge(body, curve(horizontal_circle(top, r)), high, high);
  const EdgeId seam = edge(body, curve(Line{body[low].point, body[high].point}), low, high);
  face(body, surface(Cylinder{frame_at(base), r}),
       {{use(bottom_rim, make_line2({0, 0}, {two_pi, 0})), use(seam, make_line2({two_pi, 0}, {two_pi, h})),
         use(top_rim, make_line2({0, h}, {two_pi, h}), true), use(seam, make_line2({0, 0}, {0, h}), true)}});
  add_cap(body, bottom_rim, base, r, false);
  add_cap(body, top_rim, top, r, true);
  close_solid(body);
  return body;
}

Body cone(Point base, double r, double h) {
  Body body;
  const VertexId low = body.add(Vertex{base + Vector{r, 0, 0}, 0}), apex = body.add(Vertex{base + Vector{0, 0, h}, 1e-12});
  const EdgeId rim = edge(body, curve(horizontal_circle(base, r)), low, low);
  const EdgeId seam = edge(body, curve(Line{body[low].point, body[apex].point}), low, apex);
  const EdgeId tip = pole(body, apex, {0, 1});
  face(body, surface(Cone{frame_at(base), r, -std::atan2(r, h)}),
       {{use(rim, make_line2({0, 0}, {two_pi, 0})), use(seam, make_line2({two_pi, 0}, {two_pi, h})),
         use(tip, make_line2({two_pi, h}, {0, h})), use(seam, make_line2({0, 0}, {0, h}), true)}});
  add_cap(body, rim, base, r, false);
  close_solid(body);
  return body;
}

Body sphere(Point c, double r) {
  Body body;
  const VertexId south = body.add(Vertex{c - Vector{0, 0, r}, 1e-12}), north = body.add(Vertex{c + Vector{0, 0, r}, 1e-12});
  Circle meridian;
  meridian.frame = {c, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  meridian.radius = r;
  meridian.range = {-pi / 2, pi / 2};
  const EdgeId seam = edge(body, curve(meridian), south, north);
  const EdgeId low = pole(body, south, {0, 1}), high = pole(body, north, {0, 1});
  face(body, surface(Sphere{frame_at(c), r}),
       {{use(low, make_line2({0, -pi / 2}, {two_pi, -pi / 2})),
         use(seam, make_line2({two_pi, -pi / 2}, {two_pi, pi / 2})),
         use(high, make_line2({two_pi, pi / 2}, {0, pi / 2})),
         use(seam, make_line2({0, -pi / 2}, {0, pi / 2}), true)}});
  close_solid(body);
  return body;
}

Body torus(Point c, double major, double minor) {
  Body body;
  const VertexId v = body.add(Vertex{c + Vector{major + minor, 0, 0}, 0});
  Circle tube;
  tube.frame = {c + Vector{major, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  tube.radius = minor;
  const EdgeId along_u = edge(body, curve(horizontal_circle(c, major + minor)), v, v);
  const EdgeId along_v = edge(body, curve(tube), v, v);
  face(body, surface(Torus{frame_at(c), major, minor}),
       {{use(along_u, make_line2({0, 0}, {two_pi, 0})), use(along_v, make_line2({two_pi, 0}, {two_pi, two_pi})),
         use(along_u, make_line2({0, two_pi}, {two_pi, two_pi}), true),
         use(along_v, make_line2({0, 0}, {0, two_pi}), true)}});
  close_solid(body);
  return body;
}

Body plate(double width, double depth, const std::vector<RoundHole>& holes) {
  Body body;
  const Uv corners[] = {{0, 0}, {width, 0}, {width, depth}, {0, depth}};
  std::vector<std::vector<Coedge>> loops(1);
  std::array<VertexId, 4> at;
  for (std::size_t i = 0; i < 4; ++i) at[i] = body.add(Vertex{{corners[i].u, corners[i].v, 0}, 0});
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t k = (i + 1) % 4;
    const EdgeId side = edge(body, curve(Line{body[at[i]].point, body[at[k]].point}), at[i], at[k]);
    loops[0].push_back(use(side, make_line2(corners[i], corners[k])));
  }
  for (const RoundHole& hole : holes) {
    const Circle circle = horizontal_circle({hole.x, hole.y, 0}, hole.radius);
    const VertexId start = body.add(Vertex{{hole.x + hole.radius, hole.y, 0}, 0});
    loops.push_back({use(edge(body, curve(circle), start, start), Curve2{Curve{circle}}, true)});
  }
  face(body, surface(Plane{}), std::move(loops));
  return body;
}

}  // namespace trimloop::test
