// A RAM on a bus of several drivers, as a unit beside its own sc_main.
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"

using stride::tests::driver_of;
using stride::tests::kNanosecond;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

/// Drives the bus while it is read, and lets go of it otherwise.
class Ram : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<bool> write_enable{"write_enable"}, output_enable{"output_enable"};
  sc_core::sc_in<sc_dt::sc_uint<4>> address{"address"};
  sc_core::sc_inout_rv<8> data{"data"};

  explicit Ram(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Ram);
    SC_METHOD(store);
    sensitive << clk.pos();
    dont_initialize();
    SC_METHOD(drive);
    sensitive << address << write_enable << output_enable << stored_;
  }

 private:
  void store() {
    if (!write_enable.read()) return;
    words_[address.read()] = data.read();
    stored_.notify(sc_core::SC_ZERO_TIME);
  }
  void drive() {
    const bool drives = output_enable.read() && !write_enable.read();
    data.write(drives ? words_[address.read()] : sc_dt::sc_lv<8>("ZZZZZZZZ"));
  }
  sc_dt::sc_lv<8> words_[16];
  sc_core::sc_event stored_{"stored"};
};

/// What is on the pins of the RAM for a cycle of 10 ns.
struct Cycle {
  bool write_enable, output_enable;
  unsigned address;
  const char* data;  ///< what the other driver writes
};
const std::vector<Cycle> kCycles{
    {false, true, 3, "ZZZZZZZZ"},                                 // nothing has been written
    {true, false, 3, "10100101"},                                 //
    {true, false, 4, "0000ZZZZ"},                                 // half of the bus is open
    {false, true, 3, "ZZZZZZZZ"},                                 //
    {false, true, 4, "ZZZZZZZZ"},                                 //
    {false, true, 3, "11ZZZZZZ"},                                 // both drive: 1 and X
    {true, true, 5, "11110000"},                                  // a write goes first
    {false, false, 5, "ZZZZZZZZ"}, {false, true, 5, "ZZZZ0000"},  // both drive the same
};

/// What is on the bus before the edge at the end of each cycle.
using Seen = std::vector<std::string>;

/// The RAM's own sc_main.
Seen bench() {
  sc_core::sc_clock clock("clk", 10, sc_core::SC_NS);
  sc_core::sc_signal<bool> write_enable("write_enable"), output_enable("output_enable");
  sc_core::sc_signal<sc_dt::sc_uint<4>> address("address");
  sc_core::sc_signal_rv<8> data("data");
  Ram ram("ram");
  ram.clk(clock);
  ram.write_enable(write_enable);
  ram.output_enable(output_enable);
  ram.address(address);
  ram.data(data);
  sc_core::sc_start(5, sc_core::SC_NS);
  Seen seen;
  for (const Cycle& cycle : kCycles) {
    write_enable.write(cycle.write_enable);
    output_enable.write(cycle.output_enable);
    address.write(cycle.address);
    data.write(cycle.data);
    sc_core::sc_start(10, sc_core::SC_NS);
    seen.push_back(data.read().to_string());
  }
  return seen;
}

void apply(const Cycle& cycle, UnitDriver& unit) {
  unit.value<bool>("write_enable") = cycle.write_enable;
  unit.value<bool>("output_enable") = cycle.output_enable;
  unit.value<std::uint8_t>("address") = static_cast<std::uint8_t>(cycle.address);
  unit.value<std::string>("data") = cycle.data;
}

UnitDriver ram() {
  return driver_of<Ram>([](Rows<Ram>& rows) {
    rows.clock(&Ram::clk, 10 * kNanosecond);
    rows.input("write_enable", &Ram::write_enable);
    rows.input("output_enable", &Ram::output_enable);
    rows.input("address", &Ram::address);
    rows.input("data", &Ram::data);
    rows.output("bus", &Ram::data);
  });
}

}  // namespace

TEST_CASE("a RAM with a resolved bus does what it does in its own sc_main") {
  const Seen expected = bench();
  CHECK(expected[3] == "10100101");
  CHECK(expected[5] == "1X100101");
  UnitDriver units[] = {ram(), ram()};
  Seen seen[2];
  for (UnitDriver& unit : units) {
    unit.initialize();
    unit.step(unit.now() + 5 * kNanosecond);
  }
  for (const Cycle& cycle : kCycles) {
    for (int i = 0; i < 2; ++i) {
      apply(cycle, units[i]);
      units[i].step(units[i].now() + 10 * kNanosecond);
      seen[i].push_back(units[i].value<std::string>("bus"));
    }
  }
  for (const Seen& one : seen) CHECK(one == expected);
}
