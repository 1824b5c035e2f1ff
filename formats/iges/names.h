#pragma once
// Names of entity types and forms, as in IGES 5.3; and how a record's parameters are called (for dump and findings).

#include <string>
#include <string_view>

namespace trimloop::iges {

std::string_view entity_name(int type);                       // "Rational B-Spline Curve"; "" when not in the standard
std::string parameter_name(int type, int form, std::size_t index);  // "T(8)"-like where known, else ""

}  // namespace trimloop::iges
