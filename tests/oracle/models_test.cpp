// The sample models as we write them: OpenCASCADE finds the same faces, area and box.

#include <boost/test/unit_test.hpp>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/oracle/occt.h"
#include "tests/support/paths.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

void check_agreement(const fs::path& path, const Model& model) {
  const auto theirs = test::read_with_occt(path, true, 120);
  BOOST_REQUIRE_MESSAGE(theirs, "OpenCASCADE does not read " << path);
  const auto counts = count(model);
  const auto ours = measure(model, {});
  BOOST_REQUIRE((counts && ours));
  BOOST_TEST(theirs->faces == static_cast<int>(counts->faces));
  BOOST_TEST(theirs->area_fine == ours->area_mm2, boost::test_tools::tolerance(1e-9));
  BOOST_REQUIRE(theirs->has_box);
  const double size = ours->box.diagonal();
  BOOST_TEST(distance(theirs->lo, ours->box.lo) <= 1e-6 * size, "low corner off by " << distance(theirs->lo, ours->box.lo));
  BOOST_TEST(distance(theirs->hi, ours->box.hi) <= 1e-6 * size, "high corner off by " << distance(theirs->hi, ours->box.hi));
}

void check_samples(bool to_nurbs) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(trimloop::test::binary_dir() / "samples" / "models")) {
    if (entry.path().extension() != ".igs") continue;
    BOOST_TEST_CONTEXT(entry.path().filename().string()) {
      ++files;
      const io::ReadResult in = io::read(entry.path());
      BOOST_REQUIRE(in.usable);
      io::WriteOptions options;
      options.format = io::Format::Iges;
      options.to_nurbs = to_nurbs;
      const auto written = io::encode(in.model, in.source, options);
      BOOST_REQUIRE(written);
      const fs::path path = fs::temp_directory_path() / ("trimloop_oracle_" + entry.path().filename().string());
      BOOST_REQUIRE(io::save(path, written->bytes, true));
      check_agreement(path, in.model);
      fs::remove(path);
    }
  }
  BOOST_TEST(files >= 7u);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(sample_models)

BOOST_AUTO_TEST_CASE(are_the_same_to_opencascade) { check_samples(false); }

BOOST_AUTO_TEST_CASE(are_the_same_to_opencascade_as_nurbs) { check_samples(true); }

BOOST_AUTO_TEST_SUITE_END()
