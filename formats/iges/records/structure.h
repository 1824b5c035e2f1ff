#pragma once
// Structure, property and display records.

#include "formats/iges/records/curves.h"

namespace trimloop::iges {

struct SubfigureDefinition {  // 308
  static constexpr int type = 308;
  std::int64_t depth = 0;
  std::string name;
  std::vector<Ref> members;
  static SubfigureDefinition read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ColourDefinition {  // 314: 0..100 each
  static constexpr int type = 314;
  double red = 0, green = 0, blue = 0;
  std::string name;
  static ColourDefinition read(TokenReader&);
  void write(TokenWriter&) const;
};
// 402. Forms 1, 7, 14, 15 are groups of pointers; form 9 is a single parent and its children; others keep their tokens.
struct Associativity {
  static constexpr int type = 402;
  std::vector<Ref> members;    // groups; for form 9 the children
  Ref parent;                  // form 9
  std::vector<Field> raw;      // other forms: all that follows the type, trailing groups included
  bool single_parent = false;  // form 9
  static bool has_members(int form) { return form == 1 || form == 7 || form == 9 || form == 14 || form == 15; }
  static Associativity read(TokenReader&);
  void write(TokenWriter&) const;
};
// 406. Form 15 is a name; the values of other forms are kept as text (their count is the first parameter).
struct Property {
  static constexpr int type = 406;
  std::string name;              // form 15, when its first value is a string
  std::int64_t value_count = 0;  // as read
  std::vector<Field> raw;        // the values; not the name
  static Property read(TokenReader&);
  void write(TokenWriter&) const;
};
struct SubfigureInstance {  // 408
  static constexpr int type = 408;
  Ref definition;
  Xyz translation;
  double scale = 1;
  static SubfigureInstance read(TokenReader&);
  void write(TokenWriter&) const;
};

}  // namespace trimloop::iges
