// The micro-suite: hand-made files of a few entities in tests/data/iges, each with its closed-form answers in answers.tsv
// (compose.py writes both). Positions and boxes are right to 1e-12 of the size; lengths, areas and volumes, which are
// quadratures, to 1e-10.
//
// Quantities. Numbers: curves, points, faces, edges, solids, annotations, strokes, texts, views, drawings, records; length,
// area, volume; "curve N low|high" (ends of its range); "finding ID" (at least once). Points: "curve N at S", "surface N at
// U V" (shares of the range), "curve N value T" (its own parameter), "point N", "text N" (origin), low, high (of the box).
// Everything but "curve N" and "surface N" counts occurrences. A file without a "finding" row has no error.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "formats/iges/records/any.h"
#include "formats/iges/records/layout.h"
#include "tests/io/iges/imported.h"
#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::test;
namespace fs = std::filesystem;

namespace {

constexpr double exact = 1e-12;       // of the size: positions
constexpr double quadrature = 1e-10;  // relative: lengths, areas and volumes

const fs::path& folder() {
  static const fs::path path = source_dir() / "tests/data/iges";
  return path;
}

struct Answer {
  std::string quantity, closed;
  std::vector<double> value;
};

// By file, in the table's order.
std::map<std::string, std::vector<Answer>> answers() {
  std::map<std::string, std::vector<Answer>> out;
  std::ifstream table(folder() / "answers.tsv");
  std::string line;
  std::getline(table, line);
  BOOST_REQUIRE(line == "file\tquantity\tclosed form\tvalue");
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::string file, value;
    Answer a;
    std::getline(cells, file, '\t');
    std::getline(cells, a.quantity, '\t');
    std::getline(cells, a.closed, '\t');
    std::getline(cells, value);
    std::istringstream numbers(value);
    for (std::string n; numbers >> n;) a.value.push_back(std::stod(n));
    BOOST_REQUIRE((a.value.size() == 1 || a.value.size() == 3));
    out[file].push_back(std::move(a));
  }
  return out;
}

// One file as read, and what it can be asked.
class Subject {
 public:
  explicit Subject(const std::string& name) : file_(iges::File::parse(read_file(folder() / name), Limits{}, in_.report)) {
    in_.model = io::iges_import::import(file_, Execution{}, {}, in_.report);
    BOOST_REQUIRE(!in_.model.parts.empty());
    const std::vector<Occurrence> all = occurrences(in_.model, 1000, 64).value();
    for (const Occurrence& o : all) {
      const Part& part = in_.model.parts[o.part];
      for (const FreePoint& p : part.points) points_.push_back(apply(o.transform, p.point));
      for (const Annotation& a : part.annotation) annotation_.push_back(&a);
    }
    for (const Part& part : in_.model.parts) {
      for (const FreeCurve& c : part.curves) curves_.push_back(&c.curve);
      for (const Body& b : part.bodies)
        for (const Face& f : b.faces) surfaces_.push_back(f.surface.get());
    }
    measures_ = measure(in_.model, Limits{}).value();
    counts_ = count(in_.model).value();
  }

  const iges::File& file() const { return file_; }
  const Imported& imported() const { return in_; }
  double size() const { return measures_.box.empty() ? 1.0 : std::max(1.0, measures_.box.diagonal()); }

  std::optional<double> number(const std::string& what, std::size_t n, const std::string& rest) const {
    if (what == "curves") return static_cast<double>(counts_.curves);
    if (what == "points") return static_cast<double>(counts_.points);
    if (what == "faces") return static_cast<double>(counts_.faces);
    if (what == "edges") return static_cast<double>(counts_.edges);
    if (what == "solids") return static_cast<double>(counts_.solids);
    if (what == "annotations") return static_cast<double>(annotation_.size());
    if (what == "strokes") return static_cast<double>(sum([](const Annotation& a) { return a.strokes.size(); }));
    if (what == "texts") return static_cast<double>(sum([](const Annotation& a) { return a.texts.size(); }));
    if (what == "views") return static_cast<double>(in_.model.views.size());
    if (what == "drawings") return static_cast<double>(in_.model.drawings.size());
    if (what == "records") return static_cast<double>(file_.directory().size());
    if (what == "length") return measures_.curve_length_mm;
    if (what == "area") return measures_.area_mm2;
    if (what == "volume" && measures_.volume_mm3) return *measures_.volume_mm3;
    if (what == "curve" && n < curves_.size() && rest == "low") return range(*curves_[n]).lo;
    if (what == "curve" && n < curves_.size() && rest == "high") return range(*curves_[n]).hi;
    return std::nullopt;
  }
  std::optional<Point> point(const std::string& what, std::size_t n, const std::string& how, double s, double t) const {
    if (what == "low") return measures_.box.lo;
    if (what == "high") return measures_.box.hi;
    if (what == "point" && n < points_.size()) return points_[n];
    if (what == "curve" && n < curves_.size()) return evaluate(*curves_[n], how == "at" ? range(*curves_[n]).at(s) : s);
    if (what == "surface" && n < surfaces_.size() && surfaces_[n]) {
      const SurfaceDomain d = domain(*surfaces_[n]);
      return evaluate(*surfaces_[n], {d.u.at(s), d.v.at(t)});
    }
    if (what != "text") return std::nullopt;
    for (const Annotation* a : annotation_)
      for (const TextRun& r : a->texts)
        if (n-- == 0) return r.origin;
    return std::nullopt;
  }

 private:
  template <class Count>
  std::size_t sum(Count count) const {
    std::size_t total = 0;
    for (const Annotation* a : annotation_) total += count(*a);
    return total;
  }
  Imported in_;
  iges::File file_;
  std::vector<Point> points_;
  std::vector<const Annotation*> annotation_;
  std::vector<const Curve*> curves_;
  std::vector<const Surface*> surfaces_;
  ModelMeasures measures_;
  ModelCounts counts_;
};

// Deviations over the size (positions) or relative to the value (measures), the largest of each kind.
struct Worst {
  double position = 0, measure = 0;
};

void check(const Subject& subject, const Answer& a, Worst& worst) {
  std::istringstream words(a.quantity);
  std::string what, rest;
  words >> what;
  if (what == "finding") {
    words >> rest;
    BOOST_TEST(subject.imported().has(rest), "no finding " << rest);
    return;
  }
  std::size_t n = 0;
  double s = 0, t = 0;
  words >> n >> rest >> s >> t;
  if (a.value.size() == 3) {
    const auto is = subject.point(what, n, rest, s, t);
    BOOST_REQUIRE(is);
    const double off = distance(*is, {a.value[0], a.value[1], a.value[2]}) / subject.size();
    BOOST_TEST(off <= exact, fmt::format("({}, {}, {}) is off by {:.3g} of the size", is->x, is->y, is->z, off));
    worst.position = std::max(worst.position, off);
    return;
  }
  const auto is = subject.number(what, n, rest);
  BOOST_REQUIRE(is);
  const double wanted = a.value[0];
  if (what != "length" && what != "area" && what != "volume") {
    BOOST_TEST(*is == wanted);
    return;
  }
  const double off = std::abs(*is - wanted) / wanted;
  BOOST_TEST(off <= quadrature, fmt::format("{} is off by {:.3g} of {}", *is, off, wanted));
  worst.measure = std::max(worst.measure, off);
}

// Every record is typed, and goes back with the tokens that it came with.
void check_records(const Subject& subject) {
  Report report;
  const iges::File& file = subject.file();
  for (const iges::DirectoryEntry& entry : file.directory()) {
    const iges::Parameters parameters = file.parameters(entry, report);
    const iges::AnyRecord record = iges::read_any(file, entry, parameters, Limits{}, report);
    if (!iges::is_typed(entry.type, entry.form)) continue;
    BOOST_TEST(!record.is_raw(), "D" << entry.de << " (" << entry.type << ":" << entry.form << ") cannot be read as its type");
    const std::vector<std::string> written = iges::write_any(record);
    BOOST_REQUIRE(written.size() + 1 == parameters.tokens.size());
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(conformance)

BOOST_AUTO_TEST_CASE(files_have_their_closed_form_answers) {
  const auto table = answers();
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder()))
    if (entry.path().extension() == ".igs") files.insert(entry.path().filename().string());
  Worst worst;
  std::size_t count = 0;
  for (const std::string& name : files) BOOST_TEST(table.count(name) == 1u, name << " has no answer");
  for (const auto& [name, rows] : table) {
    BOOST_TEST_CONTEXT(name) {
      BOOST_REQUIRE(files.count(name) == 1u);
      const Subject subject(name);
      const bool names_findings = std::any_of(rows.begin(), rows.end(), [](const Answer& a) { return a.quantity.rfind("finding", 0) == 0; });
      if (!names_findings) {
        for (const Diagnostic& d : subject.imported().report.items())
          BOOST_TEST((d.severity != Severity::Error && d.severity != Severity::Fatal), d.rule->id << " " << d.entity << ": " << d.text);
        subject.imported().check_sound();
        check_records(subject);
      }
      for (const Answer& a : rows) {
        BOOST_TEST_CONTEXT(a.quantity << " = " << a.closed) check(subject, a, worst);
        ++count;
      }
    }
  }
  BOOST_TEST_MESSAGE(fmt::format("{} files, {} answers; largest deviations: positions {:.2g} of the size, lengths, areas and volumes {:.2g} relative",
                                 table.size(), count, worst.position, worst.measure));
}

// Every type and form of docs/iges-entities.md is in some file. Of ranges of many forms: those that the standard names.
BOOST_AUTO_TEST_CASE(every_type_and_form_is_there) {
  std::map<int, std::set<int>> there;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() != ".igs") continue;
    Report report;
    const auto file = iges::File::parse(read_file(entry.path()), Limits{}, report);
    for (const iges::DirectoryEntry& e : file.directory()) there[e.type].insert(e.form);
  }
  const std::map<int, std::set<int>> named{{124, {0, 1, 10, 11, 12}}, {212, {0, 1, 2, 3, 4, 5, 6, 7, 8, 100, 101, 102, 105}}};
  std::size_t rows = 0, forms = 0;
  for (const iges::Layout& row : iges::layouts()) {
    ++rows;
    std::set<int> wanted;
    constexpr int implementors = 5001;  // of these one will do
    if (const auto known = named.find(row.type); known != named.end()) {
      wanted = known->second;
    } else if (row.type == 0 || row.last_form >= implementors) {
      const auto& has = there[row.type];
      const auto first = has.lower_bound(row.type == 0 ? 0 : row.first_form);
      BOOST_TEST((first != has.end() && *first <= row.last_form), row.type << ":" << row.first_form << " is in no file");
      ++forms;
    } else {
      for (int form = row.first_form; form <= row.last_form; ++form) wanted.insert(form);
    }
    for (const int form : wanted) BOOST_TEST(there[row.type].count(form) == 1u, row.type << ":" << form << " is in no file");
    forms += wanted.size();
  }
  BOOST_TEST_MESSAGE(rows << " rows of the table, " << forms << " types and forms in files");
}

BOOST_AUTO_TEST_SUITE_END()
