// The page of `trimloop view`, opened in headless Chromium: it draws, and a picked face names its source entity.

#include "tests/support/paths.h"
#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  BOOST_REQUIRE(pipe != nullptr);
  std::array<char, 4096> block;
  std::size_t n = 0;
  while ((n = std::fread(block.data(), 1, block.size(), pipe)) > 0) out.append(block.data(), n);
  ::pclose(pipe);
  return out;
}

struct Page {
  fs::path folder = trimloop::test::binary_dir() / "scratch_page";
  fs::path file = folder / "plate.html";
  bool built = false, has_chromium = false;
  Page() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string program = trimloop::test::binary_dir().string() + "/cli/trimloop";
    built = std::system(("'" + program + "' view -q '" + trimloop::test::binary_dir().string() + "/samples/models/plate.igs' -o '" + file.string() + "' 2>/dev/null").c_str()) == 0;
    has_chromium = std::system("command -v chromium >/dev/null 2>&1") == 0;
  }
  ~Page() { fs::remove_all(folder); }

  std::string dom(const std::string& hash) const {
    return output_of("timeout 90 chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
                     "--disable-quic --no-first-run --disable-background-networking --disable-component-update "
                     "--disable-sync --user-data-dir='" + (folder / "profile").string() + "' --timeout=15000 "
                     "--virtual-time-budget=5000 --dump-dom 'file://" + file.string() + hash + "' 2>/dev/null");
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(page)

BOOST_AUTO_TEST_CASE(the_page_asks_for_nothing_outside_itself) {
  const Page page;
  if (!page.built) {
    BOOST_TEST_MESSAGE("skipped: 1 test of the page, the program was built without Node");
    return;
  }
  std::ifstream in(page.file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  BOOST_TEST(text.find("default-src 'none'") != std::string::npos);
  BOOST_TEST(text.find("<script src") == std::string::npos);
  BOOST_TEST(text.find("<link") == std::string::npos);
  BOOST_TEST(text.find("<script id=\"scene\"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_picked_face_names_its_source_entity_and_shows_its_loops) {
  const Page page;
  if (!page.built || !page.has_chromium) {
    BOOST_TEST_MESSAGE("skipped: 1 test of the page, it needs Node at build time and chromium");
    return;
  }
  const std::string dom = page.dom("#face=0");
  BOOST_TEST(dom.find("data-ready=\"true\"") != std::string::npos);
  BOOST_TEST(dom.find("<h2>Face 0 \xC2\xB7 D") != std::string::npos);
  BOOST_TEST(dom.find("class=\"outer\"") != std::string::npos);
  BOOST_TEST(dom.find("class=\"hole\"") != std::string::npos);
  BOOST_TEST(dom.find("aria-selected=\"true\"") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
