#pragma once
// A record of one file as text for another: everything as it stands, references renamed.

#include <functional>
#include <optional>
#include <string>

#include "formats/step/file.h"
#include "formats/step/tape.h"

namespace trimloop::step {

// The new name of what a reference leads to; none where it does not come along.
using Rename = std::function<Ref(Ref)>;

// The value of the record on `tape` ("KEYWORD(...)", or the parts of a complex instance), for add_copy of the writer.
// Members of lists that do not come along are left out. Nothing when the record cannot do without them: a reference that
// is an attribute by itself, a list of which nothing is left, or a token that could not be read.
// Numbers and words keep their characters where the grammar allows them; strings are in the basic alphabet afterwards.
std::optional<std::string> copy(const Tape& tape, const Rename& rename);

}  // namespace trimloop::step
