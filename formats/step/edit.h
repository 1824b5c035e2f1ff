#pragma once
// Changes to one instance that leave every other byte of the file as it was. Part 21 has no counters and no line lengths,
// so that a parameter's own text is all that changes.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "formats/step/file.h"

namespace trimloop::step {

// Which parameter: "4" the fourth attribute, "2.3" the third member of the second one (a list, or the value within a typed
// parameter), "SI_UNIT.1" the first attribute of that part of a complex instance. Numbers as `dump` shows them.
struct ParameterPath {
  std::string part;                // empty: of a simple instance
  std::vector<std::size_t> steps;  // from 1; at least one
};
std::optional<ParameterPath> parameter_path(std::string_view text);

// The text that stands there, without the blanks and comments around it. NotFound when there is no such instance or
// parameter, InvalidArgument when the instance cannot be read so far.
Result<std::string_view> parameter_at(const File&, Ref, const ParameterPath&);

// The whole file with `text` (as it shall stand: "0.25", "'abc'", ".T.", "#12", "$", "(1.,2.)") in that place. Refused
// (InvalidArgument) unless the text is exactly one parameter by the grammar and every instance it names is there.
Result<std::string> set_parameter(const File&, Ref, const ParameterPath&, std::string_view text);

// The text of `value` by the kind of what stands there: reals in shortest exact form, strings encoded and in apostrophes,
// enumerations between points; "$" unsets anything. For lists, typed and unset parameters the value is text already.
// Refused (InvalidArgument) when the value is none of that kind.
Result<std::string> parameter_text(const File&, Ref, const ParameterPath&, std::string_view value);

}  // namespace trimloop::step
