#pragma once
// An IGES file in memory: the bytes as they came, an index over their cards, the Global values and the Directory.
// Parameter data stay text until a record is asked for. Untouched files go back byte for byte.
//
//   bytes -> cards (cards.h) -> Global (global.h), Directory (directory.h) -> tokens (tokens.h) -> records (records/)

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/report.h"

namespace trimloop::iges {

// Directory pointer: the odd sequence number of a directory entry's first card; 0 = none. Negative values have a
// meaning only where the entity says so (colour 314, font 304, levels 406).
struct Ref {
  std::int32_t de = 0;
  explicit operator bool() const { return de != 0; }
  friend bool operator==(Ref a, Ref b) { return a.de == b.de; }
  friend bool operator!=(Ref a, Ref b) { return a.de != b.de; }
};

// The 26 Global parameters (IGES 5.3 2.2.4.3) with their defaults applied; absent ones keep the default.
struct Global {
  char parameter_delimiter = ',', record_delimiter = ';';
  std::string sender_product, file_name, native_system, preprocessor;
  int integer_bits = 32, single_magnitude = 38, single_significance = 6, double_magnitude = 308, double_significance = 15;
  std::string receiver_product;
  double model_scale = 1;
  int unit_flag = 1;
  std::string unit_name;
  bool unit_known = true;     // false: the file's unit cannot be told (IG-G15, IG-G17); millimetres are assumed
  int weight_gradations = 1;
  double max_line_width = 0;
  std::string date;
  double resolution = 0;      // model units; 0 = not stated
  double max_coordinate = 0;  // 0 = not stated
  std::string author, organization;
  int version_flag = 3;       // effective value, clamped to 1..11
  int drafting_standard = 0;
  std::string modified, protocol;
  std::size_t fields_present = 0;
};
std::string_view version_name(int version_flag);  // 11 -> "5.3"
double unit_in_mm(const Global& global);          // one unit of field 14 or 15; a model length is value * unit / model_scale
// Field 19 in mm when it lies between 1e-9 and 0.1 mm, else 0.001 (IG-G22, IG-G23).
double resolution_in_mm(const Global& global);

struct Status {
  int blank = 0, subordinate = 0, use = 0, hierarchy = 0;
};

struct DirectoryEntry {
  int type = 0, form = 0;
  int parameter_pointer = 0, parameter_count = 0;   // as stated: first P sequence number, number of P cards
  int structure = 0, line_font = 0, level = 0, view = 0, transform = 0, label_display = 0;
  Status status;
  int line_weight = 0, colour = 0;
  std::string label;                                // blanks trimmed
  int subscript = 0;
  std::int32_t de = 0;                              // own pointer, odd
  std::size_t offset = 0;                           // of the first card, in bytes
  bool usable = true;                               // false: a finding says why; kept raw
};

// One piece of parameter data text: a lexed field, undecoded.
struct Token {
  enum class Kind : std::uint8_t { Empty, Text, Hollerith } kind = Kind::Empty;
  std::string_view text;        // without delimiters; Hollerith: the string's bytes without the nH prefix
  std::size_t offset = 0;       // of its first byte in the file (a Hollerith's count included)
};

// The tokens of one record, as views into `joined`: it may be moved, not copied.
struct Parameters {
  Parameters() = default;
  Parameters(Parameters&&) = default;
  Parameters& operator=(Parameters&&) = default;

  std::vector<Token> tokens;    // [0] is the entity type
  std::string joined;           // backing text of the record (data columns of its cards, joined)
  std::string comment;          // text after the record delimiter
  bool terminated = true;
  std::size_t first_card = 0, card_count = 0;  // Parameter cards, counted from 0
};

struct Cards;

class File {
 public:
  // Reads the structure of `bytes` (copied or moved in). What is wrong goes to `report`; a file that cannot be one
  // gets a Fatal finding and comes back without entities. Linear time; memory below 3 x size + a constant.
  static File parse(std::string bytes, const Limits& limits, Report& report);

  std::string_view bytes() const;
  const Cards& cards() const;                              // cards.h: where everything stands
  const Global& global() const;
  std::string_view start_text() const;                     // Start section, data columns, trailing blanks cut
  const std::vector<DirectoryEntry>& directory() const;
  const DirectoryEntry* find(Ref ref) const;               // null when there is no such entry
  // Lexes the record of an entry. Findings (IG-P..) go to `report` with their places.
  Parameters parameters(const DirectoryEntry& entry, Report& report) const;
  void parameters(const DirectoryEntry& entry, Parameters& out, Report& report) const;  // reuses what `out` has allocated
  Location locate(std::size_t offset) const;               // line, column and section of a byte
  // The file as it is: equal to the bytes it was parsed from.
  std::string write() const;

  File(File&&) noexcept;
  File& operator=(File&&) noexcept;
  ~File();

 private:
  File();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// True when the first bytes look like fixed ASCII IGES; `reason` names compressed and binary forms.
enum class Sniff : std::uint8_t { No, FixedAscii, CompressedAscii, Binary };
Sniff sniff(std::string_view first_bytes);

}  // namespace trimloop::iges
