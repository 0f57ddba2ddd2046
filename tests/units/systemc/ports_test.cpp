// Ports that are more than one signal in one direction.
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"

using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using stride::systemc::inner;
using stride::systemc::Logic;
using stride::tests::at;
using stride::tests::driver_of;
using stride::tests::kMicrosecond;
using stride::tests::kNanosecond;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

/// Writes 99 into its port after 1.5 us.
struct Latch : sc_core::sc_module {
  sc_core::sc_inout<int> value{"value"};
  explicit Latch(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Latch);
    SC_THREAD(run);
  }
  void run() {
    wait(1500, sc_core::SC_NS);
    value.write(99);
  }
};

/// Drives the bus with `drive` from 1 us on, and shows what is on it.
struct Driver : sc_core::sc_module {
  sc_core::sc_inout_resolved line{"line"};
  sc_core::sc_inout_rv<4> bus{"bus"};
  sc_core::sc_in_resolved enable{"enable"};
  sc_core::sc_out_rv<4> seen{"seen"};
  explicit Driver(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Driver);
    SC_THREAD(run);
    SC_METHOD(look);
    sensitive << bus;
  }
  void run() {
    line.write(sc_dt::SC_LOGIC_Z);
    bus.write("ZZZZ");
    wait(1, sc_core::SC_US);
    line.write(sc_dt::SC_LOGIC_1);
    bus.write("ZZ10");
  }
  void look() { seen.write(bus.read()); }
};

struct Serial : sc_core::sc_module {
  sc_core::sc_fifo_out<unsigned char> data{"data"};
  sc_core::sc_fifo_out<unsigned char> debug{"debug"};
  sc_core::sc_fifo_in<unsigned char> commands{"commands"};
  sc_core::sc_fifo_in<unsigned char> settings{"settings"};
  explicit Serial(sc_core::sc_module_name name) : sc_module(name) {}
};

struct LogicCounter : sc_core::sc_module {
  sc_core::sc_in<sc_dt::sc_logic> clk{"clk"}, reset{"reset"};
  sc_core::sc_out<int> count{"count"};
  explicit LogicCounter(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(LogicCounter);
    SC_METHOD(run);
    sensitive << clk.pos();
    dont_initialize();
  }
  void run() { count.write(reset.read() == '1' ? 0 : count.read() + 1); }
};

struct Bank : sc_core::sc_module {
  sc_core::sc_vector<sc_core::sc_in<int>> in{"in", 3};
  sc_core::sc_vector<sc_core::sc_out<int>> out{"out", 3};
  explicit Bank(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Bank);
    SC_METHOD(run);
    for (auto& port : in) sensitive << port;
  }
  void run() {
    for (std::size_t i = 0; i < in.size(); ++i) out[i].write(in[2 - i].read());
  }
};

/// An interface that only this design has.
struct Gauge : virtual sc_core::sc_interface {
  virtual int next() = 0;
};
struct Reader : sc_core::sc_module {
  sc_core::sc_port<Gauge> meter{"meter"};
  sc_core::sc_signal<int> sum{"sum"};
  sc_core::sc_export<sc_core::sc_signal_inout_if<int>> total{"total"};
  explicit Reader(sc_core::sc_module_name name) : sc_module(name) {
    total(sum);
    SC_HAS_PROCESS(Reader);
    SC_THREAD(run);
  }
  void run() {
    for (;; wait(1, sc_core::SC_US)) sum.write(sum.read() + meter->next());
  }
};
/// One that is made with each module, as a channel is.
struct Counter : sc_core::sc_prim_channel, Gauge {
  int count = 0;
  Counter() : sc_prim_channel("counter") {}
  int next() override { return ++count; }
};
/// One that is a part of the unit.
struct Constant : Gauge {
  int value = 5;
  int next() override { return value; }
};

struct Finisher : sc_core::sc_module {
  sc_core::sc_out<int> result{"result"};
  explicit Finisher(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Finisher);
    SC_THREAD(run);
  }
  void run() {
    wait(2500, sc_core::SC_NS);
    result.write(42);
    sc_core::sc_stop();
  }
};

template <class List>
std::string error_of(UnitDriver unit, List prepare) {
  try {
    prepare(unit);
    unit.initialize();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}
std::string error_of(UnitDriver unit) {
  return error_of(std::move(unit), [](UnitDriver&) {});
}

}  // namespace

TEST_CASE("several FIFOs of a module get no warning") {
  auto driver = driver_of<Serial>([](Rows<Serial>& rows) {
    rows.message_output("data.byte", &Serial::data);
    rows.message_output("debug.byte", &Serial::debug);
    rows.message_input("commands.byte", &Serial::commands);
    rows.message_input("settings.byte", &Serial::settings);
  });
  driver.initialize();
  driver.step(at(kMicrosecond));
  CHECK(driver.log.empty());
}

TEST_CASE("what a module writes into an sc_inout stays until the input changes") {
  const Duration step = GENERATE(as<Duration>(), kMicrosecond, 3 * kMicrosecond);
  UnitDriver unit = driver_of<Latch>([](Rows<Latch>& rows) {
    rows.input("value", &Latch::value);
    rows.output("value_out", &Latch::value);
  });
  unit.value<int>("value") = 5;
  unit.initialize();
  CHECK(unit.value<int>("value_out") == 5);
  while (unit.now() < at(6 * kMicrosecond)) unit.step(unit.now() + step);
  CHECK(unit.value<int>("value_out") == 99);
  unit.value<int>("value") = 6;
  unit.step(unit.now() + step);
  CHECK(unit.value<int>("value_out") == 6);
}

TEST_CASE("an sc_inout takes an input and an output, but no two of a kind") {
  CHECK_THAT(error_of(driver_of<Latch>([](Rows<Latch>& rows) {
               rows.input("a", &Latch::value);
               rows.input("b", &Latch::value);
             })),
             Contains("device.value has two rows, a and b"));
  CHECK_THAT(error_of(driver_of<Latch>([](Rows<Latch>& rows) {
               rows.tie(&Latch::value);
               rows.output("b", &Latch::value);
             })),
             Contains("device.value has two rows"));
  CHECK_THAT(error_of(driver_of<Finisher>(
                 [](Rows<Finisher>& r) { r.input("a", stride::systemc::inner<int>("result")); })),
             Contains("a: device.result is an sc_out") && Contains("output()"));
}

TEST_CASE("a resolved port has the unit as one more driver") {
  UnitDriver unit = driver_of<Driver>([](Rows<Driver>& rows) {
    rows.input("line", &Driver::line);
    rows.output("line_out", &Driver::line);
    rows.input("bus", &Driver::bus);
    rows.output("seen", &Driver::seen);
    rows.tie(&Driver::enable);
  });
  CHECK(unit.value<Logic>("line") == Logic::Z);
  CHECK(unit.value<std::string>("bus") == "ZZZZ");
  unit.value<std::string>("bus") = "01ZZ";
  unit.initialize();
  CHECK(unit.value<Logic>("line_out") == Logic::Z);
  CHECK(unit.value<std::string>("seen") == "01ZZ");
  unit.step(at(2 * kMicrosecond));
  CHECK(unit.value<Logic>("line_out") == Logic::k1);
  CHECK(unit.value<std::string>("seen") == "0110");
  unit.value<std::string>("bus") = "0101";
  unit.value<Logic>("line") = Logic::k0;
  unit.step(at(3 * kMicrosecond));
  CHECK(unit.value<Logic>("line_out") == Logic::X);
  CHECK(unit.value<std::string>("seen") == "01XX");
}

TEST_CASE("clocks and resets of sc_logic") {
  UnitDriver unit = driver_of<LogicCounter>([](Rows<LogicCounter>& rows) {
    rows.clock(&LogicCounter::clk, 10 * kNanosecond);
    rows.reset(&LogicCounter::reset, 25 * kNanosecond, true);
    rows.output("count", &LogicCounter::count);
  });
  unit.initialize();
  unit.step(at(29 * kNanosecond));
  CHECK(unit.value<int>("count") == 0);
  unit.step(at(60 * kNanosecond));
  CHECK(unit.value<int>("count") == 4);
}

TEST_CASE("a reset ends at its instant, however idle the module is meanwhile") {
  UnitDriver unit = driver_of<LogicCounter>([](Rows<LogicCounter>& rows) {
    rows.clock(&LogicCounter::clk, kMicrosecond);
    rows.reset(&LogicCounter::reset, 500 * kMicrosecond, true);
    rows.output("count", &LogicCounter::count);
    rows.idle_when([](const LogicCounter& counter) { return counter.reset.read() == '1'; },
                   stride::systemc::counts_nothing());
  });
  unit.enable_skipping();
  unit.initialize();
  unit.step(at(509 * kMicrosecond));
  CHECK(unit.value<int>("count") == 10);
  unit.unit().terminate();
  REQUIRE(unit.log.size() == 1);
  CHECK_THAT(unit.log[0].second, Contains("in 1 skips"));
}

TEST_CASE("a vector of ports is a vector of variables") {
  const auto list = [](std::size_t size) {
    return driver_of<Bank>([size](Rows<Bank>& rows) {
      for (auto& row : rows.inputs("in", &Bank::in, 3)) row.description("a word");
      rows.outputs("out", &Bank::out, size);
    });
  };
  UnitDriver unit = list(3);
  CHECK(unit.row("in[2]").description == "a word");
  unit.value<int>("in[0]") = 7;
  unit.initialize();
  CHECK(unit.value<int>("out[2]") == 7);
  CHECK_THAT(error_of(list(2)), Contains("device.out_2") && Contains("output()"));
  CHECK_THAT(error_of(list(4)), Contains("device.out[3] >= size() = 3"));
}

TEST_CASE("a port of any interface is bound to an adapter") {
  const auto with = [](auto bind) {
    return driver_of<Reader>([bind](Rows<Reader>& rows) {
      bind(rows);
      rows.output("sum", &Reader::total);
    });
  };
  UnitDriver made = with([](Rows<Reader>& rows) {
    rows.bind(&Reader::meter, [] { return std::make_unique<Counter>(); });
  });
  for (int life = 0; life < 2; ++life) {
    made.initialize();
    made.step(at(2500 * kNanosecond));
    CHECK(made.value<int>("sum") == 1 + 2 + 3);
  }
  Constant constant;
  UnitDriver kept = with([&](Rows<Reader>& rows) { rows.bind(&Reader::meter, constant); });
  kept.initialize();
  CHECK(kept.value<int>("sum") == 5);
  CHECK_THAT(error_of(with([](Rows<Reader>&) {})),
             Contains("device.meter") && Contains("bind(&Module::port, adapter)"));
}

TEST_CASE("a module that calls sc_stop ends the simulation, with its last values") {
  const bool may_return_early = GENERATE(true, false);
  UnitDriver unit =
      driver_of<Finisher>([](Rows<Finisher>& rows) { rows.output("result", &Finisher::result); });
  unit.initialize(at(kMicrosecond));
  unit.step(at(2 * kMicrosecond), may_return_early);
  CHECK_FALSE(unit.terminates());
  const Time end = may_return_early ? at(3500 * kNanosecond) : at(4 * kMicrosecond);
  CHECK(unit.step(at(4 * kMicrosecond), may_return_early) == end);
  CHECK(unit.terminates());
  CHECK(unit.value<int>("result") == 42);
  unit.initialize();
  CHECK(unit.value<int>("result") == 0);
}

TEST_CASE("a clocked unit prefers steps of its clock, unless it can be idle") {
  const auto list = [](Rows<LogicCounter>& rows) {
    rows.clock(&LogicCounter::clk, 10 * kNanosecond);
    rows.input("reset", &LogicCounter::reset);
    rows.output("count", &LogicCounter::count);
  };
  UnitDriver busy = driver_of<LogicCounter>(list);
  CHECK(busy.unit().info().default_step == 10 * kNanosecond);
  UnitDriver idle = driver_of<LogicCounter>([&](Rows<LogicCounter>& rows) {
    list(rows);
    rows.idle_when([](const LogicCounter&) { return false; }, stride::systemc::counts_nothing());
  });
  CHECK_FALSE(idle.unit().info().default_step.has_value());

  // the first value is there from the start
  const auto warnings_at = [&](Duration step, int changes) {
    UnitDriver unit = driver_of<LogicCounter>(list);
    unit.value<Logic>("reset") = Logic::k0;
    unit.initialize();
    unit.step(unit.now() + step);
    for (int i = 0; i < changes; ++i) {
      unit.value<Logic>("reset") = i % 2 == 0 ? Logic::k1 : Logic::k0;
      unit.step(unit.now() + step);
      unit.step(unit.now() + step);
    }
    unit.unit().terminate();
    return unit.log;
  };
  CHECK(warnings_at(10 * kNanosecond, 8).empty());
  CHECK(warnings_at(kMicrosecond, 2).empty());  // a button is pressed and released
  const auto log = warnings_at(kMicrosecond, 3);
  REQUIRE(log.size() == 1);
  CHECK_THAT(log[0].second, Contains("period of 1e-08 s") && Contains("--step 1e-08"));
}
