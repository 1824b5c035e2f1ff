#pragma once
// Names and texts that could do harm where a careless program shows or uses them.

#include <array>
#include <string_view>

#include "base/report.h"
#include "kernel/model/model.h"

namespace trimloop::io {

namespace name_rules {

inline constexpr Rule hostile_name{
    "MD-15", "name-encoding", Severity::Warning,
    "names and texts hold no control characters, markup, formulas or paths",
    "a terminal, a web page, a table or a program that makes files of names may act on them",
    "trimloop escapes them wherever it shows them; rename the object before others read the file",
    "", ""};

inline constexpr Rule path_escape{
    "MD-17", "path-escape", Severity::Error,
    "a file that is referred to lies in the folder of the file that names it",
    "who opens it reads whatever the name leads to, on this machine or another",
    "nothing is opened on its own; put the file beside this one and name it alone",
    "", ""};

inline constexpr std::array<const Rule*, 2> all{&hostile_name, &path_escape};

}  // namespace name_rules

// What a text could be taken for: "control characters", "markup", "a formula", "a path"; empty where it is harmless.
std::string_view hostile_part(std::string_view text);

// Absolute, on another host, or through the folder above.
bool escapes_folder(std::string_view file_name);

struct HostileName {
  std::string text;
  std::string_view part;  // as hostile_part says
  SourceRefs source;
};
// Of parts, bodies, faces, curves, points, occurrences, notes, layers, views and drawings, in the model's order; each text once.
std::vector<HostileName> hostile_names(const Model&);

}  // namespace trimloop::io
