// The malformed IGES files I37 to I44, I54 to I62 and I66 to I74 of the catalogue of bad inputs, given to the program: the
// finding that the catalogue names, the exit code, and less than a second of processor time whatever the file claims.

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>

#include "tests/cli/program.h"
#include "tests/support/iges_text.h"

using namespace trimloop::test;

namespace {

constexpr const char* part = "00010000";        // physically dependent
constexpr const char* definition = "00000200";
constexpr const char* huge = "2147483647";

enum class Outcome { Accepted, Partial };  // exit 0; exit 1, and what is beside the bad entity stays

struct Case {
  std::string name;
  std::vector<std::string_view> rules;  // one of these is found
  std::function<void(IgesText&)> build;
  Outcome outcome = Outcome::Partial;
};

double children_seconds() {
  rusage use{};
  getrusage(RUSAGE_CHILDREN, &use);
  return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) + 1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

// A good point stands behind what is bad.
void check(const Program& trimloop, const Case& c, double seconds = 1) {
  IgesText file;
  c.build(file);
  file.add(116, "7.,8.,9.,0");
  trimloop.write("bad.igs", file.text());
  const double before = children_seconds();
  const Ran ran = trimloop("check --json bad.igs");
  const double took = children_seconds() - before;
  BOOST_TEST_CONTEXT(c.name) {
    BOOST_TEST(ran.code == (c.outcome == Outcome::Partial ? 1 : 0));
    BOOST_TEST(took < seconds, took << " s");
    BOOST_REQUIRE(ran.code == 0 || ran.code == 1);
    const auto json = nlohmann::json::parse(ran.out);
    bool found = false;
    std::string others;
    for (const auto& f : json["findings"]) {
      const std::string id = f["id"];
      for (const std::string_view rule : c.rules) found = found || id == rule;
      if (others.size() < 400) others += id + " " + f["text"].get<std::string>() + "; ";
    }
    BOOST_TEST(found, others);
    const auto info = nlohmann::json::parse(trimloop("info --json bad.igs").out);
    BOOST_TEST(info["model"]["points"] >= 1);
  }
}

int line(IgesText& f, const char* points = "0.,0.,0.,1.,0.,0.") { return f.add(110, points, {.status = part}); }
int plate(IgesText& f) {
  return f.add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.", {.status = part});
}

// A square in z = 0 as 502, 504, 508, 510, 514, 186: the parameters of each may be replaced.
struct Brep {
  std::string vertices = "4,0.,0.,0.,1.,0.,0.,1.,1.,0.,0.,1.,0.";
  std::string edges = "4,{1},{v},1,{v},2,{2},{v},2,{v},3,{3},{v},3,{v},4,{4},{v},4,{v},1";
  std::string loop = "4,0,{e},1,1,0,0,{e},2,1,0,0,{e},3,1,0,0,{e},4,1,0";
  std::string face = "{s},1,1,{l}";
  std::string shell = "1,{f},1";
  std::string solid = "{h},1,0";
  int shell_form = 2;
};
void add(IgesText& file, const Brep& b) {
  const auto with = [](std::string text, std::initializer_list<std::pair<std::string_view, int>> pointers) {
    for (const auto& [name, value] : pointers) {
      const std::string key = fmt::format("{{{}}}", name);
      for (std::size_t at; (at = text.find(key)) != std::string::npos;) text.replace(at, key.size(), std::to_string(value));
    }
    return text;
  };
  const int l1 = line(file, "0.,0.,0.,1.,0.,0."), l2 = line(file, "1.,0.,0.,1.,1.,0."), l3 = line(file, "1.,1.,0.,0.,1.,0."),
            l4 = line(file, "0.,1.,0.,0.,0.,0.");
  const int at = file.add(116, "0.,0.,0.,0", {.status = part}), n = file.add(123, "0.,0.,1.", {.status = part});
  const int s = file.add(190, "{},{}", {.status = part}, {at, n});
  const int v = file.add(502, b.vertices, {.form = 1, .status = part});
  const int e = file.add(504, with(b.edges, {{"1", l1}, {"2", l2}, {"3", l3}, {"4", l4}, {"v", v}, {"e", v + 2}}), {.form = 1, .status = part});
  const int l = file.add(508, with(b.loop, {{"e", e}, {"v", v}}), {.form = 1, .status = part});
  const int f = file.add(510, with(b.face, {{"s", s}, {"l", l}}), {.form = 1, .status = part});
  const int h = file.add(514, with(b.shell, {{"f", f}}), {.form = b.shell_form, .status = part});
  file.add(186, with(b.solid, {{"h", h}, {"self", h + 2}}));
}
Case brep(std::string name, std::vector<std::string_view> rules, std::function<void(Brep&)> change) {
  return {std::move(name), std::move(rules), [change](IgesText& f) {
            Brep b;
            change(b);
            add(f, b);
          }};
}
Case entity(std::string name, std::vector<std::string_view> rules, int type, std::string parameters, int form = 0,
            Outcome outcome = Outcome::Partial) {
  return {std::move(name), std::move(rules), [=](IgesText& f) { f.add(type, parameters, {.form = form}); }, outcome};
}

std::vector<Case> references() {
  std::vector<Case> out;
  const auto add = [&](const char* name, std::vector<std::string_view> rules, std::function<void(IgesText&)> build,
                       Outcome outcome = Outcome::Partial) { out.push_back({name, std::move(rules), std::move(build), outcome}); };
  add("I37 a matrix of itself", {"IG-R05"}, [](IgesText& f) {
    f.add(124, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", {.transform = 1});
    f.add(110, "0.,0.,0.,1.,0.,0.", {.transform = 1});
  });
  add("I39 a composite of itself", {"IG-R04"}, [](IgesText& f) { f.add(102, "1,1"); });
  add("I39 through three others", {"IG-R04"}, [](IgesText& f) { for (const char* p : {"1,3", "1,5", "1,7", "1,1"}) f.add(102, p); });
  add("I40 composites nested 10 000 deep", {"LM-05"}, [](IgesText& f) {
    int inner = line(f);
    for (int i = 0; i < 10'000; ++i) inner = f.add(102, "1,{}", {.status = i < 9'999 ? part : "00000000"}, {inner});
  });
  add("I41 a subfigure in itself", {"IG-R07"}, [](IgesText& f) {
    f.add(308, "1,1Ha,1,3", {.status = definition});
    f.add(408, "1,0.,0.,0.,1.", {.status = part});
    f.add(408, "1,0.,0.,0.,1.");
  });
  add("I42 forty levels of doubling", {"IG-R08"}, [](IgesText& f) {
    int below = line(f);
    for (int level = 0; level < 40; ++level) {
      const int def = f.add(308, fmt::format("{},1Hd,{}", level, level ? "2,{},{}" : "1,{}"), {.status = definition}, {below, below + 2});
      below = f.add(408, "{},0.,0.,0.,1.", {.status = part}, {def});
      f.add(408, "{},1.,0.,0.,1.", {.status = part}, {def});
    }
    f.add(408, "{},0.,0.,0.,1.", {}, {below - 2});
  });
  add("I43 an array of 2^31 by 2^31", {"IG-E412-01", "IG-R08", "LM-07"}, [](IgesText& f) {
    f.add(412, fmt::format("{{}},1.,0.,0.,0.,{0},{0},1.,1.,0.,0,0", huge), {}, {line(f)});
  });
  add("I43 a circular array of 2^31", {"IG-E412-01", "IG-R08", "LM-07"}, [](IgesText& f) {
    f.add(414, fmt::format("{{}},{},0.,0.,0.,1.,0.,.1,0,0", huge), {}, {line(f)});
  });
  add("I44 a group that lists itself", {"IG-R04"}, [](IgesText& f) { f.add(402, "1,1", {.form = 7}); });
  out.push_back(entity("I44 a group of 2^31 - 1", {"IG-P17", "IG-E402-01"}, 402, std::string(huge) + ",1", 7));
  return out;
}

std::vector<Case> curves_and_surfaces() {
  std::vector<Case> out;
  const auto add = [&](const char* name, std::vector<std::string_view> rules, std::function<void(IgesText&)> build,
                       Outcome outcome = Outcome::Partial) { out.push_back({name, std::move(rules), std::move(build), outcome}); };
  const auto one = [&](const char* name, std::vector<std::string_view> rules, int type, std::string parameters, int form = 0,
                       Outcome outcome = Outcome::Partial) { out.push_back(entity(name, std::move(rules), type, std::move(parameters), form, outcome)); };
  const std::string terminal = ",1.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.";
  one("I54 112 without segments", {"IG-E112-03"}, 112, "3,1,3,0,0." + terminal);
  one("I54 112 of 10^9 segments", {"IG-P17"}, 112, "3,1,3,1000000000,0.,1." + terminal);
  one("I54 112 with equal break points", {"IG-E112-04"}, 112, "3,1,3,1,1.,1.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0." + terminal);
  one("I55 114 that is too short", {"IG-E114-02", "IG-P02", "IG-P17"}, 114, "3,1,1,1,0.,1.,0.,1.,0.,1.");
  one("I55 114 of 2^31 patches", {"IG-E114-02", "IG-P02", "IG-P17"}, 114, fmt::format("3,1,{0},{0},0.,1.,0.,1.,0.,1.", huge));
  one("I56 100 whose radii differ by a tenth", {"IG-E100-02"}, 100, "0.,0.,0.,5.,0.,0.,5.5");
  one("I56 100 without a radius", {"IG-E100-01"}, 100, "0.,0.,0.,0.,0.,0.,0.");
  one("I56 100 almost closed", {"IG-E100-03"}, 100, "0.,0.,0.,5.,0.,5.,1.E-9", 0, Outcome::Accepted);
  one("I57 104 of zeros", {"IG-E104-02"}, 104, "0.,0.,0.,0.,0.,0.,0.,1.,0.,0.,1.", 1);
  one("I57 104 whose form is another conic", {"IG-E104-01"}, 104, ".04,0.,.25,0.,0.,-1.,0.,5.,0.,0.,2.", 3, Outcome::Accepted);
  one("I57 104 with its ends on two branches", {"IG-E104-05"}, 104, "1.,0.,-1.,0.,0.,-1.,0.,2.,1.7320508075688772,-2.,1.7320508075688772", 2);
  one("I58 106 without points", {"IG-E106-02"}, 106, "2,0", 12);
  one("I58 106 of 2^31 - 1 points", {"IG-P17"}, 106, "2," + std::string(huge) + ",0.,0.,0.", 12);
  one("I58 106 with the wrong flag", {"IG-E106-01"}, 106, "1,2,0.,0.,0.,1.,1.", 12);
  add("I59 120 of nothing", {"IG-R01", "IG-R03", "IG-E120-01"}, [](IgesText& f) { f.add(120, "{},0,0.,1.", {}, {line(f)}); });
  add("I59 120 of a null entity", {"IG-R03"}, [](IgesText& f) { const int l = line(f); f.add(120, "{},{},0.,1.", {}, {l, f.add(0, "")}); });
  add("I59 122 of a surface", {"IG-R03"}, [](IgesText& f) { f.add(122, "{},1.,1.,1.", {}, {plate(f)}); });
  add("I59 118 of a surface", {"IG-R03"}, [](IgesText& f) { const int l = line(f); f.add(118, "{},{},0,0", {.form = 1}, {l, plate(f)}); });
  add("I59 120 of its own axis", {"IG-E120-04", "IG-E120-01"}, [](IgesText& f) { const int l = line(f); f.add(120, "{},{},0.,1.", {}, {l, l}); });
  const auto under = [&](const char* name, std::vector<std::string_view> rules, const char* matrix, Outcome outcome = Outcome::Partial) {
    add(name, std::move(rules), [matrix](IgesText& f) { f.add(110, "0.,0.,0.,1.,0.,0.", {.transform = f.add(124, matrix)}); }, outcome);
  };
  under("I60 124 with words", {"IG-P08"}, "NAN,0.,0.,0.,0.,1.,0.,0.,0.,0.,INF,0.");
  under("I60 124 of zeros", {"IG-E124-04"}, "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.");
  under("I60 124 form 0 that mirrors", {"IG-E124-03"}, "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", Outcome::Accepted);
  under("I60 124 that doubles", {"IG-E124-05"}, "2.,0.,0.,0.,0.,2.,0.,0.,0.,0.,2.,0.", Outcome::Accepted);
  add("I61 130 of itself", {"IG-R04"}, [](IgesText& f) { f.add(130, "1,1,0,0,0,1.,0.,0.,0.,0.,0.,1.,0.,1."); });
  add("I61 140 of itself", {"IG-R04"}, [](IgesText& f) { f.add(140, "0.,0.,1.,1.,1"); });
  add("I61 130 at 1E308", {"SQ-401"}, [](IgesText& f) {
    f.add(130, "{},1,0,0,0,1.E308,0.,0.,0.,0.,0.,1.,0.,1.", {}, {f.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = part})});
  });
  add("I61 140 at 1E308", {"SQ-401"}, [](IgesText& f) { f.add(140, "0.,0.,1.,1.E308,{}", {}, {plate(f)}); });
  const auto bounded = [&](const char* name, std::vector<std::string_view> rules, const char* boundary) {
    add(name, std::move(rules), [boundary](IgesText& f) {
      const int s = plate(f), l = f.add(106, "1,5,0.,1.,1.,2.,1.,2.,2.,1.,2.,1.,1.", {.form = 63, .status = part});
      const int b = f.add(141, boundary, {.status = part}, {s, l});
      f.add(143, "1,{},1,{}", {}, {s, b});
    });
  };
  bounded("I62 141 of 10^9 curves", {"IG-P17"}, "1,1,{},1000000000,{},1,0");
  bounded("I62 141 with a parameter curve that is none", {"IG-E141-02"}, "1,2,{},1,{},1,1,0");
  bounded("I62 141 of sense 7", {"IG-E141-01"}, "0,1,{},1,{},7,0");
  return out;
}

std::vector<Case> solids() {
  std::vector<Case> out;
  out.push_back(brep("I66 186 with an open shell", {"IG-E186-01", "IG-E514-02"}, [](Brep&) {}));
  out.push_back(brep("I66 186 as its own shell", {"IG-R03"}, [](Brep& b) { b.solid = "{self},1,0"; }));
  out.push_back(brep("I66 186 whose void is its shell", {"IG-E186-03"}, [](Brep& b) { b.solid = "{h},1,1,{h},1"; }));
  for (const char* index : {"0", "5", "-1", huge})
    out.push_back(brep(fmt::format("I67 504 with vertex {}", index), {"IG-E504-01"}, [index](Brep& b) { b.edges = fmt::format("1,{{1}},{{v}},1,{{v}},{}", index); }));
  out.push_back(brep("I67 504 whose vertex list is an edge list", {"IG-R03"}, [](Brep& b) { b.edges = "1,{1},{e},1,{v},2"; }));
  out.push_back(brep("I68 508 of one edge a million times", {"IG-E508-02", "LM-06", "MD-12"}, [](Brep& b) {
    constexpr int edge_list = 17;  // which add() gives it
    b.loop = "1000000";
    for (int i = 0; i < 1'000'000; ++i) b.loop += fmt::format(",0,{},1,1,0", edge_list);
  }));
  out.push_back(brep("I68 508 of 2^31 - 1 edges", {"IG-P17"}, [](Brep& b) { b.loop = fmt::format("{},0,{{e}},1,1,0", huge); }));
  out.push_back(brep("I68 508 with a use of type 2", {"IG-E508-01"}, [](Brep& b) { b.loop = "1,2,{e},1,1,0"; }));
  out.push_back(brep("I68 508 into the wrong list", {"IG-E508-01", "IG-R03"}, [](Brep& b) { b.loop = "1,0,{v},1,1,0"; }));
  out.push_back(brep("I69 510 of 10^9 loops", {"IG-P17"}, [](Brep& b) { b.face = "{s},1000000000,1,{l}"; }));
  out.push_back(brep("I69 510 with one loop twice", {"IG-E510-01"}, [](Brep& b) { b.face = "{s},2,1,{l},{l}"; }));
  out.push_back(entity("I70 180 of a million operators", {"IG-E180-01", "LM-06"}, 180, [] {
    std::string text = "1000000";
    for (int i = 0; i < 1'000'000; ++i) text += ",1";
    return text;
  }()));
  out.push_back({"I70 180 that runs out of operands", {"IG-E180-01"}, [](IgesText& f) {
    const int block = f.add(150, "1.,1.,1.", {.status = part});
    f.add(180, fmt::format("3,-{},1,1", block));
  }});
  return out;
}

std::vector<Case> attributes_and_texts() {
  std::vector<Case> out;
  out.push_back(entity("I71 306, a macro without end", {"IG-E306-01"}, 306, "4HDUMB,LABEL 10,GOTO 10,ENDM", 0, Outcome::Accepted));
  out.push_back(entity("I72 406 of 10^9 values", {"IG-P17", "IG-E406-01"}, 406, "1000000000,1", 1));
  out.push_back({"I72 406 whose owner is nowhere", {"IG-R01", "IG-D31"}, [](IgesText& f) { f.add(406, "1,4Hname,1,9999,0", {.form = 15}); }});
  const std::string long_name(10 << 20, 'x');
  for (const std::string& name : {std::string("../../etc/passwd"), std::string("\\\\host\\share\\part.igs"), std::string("/etc/passwd")})
    out.push_back(entity("I73 416 " + name, {"MD-17"}, 416, hollerith(name), 1));
  for (const std::string& name : {std::string("trap.igs"), long_name})
    out.push_back(entity("I73 416 " + name.substr(0, 40), {"IG-R12"}, 416, hollerith(name), 1, Outcome::Accepted));
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(bad_iges)

BOOST_AUTO_TEST_CASE(i37_to_i44_references_end) {
  const Program trimloop;
  for (const Case& c : references()) check(trimloop, c);
}

// A million matrices would be 243 MB: the length is a matter of the counter, which a twentieth of it passes as well.
BOOST_AUTO_TEST_CASE(i38_a_chain_of_matrices_ends) {
  const Program trimloop;
  check(trimloop, {"I38", {"IG-R05", "LM-05"}, [](IgesText& f) {
    constexpr int members = 50'000;
    for (int i = 0; i < members; ++i)
      f.add(124, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", {.transform = i + 1 < members ? 2 * i + 3 : 0});
    f.add(110, "0.,0.,0.,1.,0.,0.", {.transform = 1});
  }});
}

BOOST_AUTO_TEST_CASE(i54_to_i62_curves_and_surfaces) {
  const Program trimloop;
  for (const Case& c : curves_and_surfaces()) check(trimloop, c);
}

BOOST_AUTO_TEST_CASE(i66_to_i70_solids) {
  const Program trimloop;
  for (const Case& c : solids()) check(trimloop, c);
}

BOOST_AUTO_TEST_CASE(i71_to_i73_macros_properties_and_other_files) {
  const Program trimloop;
  // Who opened the pipe for reading would wait for ever; the program must not touch it.
  BOOST_REQUIRE(::mkfifo((trimloop.folder / "trap.igs").c_str(), 0600) == 0);
  for (const Case& c : attributes_and_texts()) check(trimloop, c);
}

BOOST_AUTO_TEST_CASE(i74_hostile_text_is_escaped_wherever_it_is_shown) {
  const Program trimloop;
  IgesText file;
  const std::string text = "\x1b[31mred\x07</script><script>alert(1)</script>=cmd|'/c calc'!A1";
  file.add(212, fmt::format("1,{},10.,2.,1,1.5707963267949,0.,0,0,0.,0.,0.,{}", text.size(), hollerith(text)));
  file.add(110, "0.,0.,0.,10.,0.,0.");
  trimloop.write("text.igs", file.text());
  BOOST_TEST(trimloop("check --json text.igs").out.find("MD-15") != std::string::npos);
  for (const char* words : {"info text.igs", "info --json text.igs", "check --fail-on fatal text.igs", "check --fail-on fatal --json text.igs",
                            "dump text.igs", "view text.igs -o -", "plot text.igs --what annotation -o -", "convert text.igs - --to json",
                            "convert text.igs - --to stp", "convert text.igs - --to svg"}) {
    const Ran ran = trimloop(words);
    const std::string shown = ran.out + trimloop.content("err");
    BOOST_TEST((ran.code == 0 || ran.code == 1), words << " ends with " << ran.code);
    BOOST_TEST(shown.find('\x1b') == std::string::npos, words);
    BOOST_TEST(shown.find('\x07') == std::string::npos, words);
    const bool markup = std::string_view(words).substr(0, 4) == "view" || std::string_view(words).find("svg") != std::string_view::npos || words[0] == 'p';
    BOOST_TEST((!markup || shown.find("</script><script>alert") == std::string::npos), words);
  }
}

BOOST_AUTO_TEST_SUITE_END()
