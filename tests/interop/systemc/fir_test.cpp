// A FIR filter, its stimuli and its display, which calls sc_stop.
#define sc_main design_main
#include "sysc/fir/main.cpp"
#undef sc_main

#include <catch2/catch.hpp>

#include "tests/interop/systemc/network.h"

using stride::tests::kNanosecond;
using stride::tests::Network;
using stride::tests::Rows;
using stride::tests::UnitDriver;

TEST_CASE("the FIR filter") {
  const std::string expected =
      stride::tests::without_reports(stride::tests::printed([] { design_main(0, nullptr); }));
  CHECK(expected.find("Simulation of 24 items finished") != std::string::npos);

  const auto make = [](Network& network) {
    UnitDriver& source = network.add<stimulus>([](Rows<stimulus>& rows) {
      rows.clock(&stimulus::CLK, kNanosecond);
      rows.output("reset", &stimulus::reset);
      rows.output("input_valid", &stimulus::input_valid);
      rows.output("sample", &stimulus::sample);
    });
    UnitDriver& filter = network.add<fir>([](Rows<fir>& rows) {
      rows.clock(&fir::CLK, kNanosecond);
      rows.input("reset", &fir::reset);
      rows.input("input_valid", &fir::input_valid);
      rows.input("sample", &fir::sample);
      rows.output("output_data_ready", &fir::output_data_ready);
      rows.output("result", &fir::result);
    });
    UnitDriver& sink = network.add<display>([](Rows<display>& rows) {
      rows.input("result", &display::result);
      rows.input("output_data_ready", &display::output_data_ready);
    });
    for (const char* name : {"reset", "input_valid"})
      network.connect<bool>(source, name, filter, name);
    network.connect<int>(source, "sample", filter, "sample");
    network.connect<int>(filter, "result", sink, "result");
    network.connect<bool>(filter, "output_data_ready", sink, "output_data_ready");
  };
  const auto [first, second] = stride::tests::printed_by_two(make, kNanosecond, 1000);
  CHECK(first == expected);
  CHECK(second == expected);
}
