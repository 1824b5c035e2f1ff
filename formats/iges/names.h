#pragma once
// Names of entity types and forms, as in IGES 5.3; and how a record's parameters are called (for dump and findings).

#include <string>
#include <string_view>
#include <vector>

#include "formats/iges/file.h"

namespace trimloop::iges {

std::string_view form_name(int type, int form);  // "Witness Line" (106:40); "" when the standard has no such form
std::string_view entity_name(int type);  // "Rational B-Spline Curve"; "" when not in the standard

// The standard's name of parameter `index` (1 = first after the type) of a typed record: "K", "T(-3)", "X(2)", "PTI(1)";
// "" where it is not known. Lists are laid out by the counts in `parameters`; the short form knows only what
// stands before the first list.
std::string parameter_name(int type, int form, std::size_t index);
std::string parameter_name(int type, int form, std::size_t index, const Parameters& parameters);
// Of all own parameters at once: [0] is that of parameter 1. Ends where a name is not known.
std::vector<std::string> parameter_names(int type, int form, const Parameters& parameters);

}  // namespace trimloop::iges
