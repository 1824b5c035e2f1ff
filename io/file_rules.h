#pragma once
// Rules of opening a file at all, whatever its format.

#include <array>

#include "base/report.h"

namespace trimloop::io::file_rules {

inline constexpr Rule size{
    "LM-01", "file-size", Severity::Fatal, "the file is not larger than the ceiling",
    "a file of unexpected size can take all memory of the machine", "raise the ceiling with --limit-size if the file is meant",
    "bytes", ""};
inline constexpr Rule nothing_usable{
    "MD-20", "nothing-usable", Severity::Fatal, "the file holds an entity that can be read",
    "there is nothing to convert, measure, show or list", "`trimloop dump FILE` lists what is in it; check the export settings of the sender",
    "", ""};
inline constexpr Rule format{
    "MD-21", "format-not-readable", Severity::Fatal, "the content is of a format that this version reads",
    "only the sender's words say what the file is; its bytes are of another kind", "open it with the program that made it and export IGES 5.3, fixed ASCII",
    "", ""};
inline constexpr Rule cannot_read{
    "MD-22", "cannot-read", Severity::Fatal, "the operating system hands out the file",
    "without its bytes nothing can be said about the file", "check the path and the rights", "", ""};

inline constexpr std::array<const Rule*, 4> all{&size, &nothing_usable, &format, &cannot_read};

}  // namespace trimloop::io::file_rules
