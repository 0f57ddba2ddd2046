#include "master/base/child_process/shared_memory.h"

#include <atomic>
#include <system_error>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "master/base/child_process/child.h"

using namespace stride::isolation;

TEST_CASE("shared memory is shared with children, unless it is hidden from them") {
  Shared<std::atomic<int>> number;
  CHECK(*number == 0);
  run_in_child([&] {
    *number = 5;
    return std::string();
  });
  CHECK(*number == 5);
  number.hide_from_children();
  CHECK(run_in_child([&] { return std::to_string(*number); }).end == ChildOutcome::End::Killed);
  CHECK(*number == 5);
}

TEST_CASE("memory that another process has enlarged is there to be seen") {
  GrowingMemory memory("test", 100);
  memory.data()[99] = std::byte{7};
  const std::size_t before = memory.size();
  CHECK(before >= 100);
  CHECK_FALSE(memory.follow(10 * before));
  run_in_child([&] {
    memory.grow(10 * before);
    memory.data()[10 * before - 1] = memory.data()[99];
    return std::string();
  });
  CHECK(memory.size() == before);
  REQUIRE(memory.follow(10 * before));
  CHECK(memory.data()[10 * before - 1] == std::byte{7});
  CHECK(memory.data()[99] == std::byte{7});
}

TEST_CASE("what there is no memory for is an error, and changes nothing") {
  GrowingMemory memory("test", 100);
  memory.data()[0] = std::byte{1};
  for (const int bits : {45, 63}) {  // which no machine has; it is not tried
    CHECK_THROWS_AS(memory.grow(std::size_t{1} << bits), std::system_error);
  }
  CHECK(memory.data()[0] == std::byte{1});
}

TEST_CASE("a file that only seems to be large is not seen") {
  GrowingMemory memory("test", 100);
  const std::size_t large = std::size_t{1} << 40;
  REQUIRE(::ftruncate(memory.file().number(), static_cast<off_t>(large)) == 0);
  CHECK_FALSE(memory.follow(large));
  CHECK_FALSE(memory.follow(memory.size() + 1));
  CHECK(::ftruncate(memory.file().number(), 0) != 0);
}
