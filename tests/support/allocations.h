#pragma once
// The largest single piece of memory that the program has asked for since it was last told to forget. A test program
// that calls this has its operator new replaced (allocations.cpp); others are left alone.

#include <cstddef>

namespace trimloop::test {

std::size_t largest_allocation();
void forget_allocations();

}  // namespace trimloop::test
