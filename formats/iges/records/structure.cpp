#include "formats/iges/records/structure.h"

#include <fmt/format.h>

#include "formats/iges/records/checks.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

// 308 Subfigure Definition (IGES 5.3 4.74): DEPTH, NAME, N, DE(1..N)
SubfigureDefinition SubfigureDefinition::read(TokenReader& in) {
  SubfigureDefinition r;
  r.depth = in.integer_or(0);
  r.name = in.string_or({});
  r.members = in.refs(in.count(1));
  return checked(std::move(r), in);
}

void SubfigureDefinition::write(TokenWriter& out) const {
  out.integer(depth);
  out.string(name);
  out.count(members.size());
  out.refs(members);
}

// 314 Color Definition (4.76): CC1, CC2, CC3 (per cent of red, green, blue), CNAME (default none)
ColourDefinition ColourDefinition::read(TokenReader& in) {
  ColourDefinition r;
  r.red = in.real();
  r.green = in.real();
  r.blue = in.real();
  in.optional_tail(1);
  r.name = in.string_or({});
  return checked(std::move(r), in);
}

void ColourDefinition::write(TokenWriter& out) const {
  out.real(red);
  out.real(green);
  out.real(blue);
  out.string(name);
}

// 402 Associativity Instance. Groups, forms 1, 7, 14, 15 (4.80, 4.86, 4.93, 4.94): N, DE(1..N).
// Single parent, form 9 (4.88): 1, NC, the parent, the children. Other forms: as they stand.
Associativity Associativity::read(TokenReader& in) {
  Associativity r;
  const int form = in.form();
  if (form == 1 || form == 7 || form == 14 || form == 15) {
    r.members = in.refs(in.count(1));
  } else if (form == 9) {
    r.single_parent = true;
    const std::size_t parents = in.count(1), children = in.count(1);
    if (in.ok() && parents != 1)
      in.fault_at(1, rules::e402::associativity, fmt::format("{} parents where there is one", parents),
                  static_cast<double>(parents), 1);
    if (!in.ok() || !in.room(1 + children)) return r;
    r.parent = in.ref();
    r.members = in.refs(children);
  } else {
    while (in.left() > 0) r.raw.push_back(in.field());
  }
  return checked(std::move(r), in);
}

void Associativity::write(TokenWriter& out) const {
  for (const Field& field : raw) out.field(field);
  if (!raw.empty()) return;
  if (single_parent) out.integer(1);
  out.count(members.size());
  if (single_parent) out.ref(parent);
  out.refs(members);
}

// 406 Property (4.98 and following): NP, V(1..NP)
Property Property::read(TokenReader& in) {
  Property r;
  r.raw.resize(in.count(1));
  for (Field& value : r.raw) value = in.field();
  r.value_count = static_cast<std::int64_t>(r.raw.size());
  const bool named = in.form() == 15 && !r.raw.empty() && r.raw[0].kind == Token::Kind::Hollerith;
  if (named && !r.raw[0].text.empty()) {
    r.name = std::move(r.raw[0].text);
    r.raw.erase(r.raw.begin());
  }
  return checked(std::move(r), in);
}

void Property::write(TokenWriter& out) const {
  out.count(raw.size() + (name.empty() ? 0 : 1));
  if (!name.empty()) out.string(name);
  for (const Field& value : raw) out.field(value);
}

// 408 Singular Subfigure Instance (4.133): DE, X, Y, Z, S (default 1)
SubfigureInstance SubfigureInstance::read(TokenReader& in) {
  SubfigureInstance r;
  r.definition = in.ref();
  r.translation = in.xyz();
  in.optional_tail(1);
  r.scale = in.real_or(1);
  return checked(r, in);
}

void SubfigureInstance::write(TokenWriter& out) const {
  out.ref(definition);
  out.xyz(translation);
  out.real(scale);
}

}  // namespace trimloop::iges
