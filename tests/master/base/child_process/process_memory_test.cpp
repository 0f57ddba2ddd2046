#include "master/base/child_process/process_memory.h"

#include <cstring>
#include <string>

#include <catch2/catch.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "tests/build.h"

using namespace stride::isolation;

TEST_CASE("memory that was used counts, also when it is no longer there") {
  constexpr std::size_t kSize = std::size_t{64} << 20;
  const ChildOutcome outcome = run_in_child([&] {
    const pid_t self = ::getpid();
    const std::uint64_t before = private_memory(self);
    void* const block =
        ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    std::memset(block, 'x', kSize);
    const std::uint64_t with = private_memory(self);
    ::munmap(block, kSize);
    const std::uint64_t after = private_memory(self);
    std::string text;
    // not to the byte: a page of the program is no longer private once another process has it, too
    for (const bool holds : {before > 0, with > before + kSize - kSize / 8,
                             after + kSize / 2 < with, most_memory(self) >= kSize}) {
      text += holds ? '1' : '0';
    }
    return text;
  });
  CHECK(outcome.text == "1111");
}

TEST_CASE("memory that was allocated counts, also if it was never used") {
  constexpr std::size_t kSize = std::size_t{64} << 20;
  const ChildOutcome outcome = run_in_child([&] {
    const std::uint64_t before = data_memory(::getpid());
    ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    const std::uint64_t more = data_memory(::getpid()) - before;
    return std::string(before > 0 && more >= kSize && more < 2 * kSize ? "counted" : "not");
  });
  CHECK(outcome.text == "counted");
}

TEST_CASE("the memory of a process that does not exist is 0") {
  CHECK(most_memory(-1) == 0);
  CHECK(private_memory(-1) == 0);
  CHECK(data_memory(-1) == 0);
}

TEST_CASE("a limit leaves as much memory as it says, beside what is in use") {
  if (stride::tests::kSanitized) return;  // AddressSanitizer needs memory of its own without end
  constexpr std::size_t kMiB = std::size_t{1} << 20;
  const auto can_map = [](std::size_t size) {
    return run_in_child([size] {
             limit_memory(64 * kMiB);
             void* const block =
                 ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
             return std::string(block == MAP_FAILED ? "no" : "yes");
           })
        .text;
  };
  CHECK(can_map(56 * kMiB) == "yes");
  CHECK(can_map(72 * kMiB) == "no");
}
