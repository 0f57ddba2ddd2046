// What a program takes from the heap, counted: to be linked with tests/counting_allocator.cpp.
#ifndef STRIDE_TESTS_COUNTING_ALLOCATOR_H
#define STRIDE_TESTS_COUNTING_ALLOCATOR_H

#include <atomic>

namespace stride::tests {

/// Blocks that the program and the units in it have taken so far.
extern std::atomic<long> allocations;

}  // namespace stride::tests

#endif
