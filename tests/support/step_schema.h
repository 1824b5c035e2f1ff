#pragma once
// Part 21 text against a table of entities that was written by hand from ISO 10303-41 to -46 and the AP242 schema, apart
// from the product's own: the number and kind of every attribute, what a reference may lead to, and the WHERE rules that
// a writer can break.

#include <string>
#include <string_view>
#include <vector>

namespace trimloop::test {

// What is wrong, a sentence each with the instance it is about; empty when all holds. At most a hundred.
std::vector<std::string> schema_faults(std::string_view part21);

}  // namespace trimloop::test
