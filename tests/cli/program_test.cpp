// The program itself, run as a user runs it: exit codes, standard output for data only, no file left on failure.

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

using namespace trimloop::test;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(program)

BOOST_AUTO_TEST_CASE(info_gives_the_promised_keys) {
  const Program trimloop;
  const Ran ran = trimloop("info --json " + trimloop.model("box.igs"));
  BOOST_TEST(ran.code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  BOOST_TEST(json["file"]["format"] == "iges");
  BOOST_TEST(json["file"]["version"] == "5.3");
  BOOST_TEST(json["file"]["unit"] == "mm");
  BOOST_TEST(json["model"]["faces"] == 6);
  BOOST_TEST(json["model"]["area"].get<double>() == 2 * (80 * 50 + 50 * 30 + 30 * 80), boost::test_tools::tolerance(1e-9));
  BOOST_TEST(json["model"]["bbox"][1][0].get<double>() == 80, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(json["model"]["volume"].is_null());  // loose faces are no shell
  for (const char* key : {"fatal", "error", "warning", "info"}) BOOST_TEST(json["findings"].contains(key));
  BOOST_TEST(!json.contains("milliseconds"));
  BOOST_TEST(nlohmann::json::parse(trimloop("info --json --timings " + trimloop.model("box.igs")).out).contains("milliseconds"));
}

BOOST_AUTO_TEST_CASE(a_file_alone_is_info) {
  const Program trimloop;
  BOOST_TEST(trimloop(trimloop.model("sphere.igs")).out == trimloop("info " + trimloop.model("sphere.igs")).out);
}

BOOST_AUTO_TEST_CASE(standard_input_serves_as_a_file) {
  const Program trimloop;
  const Ran ran = trimloop("info --json - < " + trimloop.model("box.igs"));
  BOOST_TEST(ran.code == 0);
  BOOST_TEST(nlohmann::json::parse(ran.out)["model"]["faces"] == 6);
}

BOOST_AUTO_TEST_CASE(fix_none_gives_back_the_same_bytes) {
  const Program trimloop;
  fs::copy_file(trimloop.models / "plate.igs", trimloop.folder / "in.igs");
  BOOST_TEST(trimloop("fix --none in.igs out.igs").code == 0);
  BOOST_TEST((trimloop.content("in.igs") == trimloop.content("out.igs")));
}

BOOST_AUTO_TEST_CASE(fix_repairs_what_it_can_and_says_what) {
  const Program trimloop;
  std::string bytes;
  {
    std::ifstream in(trimloop.models / "box.igs", std::ios::binary);
    bytes = {std::istreambuf_iterator<char>(in), {}};
  }
  const std::string good = bytes;
  const std::size_t counts = bytes.rfind('P', bytes.rfind('T'));  // on the Terminate card
  bytes.replace(counts + 1, 7, "     99");
  bytes += "behind the end\n";
  trimloop.write("bad.igs", bytes);
  const Ran dry = trimloop("fix --all --dry-run bad.igs");
  BOOST_TEST(dry.code == 0);
  BOOST_TEST(dry.out.find("IG-F14") != std::string::npos);
  BOOST_TEST(dry.out.find("IG-F12") != std::string::npos);
  BOOST_TEST(trimloop("fix --select terminate-counts bad.igs counts.igs").code == 0);
  BOOST_TEST((trimloop.content("counts.igs") == good + "behind the end\n"));
  BOOST_TEST(trimloop("fix --all --log log bad.igs out.igs").code == 0);
  BOOST_TEST((trimloop.content("out.igs") == good));
  BOOST_TEST(trimloop.content("log") == dry.out);
  BOOST_TEST(trimloop("fix --select IG-E126-04 bad.igs no.igs").code == 2);  // has no repair
  BOOST_TEST(trimloop("fix --select nonsense bad.igs no.igs").code == 2);
}

BOOST_AUTO_TEST_CASE(fix_set_changes_one_parameter_of_a_step_instance) {
  const Program trimloop;
  fs::copy_file(trimloop::test::source_dir() / "tests" / "data" / "step" / "inch.stp", trimloop.folder / "in.stp");
  BOOST_TEST(trimloop("fix --log log --set '#2:2.1=3' --set '#4:SI_UNIT.1=CENTI' in.stp out.stp").code == 0);
  std::string expected = trimloop.content("in.stp");
  for (const auto& [from, to] : {std::pair{"#2=CARTESIAN_POINT('',(1.", "#2=CARTESIAN_POINT('',(3."}, std::pair{".MILLI.", ".CENTI."}}) {
    const std::size_t at = expected.find(from);
    BOOST_REQUIRE((at != std::string::npos));
    expected.replace(at, std::string(from).size(), to);
  }
  BOOST_TEST(trimloop.content("out.stp") == expected);
  BOOST_TEST(trimloop.content("log") == "#2 parameter 2.1: '1.' -> '3.'\n#4 parameter SI_UNIT.1: '.MILLI.' -> '.CENTI.'\n");
  BOOST_TEST(trimloop("fix --set '#3:2.1=#99' in.stp none.stp").code == 1);
  BOOST_TEST(trimloop("fix --set '#2:9=1' in.stp none.stp").code == 1);
  BOOST_TEST(trimloop("fix --set '#2' in.stp none.stp").code == 2);
  BOOST_TEST(!fs::exists(trimloop.folder / "none.stp"));
}

BOOST_AUTO_TEST_CASE(convert_writes_each_mesh_format_and_the_same_bytes_twice) {
  const Program trimloop;
  for (const char* extension : {"stl", "obj", "ply", "glb", "igs"}) {
    const std::string name = std::string("a.") + extension, again = std::string("b.") + extension;
    BOOST_TEST(trimloop("convert " + trimloop.model("plate.igs") + " " + name).code == 0, extension);
    BOOST_TEST(trimloop("convert --jobs 4 " + trimloop.model("plate.igs") + " " + again).code == 0, extension);
    BOOST_TEST(trimloop.content(name.c_str()).size() > 1000u, extension);
    BOOST_TEST((trimloop.content(name.c_str()) == trimloop.content(again.c_str())), extension);
  }
}

BOOST_AUTO_TEST_CASE(the_conversion_report_lists_every_face_and_no_clock) {
  const Program trimloop;
  BOOST_TEST(trimloop("convert --report r.json " + trimloop.model("plate.igs") + " a.stl").code == 0);
  const auto json = nlohmann::json::parse(trimloop.content("r.json"));
  BOOST_TEST(json["faces"].size() == 13u);
  std::size_t triangles = 0;
  for (const auto& face : json["faces"]) {
    BOOST_TEST(face["status"] == "ok");
    BOOST_TEST(face["bound"].get<double>() <= json["deflection"].get<double>());
    triangles += face["triangles"].get<std::size_t>();
  }
  BOOST_TEST(json["triangles"] == triangles);
  BOOST_TEST(!json.contains("milliseconds"));
}

BOOST_AUTO_TEST_CASE(loose_faces_are_sewn_as_asked) {
  const Program trimloop;
  const auto solids = [&](const std::string& sew) {
    const Ran ran = trimloop("info --json " + sew + trimloop.model("box.igs"));
    BOOST_REQUIRE(ran.code == 0);
    return nlohmann::json::parse(ran.out)["model"];
  };
  const auto loose = solids("--sew off "), sewn = solids("--sew auto ");
  BOOST_TEST(sewn["solids"] == 1);
  BOOST_TEST(sewn["edges"] == 12);
  BOOST_TEST(sewn["faces"] == loose["faces"]);
  BOOST_TEST(!sewn["volume"].is_null());
  BOOST_TEST(trimloop("convert --report r.json " + trimloop.model("box.igs") + " a.stl").code == 0);
  BOOST_TEST(nlohmann::json::parse(trimloop.content("r.json"))["open_edges"] == 0);
  BOOST_TEST(trimloop("convert --sew often " + trimloop.model("box.igs") + " b.stl").code == 2);
  BOOST_TEST(trimloop("info --sew -1 " + trimloop.model("box.igs")).code == 2);
}

BOOST_AUTO_TEST_CASE(an_existing_output_stays_without_force) {
  const Program trimloop;
  trimloop.write("a.stl", "mine");
  BOOST_TEST(trimloop("convert " + trimloop.model("box.igs") + " a.stl").code == 3);
  BOOST_TEST(trimloop.content("a.stl") == "mine");
  BOOST_TEST(trimloop("convert --force " + trimloop.model("box.igs") + " a.stl").code == 0);
  BOOST_TEST(trimloop.content("a.stl") != "mine");
}

BOOST_AUTO_TEST_CASE(a_failed_conversion_leaves_no_file) {
  const Program trimloop;
  trimloop.write("bad.igs", "this is no IGES file\n");
  BOOST_TEST(trimloop("convert bad.igs out.stl").code == 1);
  BOOST_TEST(!fs::exists(trimloop.folder / "out.stl"));
  BOOST_TEST(trimloop("convert missing.igs out.stl").code == 3);
  BOOST_TEST(!fs::exists(trimloop.folder / "out.stl"));
  BOOST_TEST(trimloop("convert --limit-size 100 " + trimloop.model("box.igs") + " out.stl").code == 4);
  BOOST_TEST(!fs::exists(trimloop.folder / "out.stl"));
}

BOOST_AUTO_TEST_CASE(check_fails_on_the_severity_asked_for) {
  const Program trimloop;
  BOOST_TEST(trimloop("check " + trimloop.model("box.igs")).code == 0);
  trimloop.write("bad.igs", "this is no IGES file\n");
  const Ran ran = trimloop("check --json bad.igs");
  BOOST_TEST(ran.code == 1);
  const auto json = nlohmann::json::parse(ran.out);
  BOOST_TEST(json["summary"]["fatal"] == 1);
  BOOST_TEST(json["findings"][0]["id"] == "IG-F01");
  BOOST_TEST(json["rules"].size() > 100u);
}

BOOST_AUTO_TEST_CASE(every_finding_can_be_explained) {
  const Program trimloop;
  BOOST_TEST(trimloop("explain IG-E144-02").code == 0);
  BOOST_TEST(trimloop("explain loop-open").out == trimloop("explain IG-E144-02").out);
  BOOST_TEST(trimloop("explain NO-SUCH").code == 2);
}

BOOST_AUTO_TEST_CASE(diff_is_0_for_the_same_shapes_in_another_format_and_1_for_others) {
  const Program trimloop;
  const std::string models = (binary_dir() / "samples" / "models").string();
  const std::string step = (std::filesystem::temp_directory_path() / "trimloop_diff_test.stp").string();
  BOOST_TEST(trimloop("convert " + models + "/plate.igs " + step + " --force").code == 0);
  const auto same = trimloop("diff --json --tolerance 1e-6 " + models + "/plate.igs " + step);
  BOOST_TEST(same.code == 0);
  const auto json = nlohmann::json::parse(same.out);
  BOOST_TEST(json["same"] == true);
  BOOST_TEST(json["faces"]["same"] == 13);
  BOOST_TEST(json["faces"]["max_deviation"] < 1e-9);
  BOOST_TEST(trimloop("diff " + models + "/plate.igs " + models + "/box.igs").code == 1);
  BOOST_TEST(trimloop("diff " + models + "/plate.igs no-such-file.stp").code == 3);
  std::filesystem::remove(step);
}

BOOST_AUTO_TEST_CASE(usage_errors_are_2_and_so_is_what_is_promised_and_not_built) {
  const Program trimloop;
  for (const char* words : {"", "no-such-verb", "convert", "convert --angle 0 a.igs b.stl", "info --no-such-option x.igs",
                            "diff a", "plot", "fix a.igs b.igs", "convert a.igs b.nonsense",
                            "convert a.igs b.csv"}) {
    BOOST_TEST(trimloop(words).code == 2, words);
    BOOST_TEST(trimloop(words).out.empty(), words);
  }
  BOOST_TEST(trimloop("--help").code == 0);
  BOOST_TEST(trimloop("--version").out.rfind("trimloop ", 0) == 0u);
}

BOOST_AUTO_TEST_CASE(descriptions_become_nurbs_and_pictures) {
  const Program trimloop;
  trimloop.write("arc.json", R"({"type": "conic", "start": [1, 0], "apex": [1, 1], "end": [0, 1], "weight": 0.5})");
  BOOST_TEST(trimloop("nurbs arc.json arc.igs").code == 0);
  BOOST_TEST(trimloop("check arc.igs").code == 0);
  BOOST_TEST(trimloop("nurbs arc.igs again.json --as bezier").code == 0);
  BOOST_TEST(trimloop("info again.json").code == 0);
  BOOST_TEST(trimloop("nurbs arc.json no.igs --as bezier").code == 2);
  BOOST_TEST(nlohmann::json::parse(trimloop("nurbs --schema").out).contains("$defs"));
  for (const char* what : {"curve", "hodograph", "comb", "basis", "blossom", "knots"})
    BOOST_TEST(trimloop(std::string("plot arc.json -o - --what ") + what).out.rfind("<svg", 0) == 0u, what);
  BOOST_TEST(trimloop("plot arc.json -o net.svg --what net").code == 1);  // there is no surface
  BOOST_TEST(!fs::exists(trimloop.folder / "net.svg"));
  for (const char* what : {"trims", "net", "isocurves", "gaussian", "zebra"})
    BOOST_TEST(trimloop("plot " + trimloop.model("plate.igs") + " -o - --what " + what).out.rfind("<svg", 0) == 0u, what);
  trimloop.write("bad.json", R"({"type": "conic", "start": [1, 0], "apex": [1, 1], "end": [0, "x"], "weight": 0.5})");
  const Ran bad = trimloop("nurbs bad.json bad.igs");
  BOOST_TEST(bad.code == 1);
  std::ifstream err(trimloop.folder / "err");
  const std::string said{std::istreambuf_iterator<char>(err), {}};
  BOOST_TEST(said.find("$.end[1]") != std::string::npos);
  BOOST_TEST(!fs::exists(trimloop.folder / "bad.igs"));
}

BOOST_AUTO_TEST_CASE(several_inputs_go_on_after_a_failure) {
  const Program trimloop;
  trimloop.write("bad.igs", "");
  const Ran ran = trimloop("convert bad.igs " + trimloop.model("box.igs") + " --to stl -o out/");
  BOOST_TEST(ran.code == 1);
  BOOST_TEST(fs::exists(trimloop.folder / "out" / "box.stl"));
  BOOST_TEST(!fs::exists(trimloop.folder / "out" / "bad.stl"));
}

BOOST_AUTO_TEST_CASE(dump_shows_one_entity_with_its_parameters) {
  const Program trimloop;
  const Ran all = trimloop("dump " + trimloop.model("torus.igs"));
  BOOST_TEST(all.code == 0);
  BOOST_TEST(all.out.find("D1 ") != std::string::npos);
  const Ran one = trimloop("dump " + trimloop.model("torus.igs") + " D1");
  BOOST_TEST(one.code == 0);
  BOOST_TEST(one.out.size() < all.out.size());
  BOOST_TEST(trimloop("dump " + trimloop.model("torus.igs") + " D99999").code == 2);
}

BOOST_AUTO_TEST_CASE(nurbs_writes_curves_and_surfaces_as_126_and_128_only) {
  const Program trimloop;
  BOOST_TEST(trimloop("nurbs " + trimloop.model("plate.igs") + " n.igs").code == 0);
  const auto json = nlohmann::json::parse(trimloop("info --json n.igs").out);
  for (const auto& [type, count] : json["entities"].items()) {
    const int number = std::stoi(type);
    BOOST_TEST((number == 126 || number == 128 || number == 142 || number == 144 || number == 102 || number == 314 || number == 406), type);
  }
  BOOST_TEST(json["model"]["faces"] == 13);
}

BOOST_AUTO_TEST_SUITE_END()
