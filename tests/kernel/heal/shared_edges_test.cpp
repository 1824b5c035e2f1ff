// Edges that several faces name: where one face has them cut, they are cut for all, in whatever order the faces come.

#include "tests/kernel/heal/helpers.h"

namespace trimloop::heal::test {

BOOST_AUTO_TEST_SUITE(shared_edges)

namespace {

// A full circle as an edge of the body, with its vertex at `angle`.
EdgeId add_circle(Body& body, Point centre, double radius, double angle) {
  Circle c = horizontal_circle(centre, radius);
  c.range = {angle, angle + two_pi};
  Edge e;
  e.curve = curve(c);
  e.range = c.range;
  e.start = e.end = body.add(Vertex{evaluate(*e.curve, angle), 0});
  return body.add(e);
}

EdgeId add_line(Body& body, VertexId a, VertexId b) {
  Edge e;
  e.curve = curve(Line{body[a].point, body[b].point});
  e.range = {0, 1};
  e.start = a, e.end = b;
  return body.add(e);
}

TrimSegment on(EdgeId edge, bool reversed = false) {
  TrimSegment s;
  s.edge = edge;
  s.curve_reversed = reversed;
  return s;
}

// A drum of radius 1 and height 2 on `side`: its faces in the order given, its volume.
double drum_volume(const SurfacePtr& side, const std::array<int, 3>& order, std::size_t& edges) {
  Body body;
  const EdgeId low = add_circle(body, {0, 0, 0}, 1, 0.7), high = add_circle(body, {0, 0, 2}, 1, 2.9);
  FaceInput faces[3];
  faces[0].surface = side;
  faces[0].loops = {loop_of(on(low)), loop_of(on(high, true))};
  faces[1].surface = surface(Plane{frame_at({0, 0, 2})});
  faces[1].loops = {loop_of(on(high))};
  faces[2].surface = surface(Plane{frame_at({0, 0, 0})});
  faces[2].loops = {loop_of(on(low))};  // about Su x Sv, which looks into the drum
  faces[2].reversed = true;
  SharedEdges shared;
  Shell shell;
  for (const int i : order) {
    faces[i].brep_sense = true;
    faces[i].shared = &shared;
    const FaceOutcome made = add_face(body, faces[i]);
    BOOST_TEST((body[made.face].status == FaceStatus::Ok), body[made.face].reason);
    shell.faces.push_back({made.face, false});
  }
  const ShellId id = body.add(shell);
  finish_shell(body, id);
  check_sound(body, 1e-3);
  BOOST_TEST(body[id].closed);
  edges = body.edges.size();
  return volume(body, id).value_or(Measured{}).value;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_seam_of_a_drum_cuts_the_circles_for_the_discs_too) {
  for (const SurfacePtr& side : {surface(Cylinder{frame_at({0, 0, 0}), 1}), surface(nurbs_cylinder(2))}) {
    std::array<int, 3> order{0, 1, 2};
    do {
      std::size_t edges = 0;
      BOOST_TEST(std::abs(drum_volume(side, order, edges) - two_pi) < 1e-6);
      // The seam, and a circle in two parts: one of them where the seam is at a vertex of the other, both on the spline.
      BOOST_TEST(edges == (std::holds_alternative<Cylinder>(side->shape) ? 4u : 5u));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

BOOST_AUTO_TEST_CASE(two_surfaces_cut_one_edge_at_two_places) {
  // Tubes above and below one circle, each a spline with its seam elsewhere.
  Body body;
  const EdgeId low = add_circle(body, {0, 0, 0}, 1, 0.7), middle = add_circle(body, {0, 0, 1}, 1, 0.8), high = add_circle(body, {0, 0, 2}, 1, 0.9);
  const auto turned = [](double angle, double z) {
    Frame f;
    f.x = {std::cos(angle), std::sin(angle), 0};
    f.y = {-std::sin(angle), std::cos(angle), 0};
    Transform t;
    t.r = {{{f.x.x, f.y.x, 0}, {f.x.y, f.y.y, 0}, {0, 0, 1}}};
    t.t = {0, 0, z};
    return std::make_shared<const Surface>(*transformed(Surface{nurbs_cylinder(1)}, t));
  };
  SharedEdges shared;
  double area = 0;
  const std::pair<EdgeId, EdgeId> rims[] = {{low, middle}, {middle, high}};
  for (int i = 0; i < 2; ++i) {
    FaceInput in;
    in.surface = turned(2.0 + i, i);
    in.loops = {loop_of(on(rims[i].first)), loop_of(on(rims[i].second, true))};
    in.brep_sense = true;
    in.shared = &shared;
    area += trimloop::area(body, add_face(body, in).face).value;
  }
  check_sound(body, 1e-3);
  BOOST_TEST(std::abs(area - 4 * pi) < 1e-6);
  BOOST_TEST(shared.parts(middle).size() == 3u);
  BOOST_TEST(shared.whole(body, middle).range.length() == two_pi);
  for (const EdgeId part : shared.parts(middle)) {
    int uses = 0;
    for (const Loop& loop : body.loops)
      for (const Coedge& c : loop.coedges) uses += c.edge == part;
    BOOST_TEST(uses == 2);
  }
}

BOOST_AUTO_TEST_CASE(a_loop_that_crosses_itself_cuts_its_neighbours_edge) {
  // A bow-tie (0,0) (2,2) (2,0) (0,2) whose first stroke is also the side of a triangle (0,0) (2,2) (0,3).
  for (const bool bow_first : {true, false}) {
    Body body;
    const VertexId a = body.add(Vertex{{0, 0, 0}, 0}), b = body.add(Vertex{{2, 2, 0}, 0});
    const EdgeId stroke = add_line(body, a, b);
    SharedEdges shared;
    FaceInput bow = input(Plane{}, {loop_of(on(stroke), drawn({2, 2}, {2, 0}), drawn({2, 0}, {0, 2}), drawn({0, 2}, {0, 0}))});
    FaceInput triangle = input(Plane{}, {loop_of(on(stroke), drawn({2, 2}, {0, 3}), drawn({0, 3}, {0, 0}))});
    bow.shared = triangle.shared = &shared;
    double area = 0;
    for (const FaceInput* in : bow_first ? std::array{&bow, &triangle} : std::array{&triangle, &bow}) area += trimloop::area(body, add_face(body, *in).face).value;
    check_sound(body, 1e-3);
    BOOST_TEST(std::abs(area - 5) < 1e-9);
    BOOST_TEST(shared.parts(stroke).size() == 2u);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace trimloop::heal::test
