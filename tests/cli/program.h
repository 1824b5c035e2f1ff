#pragma once
// The program itself, run as a user runs it, in a folder of its own.

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>

#include "tests/support/paths.h"

namespace trimloop::test {

struct Ran {
  int code = -1;
  std::string out;
};

// Standard error goes to `folder`/err.
struct Program {
  std::filesystem::path folder = binary_dir() / "scratch_cli";
  std::filesystem::path models = binary_dir() / "samples" / "models";
  Program() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~Program() { std::filesystem::remove_all(folder); }

  Ran operator()(const std::string& arguments) const {
    const std::string command = "cd '" + folder.string() + "' && '" + binary_dir().string() + "/cli/trimloop' " + arguments + " 2>err";
    Ran ran;
    FILE* pipe = ::popen(command.c_str(), "r");
    BOOST_REQUIRE(pipe != nullptr);
    std::array<char, 4096> block;
    std::size_t n = 0;
    while ((n = std::fread(block.data(), 1, block.size(), pipe)) > 0) ran.out.append(block.data(), n);
    const int status = ::pclose(pipe);
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    return ran;
  }
  std::string model(const char* name) const { return fmt::format("'{}'", (models / name).string()); }
  std::string content(const char* name) const {
    std::ifstream in(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const char* name, const std::string& bytes) const { std::ofstream(folder / name, std::ios::binary) << bytes; }
};

}  // namespace trimloop::test
