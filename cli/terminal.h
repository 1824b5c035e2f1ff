#pragma once
// What every verb needs to talk to a person: messages on standard error, findings with their card, a progress bar.

#include <functional>
#include <string>
#include <string_view>

#include "cli/options.h"
#include "io/io.h"

namespace trimloop::cli {

// "trimloop: error: WHAT" and, when there is something to type next, a second line "  try: NEXT".
void complain(const Common&, std::string_view what, std::string_view next = {});
void say(const Common&, std::string_view line);  // to standard error unless --quiet

// Data to standard output or to --output; false (after a complaint) when that failed.
bool emit(const Common&, std::string_view data);

// Reads FILE, or standard input for "-".
io::ReadResult read_input(const Common&, const std::string& file, io::ReadOptions options = {});
// "auto", "off" or a length in mm into the options; false when it is none of them.
bool take_sew(const std::string& word, io::ReadOptions&);
// The exit code that a read which gave no model calls for.
int exit_code_of(const io::ReadResult&);

// file:line:column: severity[ID slug]: text, with owners, the raw card and a caret.
std::string describe(const Common&, const io::ReadResult&, const Diagnostic&);
// "3 errors, 12 warnings" or "no findings".
std::string summary(const Report&);
// One line that says why nothing could be used: the first fatal finding.
void complain_unusable(const Common&, const std::string& file, const io::ReadResult&);

bool use_color(const Common&);
// A bar on standard error after half a second, only on a terminal (or --progress always). Empty function when off.
std::function<void(double)> progress_bar(const Common&, std::string label);
void end_progress(const Common&);

}  // namespace trimloop::cli
