#include "master/base/process/fork_mark.h"

#include <new>

#include <sys/mman.h>

namespace stride::core {
namespace {

/// On a page of its own.
std::atomic<char>& make_byte() {
  constexpr std::size_t kSize = 1;
  void* const page =
      ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) throw std::bad_alloc();
  ::madvise(page, kSize, MADV_WIPEONFORK);
  return *new (page) std::atomic<char>(0);
}

}  // namespace

std::atomic<char>& ForkMark::byte_ = make_byte();

}  // namespace stride::core
