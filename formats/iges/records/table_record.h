#pragma once
// Records of the types without a struct: decoded and encoded by the layout table, looked up by the standard's names.

#include <variant>

#include "formats/iges/records/layout.h"
#include "formats/iges/records/record.h"

namespace trimloop::iges {

struct TableRecord {
  // One parameter, as its layout says: integer or count or logical, real, string, pointer, or any text.
  using Value = std::variant<std::int64_t, double, std::string, Ref, Field>;

  const Layout* layout = nullptr;
  std::vector<Value> values;  // own parameters in order

  // By layout. What is wrong is in the report of `in`, and `in.ok()` tells whether the record can be used.
  static TableRecord read(TokenReader& in, const Layout& layout);
  void write(TokenWriter& out) const;

  // Values by name, under list indices counted from 1; the neutral value when there is none.
  double real(std::string_view name, std::initializer_list<std::size_t> at = {}) const;
  std::int64_t integer(std::string_view name, std::initializer_list<std::size_t> at = {}) const;
  Ref ref(std::string_view name, std::initializer_list<std::size_t> at = {}) const;  // also of a kind "P"
  std::string_view string(std::string_view name, std::initializer_list<std::size_t> at = {}) const;
  Xyz xyz(std::string_view x, std::string_view y, std::string_view z, std::initializer_list<std::size_t> at = {}) const {
    return {real(x, at), real(y, at), real(z, at)};
  }
  // A count, never more than the record has values.
  std::size_t count(std::string_view name) const;

 private:
  const Value* find(std::string_view name, std::initializer_list<std::size_t> at) const;
};

// Every pointer of the record's own parameters, positive ones as they are, negative ones (-DE) turned.
std::vector<Ref> pointers(const TableRecord& record);

}  // namespace trimloop::iges
