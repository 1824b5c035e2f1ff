// What is no shape is refused by a message with the file, the place in it and the rule, and nothing is written.

#include "tests/cli/program.h"

using namespace trimloop::test;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(bad_descriptions)

BOOST_AUTO_TEST_CASE(each_is_refused_with_its_place_and_leaves_nothing) {
  struct Case {
    const char *file, *text, *place, *rule;
  };
  const Case cases[] = {
      {"missing.json", R"({"type": "bezier"})", "$.points: this member is missing", "DS-02"},
      {"repeated.json", R"({"type": "overhauser", "points": [[0,0],[1,1],[1,1],[2,0]]})", "$: points 1 and 2 coincide", "DS-04"},
      {"twice.json", R"({"type": "bezier", "points": [[0,0],[1,1]], "points": [[0,0],[1,2]]})", "\"points\" stands twice", "DS-01"},
      {"overflow.json", R"({"type": "bezier", "points": [[0,0],[1e999,1]]})", "1e999", "DS-01"},
      {"nan.json", R"({"type": "bezier", "points": [[0,0],[NaN,1]]})", "[N", "DS-01"},
      {"counts.json", R"({"shapes": [{"type": "nurbs", "degree": 3, "points": [[0,0],[1,1],[2,0],[3,1]], "knots": [0,1,2]}]})", "$.shapes[0].knots: 3 knots", "DS-02"},
      {"tangents.json", R"({"type": "hermite", "points": [[0,0],[1,1],[2,0]], "tangents": [[1,0],[1,0]]})", "$.tangents: 2 tangents for 3 points", "DS-02"},
      {"contradictory.json", R"({"type": "conic", "start": [0,0], "apex": [1,0], "end": [2,0], "weight": 1})", "$.apex: start, apex and end lie on one line", "DS-02"},
      {"corners.json",
       R"({"type": "coons", "bottom": {"type": "line", "start": [0,0,0], "end": [1,0,0]}, "top": {"type": "line", "start": [0,1,0], "end": [1,1,0]},
           "left": {"type": "line", "start": [0,0,0], "end": [0,2,0]}, "right": {"type": "line", "start": [1,0,0], "end": [1,1,0]}})",
       "$: the sides do not meet", "DS-04"},
      {"manifold.json", R"({"type": "subdivision", "points": [[0,0],[1,0],[0,1],[0,0,1],[0,0,2]], "faces": [[0,1,2],[1,0,3],[0,1,4]]})", "$: edge 0-1 has 3 faces", "DS-04"},
      {"manifold.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 2\nf 1 2 3\nf 2 1 4\nf 1 2 5\n", "edge 0-1 has 3 faces", "DS-31"},
      {"points.csv", "0,0\n1,nan\n", "line 2", "DS-21"}};
  for (const Case& c : cases) BOOST_TEST_CONTEXT(c.file) {
    const Program trimloop;
    trimloop.write(c.file, c.text);
    for (const char* out : {"out.igs", "out.stp", "out.svg"}) {
      BOOST_TEST(trimloop(std::string("nurbs ") + c.file + " " + out).code == 1);
      BOOST_TEST(!fs::exists(trimloop.folder / out));
      const std::string said = trimloop.content("err");
      BOOST_TEST(said.find(std::string(c.file) + ": ") != std::string::npos, said);
      BOOST_TEST(said.find(c.place) != std::string::npos, said);
      BOOST_TEST(said.find(c.rule) != std::string::npos, said);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
