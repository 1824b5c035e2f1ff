#pragma once
// Product manufacturing information of a STEP file, by the names of its entities. ISO 10303-47, -101, -1050 and the
// recommended practice for PMI. It is not understood further: it is listed (list_pmi of io.h) and kept on writing
// (opaque.h).

#include <map>
#include <string>
#include <string_view>

#include "base/limits.h"
#include "formats/step/file.h"

namespace trimloop::io {

// "dimensions", "tolerances", "datums", "annotations", "views": what is counted; empty for all else. Parts of complex
// instances are joined by '+'.
std::string_view pmi_kind(std::string_view keyword);
// True for what is counted and for what ties it together: shape aspects, callouts, drawing models, their relations.
bool is_pmi(std::string_view keyword);

// Properties of parts that are no validation properties, by their names: materials, densities, attributes of users.
std::map<std::string, std::size_t> count_properties(const step::File& file, const Limits& limits);

}  // namespace trimloop::io
