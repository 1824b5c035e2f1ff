// The figures of the course notes, each drawn from its textbook data: seeds FOLDER writes them as SVG; seeds --list prints
// the table of docs/seeds.md; seeds --examples works the examples out and says how far off each result is.

#include "samples/seeds.h"

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "samples/hull.h"
#include "samples/teapot.h"

namespace {

using namespace trimloop;
using io::plot::What;
using Picture = Result<io::plot::Picture>;

Picture drawn(const Model& model, What what, std::optional<double> at = {}) {
  io::plot::Options how;
  how.what = what;
  how.at = at;
  return io::plot::draw(model, {}, how);
}

Picture described(What what, const char* json, std::optional<double> at = {}) {
  const io::ReadResult in = io::read_bytes(json, "figure.json");
  if (!in.usable) return fail(ErrorCode::InvalidArgument, in.report.items().front().text);
  return drawn(in.model, what, at);
}

Picture subdivided(subdivision::Scheme scheme) {
  subdivision::ControlMesh cube;
  cube.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}, {2, 2, 2}};
  for (const std::array<std::uint32_t, 4>& face : {std::array<std::uint32_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    cube.add_face(face);
  return io::plot::draw_subdivision(cube, scheme, 3);
}

// Trimming loops of one of the faces that the spout is cut out of: a side at x > 0 with five edges.
Picture trimmed_body() {
  Model model = samples::utah_teapot();
  Body pot = model.parts[0].bodies[0];
  for (const Face& face : pot.faces) {
    if (pot[face.loops[0]].coedges.size() != 5 || evaluate(*face.surface, {0.5, 0.1}).x < 30) continue;
    model.parts[0].bodies[0].faces = {Face(face)};
    model.parts[0].bodies[0].shells.clear();
    model.parts[0].bodies.resize(1);
    return drawn(model, What::Trims);
  }
  return fail(ErrorCode::NotFound, "no face of the pot is cut");
}

struct Figure {
  const char* file;
  const char* rows;  // of the seeds' list of features
  const char* shows;
  Picture (*draw)();
};

const Figure figures[] = {
    {"bernstein", "C1", "the Bernstein polynomials of degree 3",
     [] { return described(What::Basis, R"({"type": "bezier", "name": "Bernstein", "points": [[0, 0], [1, 2], [3, 2], [4, 0]]})"); }},
    {"de-casteljau", "C1, C14", "de Casteljau's scheme is the blossom over the knots 0 and 1",
     [] { return described(What::Blossom, R"({"type": "bezier", "name": "de Casteljau", "points": [[0, 0], [1, 3], [4, 3.5], [6, 0.5]]})", 0.4); }},
    {"hodograph", "C3", "a cubic, its hodograph and its speed",
     [] { return described(What::Hodograph, R"({"type": "bezier", "name": "cubic", "points": [[0, 0], [1, 3], [4, 3.5], [6, 0.5]]})"); }},
    {"catmull-rom", "C7, C9", "Catmull-Rom: even speed makes the short span overshoot",
     [] { return described(What::Curve, R"({"type": "catmull-rom", "name": "Catmull-Rom", "points": [[0, 0], [8, 1], [9, 3], [10, 1], [18, 0]], "ends": "quadratic-c1"})"); }},
    {"overhauser", "C8, C9", "Overhauser through the same points: chord lengths for parameters",
     [] { return described(What::Curve, R"({"type": "overhauser", "name": "Overhauser", "points": [[0, 0], [8, 1], [9, 3], [10, 1], [18, 0]], "ends": "quadratic-c1"})"); }},
    {"comb", "C6", "curvature comb: where curvature jumps, the spline is C1 only",
     [] { return described(What::Comb, R"({"type": "overhauser", "name": "Overhauser", "points": [[0, 0], [4, 3], [9, 3], [13, 0], [18, 1]], "ends": "quadratic-c1"})"); }},
    {"arcs", "C10, C11", "arcs of a circle: any, a quarter, half with an ideal point",
     [] {
       return described(What::Curve, R"({"shapes": [
         {"type": "bezier", "name": "120 degrees, weight 1/2", "points": [[0.8660254037844386, 0.5], [0, 2], [-0.8660254037844386, 0.5]], "weights": [1, 0.5, 1]},
         {"type": "bezier", "name": "a quarter, weight 1/sqrt 2", "points": [[1, 0], [1, 1], [0, 1]], "weights": [1, 0.7071067811865476, 1]},
         {"type": "bezier", "name": "half, the middle point ideal", "points": [[1, 0], [0, 1], [-1, 0]], "weights": [1, 0, 1]}]})");
     }},
    {"quintic-circle", "C11", "the full circle as one rational quintic",
     [] { return described(What::Curve, R"({"type": "circle", "name": "quintic circle", "radius": 1, "form": "quintic"})"); }},
    {"blossom", "C14, C15", "the cubic B-spline over the knots 1 to 8 at t = 4.5",
     [] {
       return described(What::Blossom, R"({"type": "nurbs", "name": "knots 1 .. 8", "degree": 3, "knots": [1, 2, 3, 4, 5, 6, 7, 8],
         "points": [[0, 1], [1, 6], [5, 0], [9, 6], [13, 1], [10, -2]]})", 4.5);
     }},
    {"basis", "C15", "basis functions over Bézier ends and a double knot",
     [] {
       return described(What::Basis, R"({"type": "nurbs", "name": "cubic", "degree": 3, "knots": [0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3],
         "points": [[0, 0], [1, 2], [2, 0], [3, 2], [4, 0], [5, 2], [6, 0]]})");
     }},
    {"knots", "C15, C17", "its knots: each repetition costs an order of continuity",
     [] {
       return described(What::Knots, R"({"type": "nurbs", "name": "cubic", "degree": 3, "knots": [0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3],
         "points": [[0, 0], [1, 2], [2, 0], [3, 2], [4, 0], [5, 2], [6, 0]]})");
     }},
    {"procedures", "C22", "corner cutting at a third, and Koch",
     [] {
       return described(What::Curve, R"({"shapes": [
         {"type": "corner-cutting", "name": "a third cut off each side, three times", "points": [[0, 0], [3, 0], [3, 2], [0, 2]], "closed": true, "ratio": 0.3333333333333333, "rounds": 3},
         {"type": "koch", "name": "Koch, level 4", "points": [[0, 0], [3, 0]], "rounds": 4}]})");
     }},
    {"biarcs", "C24", "biarcs through points: circular arcs with common tangents",
     [] { return described(What::Comb, R"({"type": "biarcs", "name": "biarcs", "points": [[0, 0], [4, 3], [9, 3], [13, 0], [18, 1]]})"); }},
    {"transcendental", "C20", "an Archimedean spiral and a cycloid, each within 1e-4 mm",
     [] {
       return described(What::Curve, R"({"shapes": [
         {"type": "spiral", "name": "Archimedean spiral", "growth_per_turn": 4, "end_deg": 1080},
         {"type": "cycloid", "name": "cycloid", "radius": 3, "end_deg": 720}]})");
     }},
    {"bicubic", "S1", "a bicubic Bézier patch and its control net",
     [] {
       return described(What::Net, R"({"type": "bezier-surface", "name": "bicubic patch", "points": [
         [[0, 0, 0], [0, 1, 1], [0, 2, 1], [0, 3, 0]], [[1, 0, 1], [1, 1, 4], [1, 2, -1], [1, 3, 1]],
         [[2, 0, 1], [2, 1, 0], [2, 2, 2], [2, 3, 1]], [[3, 0, 0], [3, 1, 1], [3, 2, 1], [3, 3, 0]]]})");
     }},
    {"torus-net", "S2", "a bicubic net that closes in both directions",
     [] {
       return described(What::Net, R"({"type": "nurbs-surface", "name": "periodic both ways", "wrap_u": "periodic", "wrap_v": "periodic", "points": [
         [[12, 2, 0], [9, 1.5, 4], [5, 1, 0], [9, 1.5, -4]], [[4, 11, 0], [3, 8.5, 4], [2, 5, 0], [3, 8.5, -4]], [[-8, 9, 0], [-6, 7, 4], [-3, 4, 0], [-6, 7, -4]],
         [[-12, -2, 0], [-9, -1.5, 4], [-5, -1, 0], [-9, -1.5, -4]], [[-4, -11, 0], [-3, -8.5, 4], [-2, -5, 0], [-3, -8.5, -4]], [[8, -9, 0], [6, -7, 4], [3, -4, 0], [6, -7, -4]]]})");
     }},
    {"swept", "S4", "revolution and sweep, by isoparametric curves",
     [] {
       return described(What::Isocurves, R"({"shapes": [
         {"type": "revolution", "name": "vase", "curve": {"type": "nurbs", "degree": 3, "points": [[5, 0, 0], [10, 0, 8], [2, 0, 16], [7, 0, 24]]}},
         {"type": "swept", "name": "hose", "section": {"type": "circle", "normal": [1, 0, 0], "radius": 2},
          "path": {"type": "bezier", "points": [[0, 0, 0], [10, 0, 0], [20, 10, 10], [20, 10, 25]]}, "tolerance": 0.01}]})");
     }},
    {"coons", "S5", "a Coons patch of four curves",
     [] {
       return described(What::Isocurves, R"({"type": "coons", "name": "Coons patch", "bottom": {"type": "bezier", "points": [[0, 0, 0], [10, 0, 8], [20, 0, 0]]},
         "top": {"type": "bezier", "points": [[0, 20, 0], [10, 20, -6], [20, 20, 0]]}, "left": {"type": "line", "start": [0, 0, 0], "end": [0, 20, 0]},
         "right": {"type": "bezier", "points": [[20, 0, 0], [20, 10, 5], [20, 20, 0]]}})");
     }},
    {"teapot", "S6, S7", "the Utah teapot, spout and handle cut where they meet the body",
     [] { return drawn(samples::utah_teapot(), What::Shaded); }},
    {"spout-cut", "S7", "a quarter of the body in its parameter plane: the corner that the spout takes away", trimmed_body},
    {"triangle", "S8", "a cubic triangular patch as three quadrilaterals, exactly",
     [] {
       return described(What::Isocurves, R"({"type": "triangle", "name": "third", "degree": 3, "form": "three-quads",
         "points": [[5, 9, 0], [3.5, 6, 4], [6.5, 6, 4], [2, 3, 3], [5, 3, 7], [8, 3, 3], [0, 0, 0], [3.3, 0, 4], [6.6, 0, 4], [10, 0, 0]]})");
     }},
    {"five-sides", "S9", "a five-sided hole: five patches with common tangent planes",
     [] {
       return described(What::Shaded, R"({"type": "n-sided", "name": "five sides", "continuity": "tangent", "sides": [
         {"type": "bezier", "points": [[10, 0, 0], [8.4, 2.2, 2.5], [5.8, 7.4, 2.5], [3.1, 9.5, 0]]}, {"type": "bezier", "points": [[3.1, 9.5, 0], [0, 8.6, -2], [-5, 7, -2], [-8.1, 5.9, 0]]},
         {"type": "bezier", "points": [[-8.1, 5.9, 0], [-8, 2, 2.5], [-8, -2, 2.5], [-8.1, -5.9, 0]]}, {"type": "bezier", "points": [[-8.1, -5.9, 0], [-5, -7, -2], [0, -8.6, -2], [3.1, -9.5, 0]]},
         {"type": "bezier", "points": [[3.1, -9.5, 0], [5.8, -7.4, 2.5], [8.4, -2.2, 2.5], [10, 0, 0]]}]})");
     }},
    {"beta", "S10", "the net of seed 004 with (bias, tension) = (1, 0), (1, 5) and (1.5, 0)",
     [] {
       const std::string net = R"("points": [
         [[1, 1, 1], [1, 2, 1], [1, 3, 1], [1, 4, 1]], [[2, 1, 0], [2, 2, 0], [2, 3, 0], [2, 4, 0]],
         [[3, 1, 1], [3, 2, 1], [3, 3, 1], [3, 4, 1]], [[4, 1, 0], [4, 2, 0], [4, 3, 0], [4, 4, 0]]]})";
       const std::string text = R"({"shapes": [{"type": "beta-surface", "name": "bias 1, tension 0", )" + net +
                                R"(, {"type": "beta-surface", "name": "bias 1, tension 5", "tension": 5, )" + net +
                                R"(, {"type": "beta-surface", "name": "bias 1.5, tension 0", "bias": 1.5, )" + net + "]}";
       return described(What::Net, text.c_str());
     }},
    {"doo-sabin", "S11", "Doo-Sabin on a cube", [] { return subdivided(subdivision::Scheme::DooSabin); }},
    {"catmull-clark", "S11", "Catmull-Clark on a cube", [] { return subdivided(subdivision::Scheme::CatmullClark); }},
    {"hull", "S14", "a hull of developable strips: two parts of cones a side", [] { return drawn(samples::hull(), What::Shaded); }},
};

int write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const Figure& figure : figures) {
    const Picture picture = figure.draw();
    const auto saved = picture ? io::save(folder / (std::string(figure.file) + ".svg"), picture->svg, true)
                               : Result<void>(tl::unexpected(picture.error()));
    if (!saved) {
      std::fprintf(stderr, "%s: %s\n", figure.file, saved.error().text.c_str());
      return 1;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc == 2 ? argv[1] : "";
  if (what == "--list") {
    for (const Figure& figure : figures) std::printf("| [%s](seeds/%s.svg) | %s | %s |\n", figure.file, figure.file, figure.rows, figure.shows);
    return 0;
  }
  if (what == "--examples") return samples::work_examples();
  if (what.empty() || what[0] == '-') {
    std::fprintf(stderr, "usage: seeds FOLDER | --list | --examples\n");
    return 2;
  }
  return write_all(what);
}
