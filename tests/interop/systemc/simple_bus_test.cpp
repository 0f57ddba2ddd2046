// A bus with masters, memories and a clock of its own, all inside of one module.
#define sc_main design_main
#include "sysc/simple_bus/simple_bus_main.cpp"
#undef sc_main

#include <catch2/catch.hpp>

#include "tests/interop/systemc/network.h"

using stride::tests::Network;
using stride::tests::Rows;

TEST_CASE("the simple bus") {
  const std::string expected = stride::tests::printed([] { design_main(0, nullptr); });
  CHECK(expected.find("mem[") != std::string::npos);

  const auto make = [](Network& network) {
    network.add<simple_bus_test>([](Rows<simple_bus_test>& rows) {
      rows.construct_by([](const char*) { return std::make_unique<simple_bus_test>("top"); });
      rows.output("clock", stride::systemc::inner<bool>("C1"));
    });
  };
  const auto [first, second] =
      stride::tests::printed_by_two(make, 7 * stride::tests::kNanosecond, 1429);
  CHECK(first == second);
  CHECK(first.substr(0, expected.size()) == expected);
}
