#include "tests/kernel/mesh/bodies.h"

namespace trimloop::test {
namespace {

CurvePtr share(Curve c) { return std::make_shared<const Curve>(std::move(c)); }

IsoCurve line(Point a, Point b) { return {share({Line{a, b}}), {0, 1}}; }

Vector radial(const Frame& f, double u) { return std::cos(u) * f.x + std::sin(u) * f.y; }

IsoCurve parallel(const Frame& f, double radius, double height, Interval range) {
  Frame g = f;
  g.origin = f.origin + height * f.z;
  return {share({Circle{g, radius, range}}), range};
}

IsoCurve meridian(const Frame& f, double centre, double radius, double u, Interval range) {
  const Frame g{f.origin + centre * radial(f, u), radial(f, u), f.z, cross(radial(f, u), f.z)};
  return {share({Circle{g, radius, range}}), range};
}

Coedge coedge(EdgeId edge, bool reversed, Uv a, Uv b, Interval = {}) {
  Coedge c;
  c.edge = edge;
  c.reversed = reversed;
  c.pcurve = make_line2(a, b);
  c.pcurve_range = {0, 1};
  return c;
}

EdgeId add_edge(Body& body, IsoCurve curve, VertexId start, VertexId end) {
  Edge e;
  e.curve = curve.curve;
  e.range = curve.range;
  e.start = start, e.end = end;
  return body.add(std::move(e));
}

}  // namespace

IsoCurve iso_curve(const Surface& surface, bool along_u, double at, Interval range) {
  const auto point = [&](double t) { return evaluate(surface, along_u ? Uv{t, at} : Uv{at, t}); };
  if (const auto* s = std::get_if<NurbsSurface>(&surface.shape)) {
    NurbsCurve c = along_u ? isocurve_v(*s, at) : isocurve_u(*s, at);
    return {share({c.with_range(range)}), range};
  }
  if (const auto* s = std::get_if<Sphere>(&surface.shape))
    return along_u ? parallel(s->frame, s->radius * std::cos(at), s->radius * std::sin(at), range)
                   : meridian(s->frame, 0, s->radius, at, range);
  if (const auto* s = std::get_if<Torus>(&surface.shape))
    return along_u ? parallel(s->frame, s->major_radius + s->minor_radius * std::cos(at), s->minor_radius * std::sin(at), range)
                   : meridian(s->frame, s->major_radius, s->minor_radius, at, range);
  if (const auto* s = std::get_if<Cylinder>(&surface.shape); s && along_u) return parallel(s->frame, s->radius, at, range);
  if (const auto* s = std::get_if<Cone>(&surface.shape); s && along_u)
    return parallel(s->frame, s->radius + at * std::tan(s->half_angle_rad), at, range);
  return line(point(range.lo), point(range.hi));
}

Body patch(Surface shape, Interval u, Interval v, bool reversed) {
  Body body;
  const auto surface = std::make_shared<const Surface>(std::move(shape));
  const auto same = [&](Uv a, Uv b) { return distance(evaluate(*surface, a), evaluate(*surface, b)) < 1e-9; };
  const auto sides_meet = [&](bool along_u) {
    for (int i = 0; i <= 8; ++i) {
      const double f = i / 8.0;
      if (along_u ? !same({u.at(f), v.lo}, {u.at(f), v.hi}) : !same({u.lo, v.at(f)}, {u.hi, v.at(f)})) return false;
    }
    return true;
  };
  const auto is_pole = [&](bool along_u, double at) {
    for (int i = 1; i <= 8; ++i)
      if (along_u ? !same({u.lo, at}, {u.at(i / 8.0), at}) : !same({at, v.lo}, {at, v.at(i / 8.0)})) return false;
    return true;
  };
  const Uv corner[4] = {{u.lo, v.lo}, {u.hi, v.lo}, {u.hi, v.hi}, {u.lo, v.hi}};
  VertexId vertex[4];
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < i && !vertex[i]; ++k)
      if (same(corner[i], corner[k])) vertex[i] = vertex[k];
    if (!vertex[i]) vertex[i] = body.add(Vertex{evaluate(*surface, corner[i])});
  }
  const auto side = [&](int a, int b, bool along_u, double at) {
    if (is_pole(along_u, at)) {
      Edge pole;
      pole.range = {0, 1};
      pole.start = pole.end = vertex[a];
      pole.is_pole = true;
      return body.add(std::move(pole));
    }
    return add_edge(body, iso_curve(*surface, along_u, at, along_u ? u : v), vertex[a], vertex[b]);
  };
  const EdgeId bottom = side(0, 1, true, v.lo), left = side(0, 3, false, u.lo);
  const EdgeId top = sides_meet(true) ? bottom : side(3, 2, true, v.hi);
  const EdgeId right = sides_meet(false) ? left : side(1, 2, false, u.hi);
  Loop loop;
  loop.coedges = {coedge(bottom, false, corner[0], corner[1]), coedge(right, false, corner[1], corner[2]),
                  coedge(top, true, corner[3], corner[2]), coedge(left, true, corner[0], corner[3])};
  Face face;
  face.surface = surface;
  face.reversed = reversed;
  face.loops = {body.add(std::move(loop))};
  body.add(std::move(face));
  return body;
}

Body box(double x, double y, double z) {
  Body body;
  body.kind = BodyKind::Solid;
  VertexId vertex[8];
  for (int i = 0; i < 8; ++i) vertex[i] = body.add(Vertex{{i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0}});
  const auto edge_between = [&](VertexId a, VertexId b) {
    for (std::uint32_t i = 0; i < body.edges.size(); ++i) {
      if (body.edges[i].start == a && body.edges[i].end == b) return std::pair{EdgeId{i}, false};
      if (body.edges[i].start == b && body.edges[i].end == a) return std::pair{EdgeId{i}, true};
    }
    return std::pair{add_edge(body, line(body[a].point, body[b].point), a, b), false};
  };
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    const Point origin = body[vertex[q[0]]].point;
    const Vector a = body[vertex[q[1]]].point - origin, b = body[vertex[q[3]]].point - origin;
    const Frame frame = make_frame(origin, cross(a, b), a);
    Face face;
    face.surface = std::make_shared<const Surface>(Surface{Plane{frame}});
    Loop loop;
    for (int i = 0; i < 4; ++i) {
      const VertexId from = vertex[q[i]], to = vertex[q[(i + 1) % 4]];
      const auto found = edge_between(from, to);
      const auto uv = [&](VertexId id) {
        const Vector d = body[id].point - origin;
        return Uv{dot(d, frame.x), dot(d, frame.y)};
      };
      loop.coedges.push_back(found.second ? coedge(found.first, true, uv(to), uv(from))
                                          : coedge(found.first, false, uv(from), uv(to)));
    }
    face.loops = {body.add(std::move(loop))};
    body.add(std::move(face));
  }
  return body;
}

namespace {

Coedge circle_coedge(EdgeId edge, bool reversed, Uv centre, double radius, bool mirrored) {
  Coedge c;
  c.edge = edge;
  c.reversed = reversed;
  Frame frame{{centre.u, centre.v, 0}};
  if (mirrored) frame.y = -frame.y, frame.z = -frame.z;
  c.pcurve.curve.shape = Circle{frame, radius, {0, two_pi}};
  c.pcurve_range = {0, two_pi};
  return c;
}

}  // namespace

Body capped_cylinder(double radius, double height) {
  Body body = patch({Cylinder{{}, radius}}, {0, two_pi}, {0, height});
  body.kind = BodyKind::Solid;
  const EdgeId bottom{0}, top{2};
  const auto add_cap = [&](Frame frame, EdgeId edge, bool mirrored) {
    Face face;
    face.surface = std::make_shared<const Surface>(Surface{Plane{frame}});
    Loop loop;
    loop.coedges = {circle_coedge(edge, mirrored, {0, 0}, radius, mirrored)};
    face.loops = {body.add(std::move(loop))};
    body.add(std::move(face));
  };
  add_cap(Frame{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, bottom, true);
  add_cap(Frame{{0, 0, height}}, top, false);
  return body;
}

Body plate(double width, double height, int holes_per_side, double hole_radius) {
  Body body;
  Face face;
  face.surface = std::make_shared<const Surface>(Surface{Plane{}});
  const Uv corner[4] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  VertexId vertex[4];
  for (int i = 0; i < 4; ++i) vertex[i] = body.add(Vertex{{corner[i].u, corner[i].v, 0}});
  Loop outer;
  for (int i = 0; i < 4; ++i) {
    const int k = (i + 1) % 4;
    const EdgeId e = add_edge(body, line(body[vertex[i]].point, body[vertex[k]].point), vertex[i], vertex[k]);
    outer.coedges.push_back(coedge(e, false, corner[i], corner[k]));
  }
  face.loops.push_back(body.add(std::move(outer)));
  for (int i = 0; i < holes_per_side; ++i) {
    for (int j = 0; j < holes_per_side; ++j) {
      const Uv centre{width * (i + 0.5) / holes_per_side, height * (j + 0.5) / holes_per_side};
      const VertexId v = body.add(Vertex{{centre.u + hole_radius, centre.v, 0}});
      const Frame frame{{centre.u, centre.v, 0}};
      const EdgeId e = add_edge(body, parallel(frame, hole_radius, 0, {0, two_pi}), v, v);
      Loop hole;
      hole.coedges = {circle_coedge(e, true, centre, hole_radius, false)};
      face.loops.push_back(body.add(std::move(hole)));
    }
  }
  body.add(std::move(face));
  return body;
}

Body disc(double radius, double hole_radius, double offset, double start) {
  Body body;
  Face face;
  face.surface = std::make_shared<const Surface>(Surface{Plane{}});
  const auto add_ring = [&](double r, double x, double from, bool reversed) {
    Frame frame{{x, 0, 0}};
    const double c = std::cos(from), s = std::sin(from);
    frame.x = {c, s, 0}, frame.y = {-s, c, 0};
    const VertexId v = body.add(Vertex{frame.origin + r * frame.x});
    const EdgeId e = add_edge(body, parallel(frame, r, 0, {0, two_pi}), v, v);
    Coedge use = circle_coedge(e, reversed, {x, 0}, r, false);
    use.pcurve.curve.shape = Circle{frame, r, {0, two_pi}};
    Loop loop;
    loop.coedges = {use};
    face.loops.push_back(body.add(std::move(loop)));
  };
  add_ring(radius, 0, 0, false);
  if (hole_radius > 0) add_ring(hole_radius, offset, start, true);
  body.add(std::move(face));
  return body;
}

void add_polygon_loop(Body& body, FaceId face, const std::vector<Uv>& corners) {
  std::vector<VertexId> vertex;
  for (const Uv c : corners) vertex.push_back(body.add(Vertex{{c.u, c.v, 0}}));
  Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t k = (i + 1) % corners.size();
    const EdgeId e = add_edge(body, line(body[vertex[i]].point, body[vertex[k]].point), vertex[i], vertex[k]);
    loop.coedges.push_back(coedge(e, false, corners[i], corners[k]));
  }
  const LoopId id = body.add(std::move(loop));
  body[face].loops.push_back(id);
}

void add_segment_loop(Body& body, FaceId face, double radius, Interval angle) {
  const auto at = [&](double a) { return Uv{radius * std::cos(a), radius * std::sin(a)}; };
  const Uv a = at(angle.lo), b = at(angle.hi);
  const VertexId from = body.add(Vertex{{a.u, a.v, 0}}), to = body.add(Vertex{{b.u, b.v, 0}});
  const EdgeId arc = add_edge(body, parallel({}, radius, 0, angle), from, to);
  const EdgeId chord = add_edge(body, line(body[to].point, body[from].point), to, from);
  Coedge along = circle_coedge(arc, false, {0, 0}, radius, false);
  along.pcurve.curve.shape = Circle{{}, radius, angle};
  along.pcurve_range = angle;
  Loop loop;
  loop.coedges = {along, coedge(chord, false, b, a)};
  const LoopId id = body.add(std::move(loop));
  body[face].loops.push_back(id);
}

NurbsSurface nurbs_torus(double major_radius, double minor_radius, bool half_turn) {
  const double w = std::sqrt(0.5);
  const Uv square[9] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  const int first = half_turn ? 6 : 0, arcs = half_turn ? 2 : 4;  // a sphere runs from the south to the north pole
  const auto knots = [](int n) {
    std::vector<double> k{0, 0, 0};
    for (int i = 1; i < n; ++i) k.insert(k.end(), 2, i);
    k.insert(k.end(), 3, n);
    return k;
  };
  std::vector<Hpoint> poles;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j <= 2 * arcs; ++j) {
      const Uv c = square[i], p = square[(first + j) % 8];
      const double r = major_radius + minor_radius * p.u, weight = (i % 2 ? w : 1) * (j % 2 ? w : 1);
      poles.push_back(weight * Hpoint{r * c.u, r * c.v, minor_radius * p.v, 1});
    }
  }
  return *NurbsSurface::from_homogeneous(2, 2, knots(4), knots(arcs), poles);
}

NurbsSurface wavy_patch(int n, double size, double amplitude) {
  std::vector<double> knots(4, 0.0);
  for (int i = 1; i < n - 3; ++i) knots.push_back(i);
  knots.insert(knots.end(), 4, n - 3);
  std::vector<Point> poles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = size * i / (n - 1), y = size * j / (n - 1);
      const double s = 100 / size * x, t = 100 / size * y;
      poles.push_back({x, y, amplitude * (std::sin(s / 9) * std::cos(t / 13) + std::sin(0.003 * s * t) / 3)});
    }
  return *NurbsSurface::from_cartesian(3, 3, knots, knots, poles, {});
}

}  // namespace trimloop::test
