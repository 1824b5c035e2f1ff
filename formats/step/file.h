#pragma once
// A STEP file (ISO 10303-21, editions 1 to 3) in memory: the bytes as they came and an index of its instances. Parameters
// stay text until a record is asked for. Untouched files go back byte for byte.
//
//   bytes -> index (sections, instance -> place and keyword) -> tape of one record (tape.h) -> records (records/)

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/limits.h"
#include "base/report.h"
#include "formats/step/entities.h"

namespace trimloop::step {

// Instance name: #42. 0 = none.
struct Ref {
  std::uint64_t id = 0;
  explicit operator bool() const { return id != 0; }
  friend bool operator==(Ref a, Ref b) { return a.id == b.id; }
  friend bool operator!=(Ref a, Ref b) { return a.id != b.id; }
  friend bool operator<(Ref a, Ref b) { return a.id < b.id; }
};

// Where an instance stands. 24 bytes each: of a large file they are most of the index.
struct Instance {
  std::uint64_t id = 0;
  std::uint64_t offset = 0;     // of '#'
  std::uint32_t length = 0;     // up to and with the ';'
  std::uint16_t value = 0;      // bytes from '#' to the keyword or to the '(' of a complex instance
  std::uint16_t keyword = 0;    // into File::keywords()
};

// What instances are of: one keyword, or all parts of a complex instance joined by '+', in the file's order.
struct Keyword {
  std::string name;             // "ADVANCED_FACE", "BOUNDED_CURVE+B_SPLINE_CURVE+..."
  Entity entity = Entity::None; // of a simple instance that we mean something by
  EntitySet is;                 // these, and all their supertypes
  bool is_complex = false;
  std::size_t count = 0;        // instances
};

struct Header {
  std::vector<std::string> description;
  std::string implementation_level;  // "2;1"
  std::string name, time_stamp;
  std::vector<std::string> authors, organizations;
  std::string preprocessor, originating_system, authorisation;
  std::vector<std::string> schemas;  // as written: "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"
};

struct Section {
  enum class Kind : std::uint8_t { Header, Anchor, Reference, Data, Signature } kind = Kind::Data;
  std::size_t offset = 0, length = 0;           // from the keyword to its ENDSEC;
  std::size_t first_instance = 0, end_instance = 0;  // of DATA sections
  std::string name;                             // DATA('name',('SCHEMA'))
  std::vector<std::string> schemas;
};

// ANCHOR: <name> = item {tags}; REFERENCE: #id = <uri#anchor>. Nothing is ever fetched.
struct Anchor {
  std::string name, item;
  std::size_t offset = 0;
};
struct ExternalReference {
  std::string lhs, uri;
  std::size_t offset = 0;
};

class File {
 public:
  // Reads the structure of `bytes` (moved in). What is wrong goes to `report`; a file that cannot be one gets a Fatal
  // finding and comes back without instances. Linear time, one pass; the index takes about 30 bytes an instance.
  static File parse(std::string bytes, const Limits& limits, Report& report);

  std::string_view bytes() const { return bytes_; }
  const Header& header() const { return header_; }
  const std::vector<Section>& sections() const { return sections_; }
  const std::vector<Anchor>& anchors() const { return anchors_; }
  const std::vector<ExternalReference>& references() const { return references_; }
  const std::vector<Instance>& instances() const { return instances_; }   // in the file's order
  const std::vector<Keyword>& keywords() const { return keywords_; }
  const Keyword& keyword(const Instance& i) const { return keywords_[i.keyword]; }
  bool is(const Instance& i, Entity e) const { return keywords_[i.keyword].is.test(static_cast<std::size_t>(e)); }
  // The instance of that name (the first one, where it is defined twice), or null.
  const Instance* find(Ref ref) const;
  std::size_t index(const Instance& i) const { return static_cast<std::size_t>(&i - instances_.data()); }
  // "#42=...;" as the file has it, and from its keyword or '(' to before the ';'.
  std::string_view text(const Instance& i) const { return std::string_view(bytes_).substr(i.offset, i.length); }
  std::string_view value(const Instance& i) const;
  // Fills in lines and columns of what has an offset.
  void locate(Report& report) const;
  Location locate(std::size_t offset) const;
  // The file as it is: equal to the bytes it was parsed from.
  const std::string& write() const { return bytes_; }

  File() = default;
  File(File&&) noexcept = default;
  File& operator=(File&&) noexcept = default;

 private:
  friend class Indexer;
  void build_lookup(Report& report);

  std::string bytes_;
  Header header_;
  std::vector<Section> sections_;
  std::vector<Anchor> anchors_;
  std::vector<ExternalReference> references_;
  std::vector<Instance> instances_;
  std::vector<Keyword> keywords_;
  std::vector<std::uint32_t> dense_;                           // id -> index + 1, where ids lie close together
  std::unordered_map<std::uint64_t, std::uint32_t> sparse_;    // else
};

// True when the first bytes (comments and a byte-order mark passed over) begin a Part 21 file.
bool sniff(std::string_view first_bytes);

// "AP203", "AP214", "AP242 edition 3", ..., from names and object identifiers; empty when not known.
std::string protocol_of(const std::vector<std::string>& schemas);

}  // namespace trimloop::step
