#pragma once
// Another file that an entity names (IGES 416). The library never opens it: whoever calls gives its bytes, or does not.

#include <functional>
#include <optional>
#include <string>

namespace trimloop::io {

struct ExternalReference {
  std::string file;     // as the file has it, whatever it is: a path out of the folder, ten megabytes of text; may be empty
  std::string name;     // of the definition in it; empty: the whole file
  std::string library;
  bool is_plain = true; // `file` is a name without folder, drive or control characters, at most 255 bytes
};

// The bytes of the file, or nothing. Called at most `most_external_files` times for one reading, from the reading thread.
using Resolver = std::function<std::optional<std::string>(const ExternalReference&)>;

constexpr std::size_t most_external_files = 1000;
constexpr std::size_t deepest_external_file = 8;  // files that name files

}  // namespace trimloop::io
