#include "master/process/process_memory.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "master/process/child.h"

using namespace stride::process;

TEST_CASE("memory that was used counts, also when it is no longer there") {
  constexpr std::size_t kSize = std::size_t{64} << 20;
  const ChildOutcome outcome = run_in_child([&] {
    const std::uint64_t before = private_memory(::getpid());
    std::vector<char> block(kSize, 'x');
    const std::uint64_t with = private_memory(::getpid());
    block = std::vector<char>();
    const std::uint64_t after = private_memory(::getpid());
    std::string text;
    for (const bool holds : {before > 0, with >= before + kSize, after + kSize <= with,
                             most_memory(::getpid()) >= kSize}) {
      text += holds ? '1' : '0';
    }
    return text;
  });
  CHECK(outcome.text == "1111");
}

TEST_CASE("of a process that is not there nothing is said") {
  CHECK(most_memory(-1) == 0);
  CHECK(private_memory(-1) == 0);
}
