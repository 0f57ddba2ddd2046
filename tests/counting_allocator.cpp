#include "tests/counting_allocator.h"

#include <cstdlib>
#include <new>

namespace stride::tests {

std::atomic<long> allocations = 0;

}  // namespace stride::tests

// Replaces the program's operator new. Inlined, GCC takes new and free for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++stride::tests::allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++stride::tests::allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
