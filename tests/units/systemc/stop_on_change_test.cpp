// Outputs whose changes end a step.
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"

using Catch::Matchers::Contains;
using stride::Time;
using stride::systemc::counts_nothing;
using stride::systemc::inner;
using stride::tests::at;
using stride::tests::driver_of;
using stride::tests::kMicrosecond;
using stride::tests::kNanosecond;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

/// An interrupt from 2.5 us to 3.5 us, which a mask that is true keeps away.
struct Interrupter : sc_core::sc_module {
  sc_core::sc_in<bool> mask{"mask"};
  sc_core::sc_out<bool> irq{"irq"};
  explicit Interrupter(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Interrupter);
    SC_THREAD(run);
    SC_METHOD(put_out);
    sensitive << mask << pending_;
  }

 private:
  void run() {
    wait(2500, sc_core::SC_NS);
    pending_.write(true);
    wait(1, sc_core::SC_US);
    pending_.write(false);
  }
  void put_out() { irq.write(pending_.read() && !mask.read()); }

  sc_core::sc_signal<bool> pending_{"pending"};
};

const Time kRise = at(2500 * kNanosecond);
const Time kFall = at(3500 * kNanosecond);

UnitDriver stopping() {
  return driver_of<Interrupter>([](Rows<Interrupter>& rows) {
    rows.input("mask", &Interrupter::mask);
    rows.output("irq", &Interrupter::irq).stop_on_change().description("the interrupt");
  });
}

/// The instants at which steps of 2 us end, up to 6 us.
std::vector<Time> ends_of_steps(UnitDriver& unit, bool may_return_early) {
  std::vector<Time> ends;
  unit.initialize();
  while (unit.now() < at(6 * kMicrosecond)) {
    ends.push_back(unit.step(unit.now() + 2 * kMicrosecond, may_return_early));
  }
  return ends;
}

}  // namespace

TEST_CASE("a step ends where an output changes that stops it") {
  UnitDriver unit = stopping();
  CHECK(ends_of_steps(unit, true) == std::vector<Time>{at(2 * kMicrosecond), kRise, kFall,
                                                       kFall + 2 * kMicrosecond,
                                                       kFall + 4 * kMicrosecond});
}

TEST_CASE("the value that it has changed to is there") {
  UnitDriver unit = stopping();
  unit.initialize();
  CHECK_FALSE(unit.value<bool>("irq"));
  REQUIRE(unit.step(at(10 * kMicrosecond), true) == kRise);
  CHECK(unit.value<bool>("irq"));
  REQUIRE(unit.step(at(10 * kMicrosecond), true) == kFall);
  CHECK_FALSE(unit.value<bool>("irq"));
  CHECK(unit.step(at(10 * kMicrosecond), true) == at(10 * kMicrosecond));
}

TEST_CASE("a change that an input causes without a delay ends the step where it begins") {
  UnitDriver unit = stopping();
  unit.initialize();
  REQUIRE(unit.step(at(10 * kMicrosecond), true) == kRise);
  CHECK_FALSE(unit.needs_event());
  unit.value<bool>("mask") = true;
  CHECK(unit.step(at(10 * kMicrosecond), true) == kRise);
  CHECK(unit.needs_event());
  CHECK_FALSE(unit.value<bool>("irq"));
  CHECK(unit.step(at(10 * kMicrosecond), true) == at(10 * kMicrosecond));
}

TEST_CASE("without the permission to return early the change is seen at the end of the step") {
  UnitDriver unit = stopping();
  CHECK(ends_of_steps(unit, false) ==
        std::vector<Time>{at(2 * kMicrosecond), at(4 * kMicrosecond), at(6 * kMicrosecond)});
}

TEST_CASE("other outputs do not end a step, inner signals may") {
  const bool stops = GENERATE(false, true);
  UnitDriver unit = driver_of<Interrupter>([stops](Rows<Interrupter>& rows) {
    rows.input("mask", &Interrupter::mask);
    rows.output("irq", &Interrupter::irq);
    auto pending = rows.output("pending", inner<bool>("pending"));
    if (stops) pending.stop_on_change();
  });
  unit.initialize();
  CHECK(unit.step(at(10 * kMicrosecond), true) == (stops ? kRise : at(10 * kMicrosecond)));
}

TEST_CASE("a change ends a step of a device that skips its idle time, too") {
  UnitDriver unit = driver_of<Interrupter>([](Rows<Interrupter>& rows) {
    rows.input("mask", &Interrupter::mask);
    rows.output("irq", &Interrupter::irq).stop_on_change();
    rows.idle_when([](const Interrupter& module) { return !module.irq.read(); }, counts_nothing());
  });
  unit.enable_skipping();
  unit.initialize();
  CHECK(unit.step(at(10 * kMicrosecond), true) == kRise);
}

TEST_CASE("a function has no event that tells of a change") {
  const auto list = [](Rows<Interrupter>& rows) {
    rows.output("high", [](const Interrupter& module) { return module.irq.read(); })
        .stop_on_change();
  };
  CHECK_THROWS_WITH(driver_of<Interrupter>(list),
                    Contains("high: stop_on_change() needs a port or a signal"));
}
