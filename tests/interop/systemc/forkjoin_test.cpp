// Threads that wait for threads, in a source that has its sc_main beside its module.
#define sc_main design_main
#include "sysc/2.1/forkjoin/forkjoin.cpp"
#undef sc_main

#include <catch2/catch.hpp>

#include "tests/interop/systemc/network.h"

using stride::tests::kNanosecond;
using stride::tests::Network;
using stride::tests::Rows;

TEST_CASE("forks and joins") {
  const std::string expected = stride::tests::printed([] { design_main(0, nullptr); });
  CHECK(expected.find("Done.") != std::string::npos);

  const auto make = [](Network& network) {
    network.add<top>([](Rows<top>& rows) {
      rows.output("name", [](const top& module) { return std::string(module.name()); });
    });
  };
  CHECK(stride::tests::printed_by_two(make, 10 * kNanosecond, 100) ==
        std::pair(expected, expected));
  // freed within SC_FORK and SC_JOIN
  const auto [first, second] = stride::tests::printed_by_two(make, 10 * kNanosecond, 15);
  CHECK(first == expected.substr(0, first.size()));
}
