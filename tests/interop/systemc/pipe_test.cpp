// A pipeline of three stages of floating-point numbers, whose source keeps its state in globals.
#define sc_main design_main
#include "sysc/pipe/main.cpp"
#undef sc_main

#include <catch2/catch.hpp>

#include "tests/interop/systemc/network.h"

using stride::tests::kNanosecond;
using stride::tests::Network;
using stride::tests::Rows;
using stride::tests::UnitDriver;

TEST_CASE("the pipeline") {
  const std::string expected = stride::tests::printed_apart([] { design_main(0, nullptr); });
  CHECK(expected.find("Result = ") != std::string::npos);

  constexpr auto kPeriod = 20 * kNanosecond;
  const auto make = [&](Network& network) {
    UnitDriver& numbers = network.add<numgen>([&](Rows<numgen>& rows) {
      rows.clock(&numgen::clk, kPeriod);
      rows.output("in1", &numgen::out1);
      rows.output("in2", &numgen::out2);
    });
    UnitDriver& first = network.add<stage1>([&](Rows<stage1>& rows) {
      rows.clock(&stage1::clk, kPeriod);
      rows.input("in1", &stage1::in1);
      rows.input("in2", &stage1::in2);
      rows.output("sum", &stage1::sum);
      rows.output("diff", &stage1::diff);
    });
    UnitDriver& second = network.add<stage2>([&](Rows<stage2>& rows) {
      rows.clock(&stage2::clk, kPeriod);
      rows.input("sum", &stage2::sum);
      rows.input("diff", &stage2::diff);
      rows.output("prod", &stage2::prod);
      rows.output("quot", &stage2::quot);
    });
    UnitDriver& third = network.add<stage3>([&](Rows<stage3>& rows) {
      rows.clock(&stage3::clk, kPeriod);
      rows.input("prod", &stage3::prod);
      rows.input("quot", &stage3::quot);
      rows.output("powr", &stage3::powr);
    });
    UnitDriver& sink = network.add<display>([&](Rows<display>& rows) {
      rows.clock(&display::clk, kPeriod);
      rows.input("powr", &display::in);
    });
    for (const char* name : {"in1", "in2"}) network.connect<double>(numbers, name, first, name);
    for (const char* name : {"sum", "diff"}) network.connect<double>(first, name, second, name);
    for (const char* name : {"prod", "quot"}) network.connect<double>(second, name, third, name);
    network.connect<double>(third, "powr", sink, "powr");
  };
  const auto run = [&] {
    Network network;
    make(network);
    network.initialize();
    for (int i = 0; i < 49; ++i) network.step(kPeriod);  // the edges of 0 to 980 ns
  };
  for (int life = 0; life < 2; ++life) CHECK(stride::tests::printed_apart(run) == expected);
}
