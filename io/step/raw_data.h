#pragma once
// What stands in a STEP file and means nothing to us: approvals, persons, dates, loads, nets, ... It stays on the repair road;
// a model does not carry it, so it is a loss of whoever writes another file, and named as one.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "formats/step/file.h"

namespace trimloop::io {

// True for a kind of instance that is neither read nor written anew, nor counted as product manufacturing information. Documents
// are read for a finding only.
bool is_raw(const step::Keyword& keyword);

// "other data: 67 APPROVAL, 46 PERSON, 12 of 4 more kinds", the most frequent ones first; empty when nothing is counted.
std::string list_raw_data(const std::map<std::string_view, std::size_t>& count);

}  // namespace trimloop::io
