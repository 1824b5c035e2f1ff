#pragma once
// Real files for tests: TRIMLOOP_CORPUS, or ../shared/corpus beside the repository. They are never part of it.

#include <filesystem>
#include <string>
#include <vector>

namespace trimloop::test {

// All files under `folder` ("iges", "step") of the corpus, sorted; empty, with a message in the test log, when there is none.
std::vector<std::filesystem::path> corpus_files(const std::string& folder);

std::string read_file(const std::filesystem::path& path);

}  // namespace trimloop::test
