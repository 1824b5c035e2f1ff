#pragma once
// Two bodies made ready: their common network and the pieces of their faces (not part of the public face).

#include <memory>

#include "kernel/boolean/assemble.h"
#include "kernel/boolean/boolean.h"

namespace trimloop::boolean {

struct Setting {
  Operand a, b;
  Prepared prepared;  // points into the two
};
// The bodies must outlive it.
Result<std::unique_ptr<Setting>> prepare(const Body& a, const Body& b, const BooleanOptions&);

// The largest extent or coordinate; the largest gap at a vertex or between an edge and a face.
double size_of(const Body&);
double largest_gap(const Body&);

// InvalidArgument unless every face is in a closed shell.
Result<void> check_closed(const Body&);

}  // namespace trimloop::boolean
