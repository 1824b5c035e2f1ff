#include "formats/iges/records/any.h"

#include <algorithm>

namespace trimloop::iges {
namespace {

using Body = decltype(AnyRecord::body);

template <class Record>
Body read_body(TokenReader& in) {
  return Record::read(in);
}

struct TypeReader {
  int type;
  Body (*read)(TokenReader&);
};

// One reader for each struct that the variant names; the variant is the table's only source.
template <class... Records>
constexpr auto type_readers(const std::variant<RawRecord, TableRecord, Records...>*) {
  std::array<TypeReader, sizeof...(Records)> table{TypeReader{Records::type, &read_body<Records>}...};
  std::sort(table.begin(), table.end(), [](const TypeReader& a, const TypeReader& b) { return a.type < b.type; });
  return table;
}

constexpr auto readers = type_readers(static_cast<const Body*>(nullptr));

const TypeReader* find_reader(int type) {
  const auto found = std::lower_bound(readers.begin(), readers.end(), type,
                                      [](const TypeReader& reader, int wanted) { return reader.type < wanted; });
  return found != readers.end() && found->type == type ? &*found : nullptr;
}

RawRecord raw_record(TokenReader in) {
  RawRecord raw;
  while (in.left() > 0) raw.fields.push_back(in.field());
  return raw;
}

// Associativities other than groups and single parents are tables of fields.
bool by_table(int type, int form) {
  return type == Associativity::type && !Associativity::has_members(form) && find_layout(type, form) != nullptr;
}

}  // namespace

bool has_struct(int type) { return find_reader(type) != nullptr; }
bool is_typed(int type, int form) { return has_struct(type) || (type != 0 && find_layout(type, form)); }

AnyRecord read_any(const File& file, const DirectoryEntry& entry, const Parameters& parameters, const Limits& limits,
                   Report& report) {
  AnyRecord record;
  TokenReader in(file, entry, parameters, limits, report);
  const TypeReader* reader = by_table(entry.type, entry.form) ? nullptr : find_reader(entry.type);
  const Layout* layout = reader || entry.type == 0 ? nullptr : find_layout(entry.type, entry.form);
  if (reader || layout) {
    record.body = reader ? reader->read(in) : Body{TableRecord::read(in, *layout)};
    if (in.ok()) {
      record.groups = in.trailing_groups();
      record.as_given = in.as_given();
      return record;
    }
  }
  record.body = raw_record(TokenReader(file, entry, parameters, limits, report));
  return record;
}

AnyRecord read_any(const File& file, const DirectoryEntry& entry, const Limits& limits, Report& report) {
  return read_any(file, entry, file.parameters(entry, report), limits, report);
}

std::vector<std::string> write_any(const AnyRecord& record) {
  TokenWriter out;
  if (const RawRecord* raw = record.as<RawRecord>()) {
    for (const Field& field : raw->fields) out.field(field);
    return out.tokens();
  }
  std::visit(
      [&out](const auto& body) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(body)>, RawRecord>) body.write(out);
      },
      record.body);
  out.trailing_groups(record.groups);
  std::vector<std::string> tokens = out.tokens();
  record.as_given.restore(tokens);
  return tokens;
}

}  // namespace trimloop::iges
