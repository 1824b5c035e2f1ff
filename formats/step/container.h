#pragma once
// Compressed STEP files, told by their first bytes: gzip (.stp.gz), ZIP of edition 3 (root ISO-10303.p21) and stpZ.

#include <optional>
#include <string>
#include <string_view>

#include "base/limits.h"
#include "base/report.h"

namespace trimloop::step {

enum class Container : std::uint8_t { None, Gzip, Zip };
Container container_of(std::string_view first_bytes);

// What is unpacked may be this many times as large as what is packed (and a mebibyte at least): Part 21 text packs to a
// tenth or so.
constexpr std::size_t largest_ratio = 200;

// The one Part 21 file inside, or nothing after a fatal finding (SP-F35, LM-01). Memory: what is unpacked.
std::optional<std::string> unpack(std::string_view packed, const Limits& limits, Report& report);

}  // namespace trimloop::step
