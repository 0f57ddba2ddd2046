#include "master/loader/process/memory_watch.h"

#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "tests/build.h"

using namespace stride::isolation;
using namespace std::chrono_literals;

namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

void allocate(std::size_t size) {
  if (size == 0) return;
  void* const block =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) std::abort();
  std::memset(block, 'x', size);
}

void start_child(std::size_t size) {
  if (::fork() != 0) return;
  allocate(size);
  for (;;) ::pause();
}

/// What a watch with a limit of 32 MiB finds within this time, in a process that has allocated some
/// itself and has two children [MiB].
std::string found(std::size_t own, std::size_t each, std::chrono::milliseconds time = 500ms) {
  const ChildOutcome outcome = run_in_child([&] {
    allocate(own * kMiB);
    MemoryWatch watch({32 * kMiB, {}});
    start_child(each * kMiB);
    start_child(each * kMiB);
    for (auto left = time; left > 0ms; left -= 10ms) {
      std::this_thread::sleep_for(10ms);
      if (const auto excess = watch.excess()) return std::to_string(*excess / kMiB);
    }
    return std::string("nothing");
  });
  return outcome.text;
}

}  // namespace

TEST_CASE("processes that are above a limit together are found, and none that are below it") {
  CHECK(found(0, 1) == "nothing");
  CHECK(found(64, 1) == "nothing");       // the watching process itself does not count
  if (stride::tests::kSanitized) return;  // a look takes so long that there is only one
  const std::string excess = found(0, 30, 20s);
  REQUIRE(excess != "nothing");
  CHECK(std::stoi(excess) > 32);
  CHECK(std::stoi(excess) <= 64);
}

TEST_CASE("without a limit nothing is measured, with one at most 100 times in a second") {
  MemoryWatch none({});
  CHECK(none.pause() == -1);
  CHECK_FALSE(none.excess());
  MemoryWatch watch({kMiB, {}});
  CHECK(watch.pause() == 0);
  const auto began = std::chrono::steady_clock::now();
  watch.excess();
  const auto took = std::chrono::steady_clock::now() - began;
  CHECK(watch.pause() >= 9);
  CHECK(watch.pause() <= 11 + 101 * took / 1ms);
}
