#include "master/study/verify/disturbance.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace stride::verify {
namespace {

/// Fills the stack below with a pattern, so that a variable without a value has another one.
[[gnu::noinline]] void soil_stack() {
  volatile unsigned char bytes[256 * 1024];
  for (volatile unsigned char& byte : bytes) byte = 0xA5;
}

/// Takes all blocks that lie about in the heap, so that further ones come from above it.
void use_up_heap() {
  const auto top = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  constexpr std::size_t kLargest = 4096, kStep = 16, kMost = 100'000;
  for (std::size_t size = kStep; size <= kLargest; size += kStep) {
    for (std::size_t i = 0; i < kMost; ++i) {
      void* volatile const block = std::malloc(size);  // for as long as this process lives
      if (reinterpret_cast<std::uintptr_t>(block) >= top) break;
    }
  }
}

}  // namespace

void disturb() {
  constexpr int kPattern = 0x5A;
  constexpr std::size_t kShift = 97 << 12;
  use_up_heap();
  ::mallopt(M_PERTURB, kPattern);
  ::mmap(nullptr, kShift, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ::setenv("STRIDE_VERIFY_DISTURBED", "an environment of another length", 1);
  soil_stack();
}

}  // namespace stride::verify
