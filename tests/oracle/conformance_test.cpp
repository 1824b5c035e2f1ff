// The files of the micro-suite that OpenCASCADE reads wrongly (tests/data/iges/row*): its result beside ours, as the table
// of docs/oracle-differences.md has them. That ours is right is shown by tests/io/iges/conformance_test.cpp.
#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/oracle/occt_summary.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::test;
namespace fs = std::filesystem;

namespace {

Summary our_summary(const Model& model) {
  Summary s;
  const ModelCounts counts = count(model).value();
  const ModelMeasures measures = measure(model, Limits{}).value();
  s.faces = static_cast<int>(counts.faces);
  s.failed = static_cast<int>(counts.faces_failed);
  s.curves = static_cast<int>(counts.curves);
  s.area = measures.area_mm2;
  s.length = measures.curve_length_mm;
  s.box = measures.box;
  for (const Part& part : model.parts) {
    for (const FreeCurve& c : part.curves) s.unbounded = s.unbounded || !is_bounded(c.curve);
    for (const Body& body : part.bodies)
      for (const Face& face : body.faces) {
        if (s.has_middle || !face.surface) continue;
        const SurfaceDomain d = domain(*face.surface);
        if (!d.u.is_bounded() || !d.v.is_bounded()) continue;
        s.middle = evaluate(*face.surface, {d.u.mid(), d.v.mid()});
        s.has_middle = true;
      }
  }
  return s;
}

// Where the box of a wrong reading is the right one.
bool by_its_middle(const std::string& name) { return name.rfind("row03", 0) == 0 || name.rfind("row13", 0) == 0; }

std::string our_rewritten_point(const io::ReadResult& in) {
  io::WriteOptions options;
  options.format = io::Format::Iges;
  const auto written = io::encode(in.model, in.source, options);
  if (!written) return written.error().text;
  const std::size_t at = written->bytes.find("\n116,");
  return at == std::string::npos ? "nothing" : written->bytes.substr(at + 5, written->bytes.find(',', at + 5) - at - 5);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(conformance)

BOOST_AUTO_TEST_CASE(rows_are_read_as_the_page_says) {
  std::set<std::string> page;
  std::ifstream in(source_dir() / "docs" / "oracle-differences.md");
  for (std::string line; std::getline(in, line);) page.insert(line);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source_dir() / "tests/data/iges"))
    if (entry.path().filename().string().rfind("row", 0) == 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  BOOST_TEST(files.size() >= 26u);
  for (const fs::path& path : files) {
    const std::string name = path.filename().string();
    const io::ReadResult read = io::read(path);
    const bool writes = name.rfind("row19", 0) == 0;
    const std::string ours = writes ? our_rewritten_point(read) : text_of(our_summary(read.model), by_its_middle(name));
    const std::string theirs = writes ? occt_rewritten_point(path) : occt_summary(path, by_its_middle(name));
    const std::string row = fmt::format("| `{}` | {} | {} |", name, ours, theirs);
    BOOST_TEST(page.count(row) == 1u, "not in docs/oracle-differences.md: " << row);
    BOOST_TEST(ours != theirs, name << " is no difference");
  }
}

BOOST_AUTO_TEST_SUITE_END()
