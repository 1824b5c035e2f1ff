#include "formats/obj/obj.h"

#include <fmt/format.h>

#include <iterator>

namespace trimloop::obj {

namespace {

// A name on one line: blanks and control bytes would end it early.
std::string one_word(const std::string& name) {
  std::string word;
  for (const char c : name) word += static_cast<unsigned char>(c) <= ' ' ? '_' : c;
  return word;
}

}  // namespace

Result<std::string> write(const Document& document) {
  std::string out;
  const auto to = std::back_inserter(out);
  if (!document.comment.empty()) fmt::format_to(to, "# {}\n", document.comment);
  for (const auto& p : document.positions) fmt::format_to(to, "v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& n : document.normals) fmt::format_to(to, "vn {:.7g} {:.7g} {:.7g}\n", n[0], n[1], n[2]);
  for (const Group& group : document.groups) {
    if (group.normals.size() != group.positions.size()) {
      return fail(ErrorCode::InvalidArgument, "OBJ group has as many normal as position triples",
                  static_cast<double>(group.normals.size()), static_cast<double>(group.positions.size()));
    }
    fmt::format_to(to, "g {}\n", one_word(group.name));
    for (std::size_t i = 0; i < group.positions.size(); ++i) {
      const auto& p = group.positions[i];
      const auto& n = group.normals[i];
      fmt::format_to(to, "f {}//{} {}//{} {}//{}\n", p[0] + 1, n[0] + 1, p[1] + 1, n[1] + 1, p[2] + 1, n[2] + 1);
    }
  }
  return out;
}

}  // namespace trimloop::obj
