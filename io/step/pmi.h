#pragma once
// Product manufacturing information of a STEP file, by the names of its entities. ISO 10303-47, -101, -1050 and the
// recommended practice for PMI. It is not understood further: it is listed (list_pmi of io.h) and kept on writing
// (opaque.h).

#include <string_view>

namespace trimloop::io {

// "dimensions", "tolerances", "datums", "annotations", "views": what is counted; empty for all else. Parts of complex
// instances are joined by '+'.
std::string_view pmi_kind(std::string_view keyword);
// True for what is counted and for what ties it together: shape aspects, callouts, drawing models, their relations.
bool is_pmi(std::string_view keyword);

}  // namespace trimloop::io
