#include "tests/support/corpus.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace trimloop::test {

std::vector<std::filesystem::path> corpus_files(const std::string& folder) {
  namespace fs = std::filesystem;
  const char* stated = std::getenv("TRIMLOOP_CORPUS");
  const fs::path root = (stated ? fs::path(stated) : trimloop::test::source_dir() / "../shared/corpus") / folder;
  std::vector<fs::path> files;
  std::error_code none;
  for (fs::recursive_directory_iterator at(root, none), end; !none && at != end; at.increment(none))
    if (at->is_regular_file()) files.push_back(at->path());
  std::sort(files.begin(), files.end());
  if (files.empty()) BOOST_TEST_MESSAGE("SKIPPED: no corpus at " << root << "; set TRIMLOOP_CORPUS");
  return files;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace trimloop::test
