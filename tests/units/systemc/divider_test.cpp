// Modules that count the edges of their clock, and so of those that are skipped.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/module_unit.h>
#include <stride/systemc/time.h>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"

using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using stride::systemc::counts_nothing;
using stride::systemc::repeats_every;
using stride::systemc::Skipped;
using stride::tests::at;
using stride::tests::driver_of;
using stride::tests::kMicrosecond;
using stride::tests::kMillisecond;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

constexpr Duration kClock = kMicrosecond;

/// Divides its clock by 100, and samples its input at each hundredth edge: an alert begins where it
/// finds the level too high.
class Monitor : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<int> level{"level"};
  sc_core::sc_out<bool> alert{"alert"};
  std::vector<Time> alerts;
  int edges = 0;

  explicit Monitor(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Monitor);
    SC_METHOD(divide);
    sensitive << clk.pos();
    dont_initialize();
  }
  bool is_quiet() const { return level.read() <= 5 && !alert.read(); }

 private:
  void divide() {
    if (++edges < 100) return;
    edges = 0;
    const bool is_high = level.read() > 5;
    if (is_high && !alert.read()) alerts.push_back(stride::systemc::current_time());
    alert.write(is_high);
  }
};

/// The same with a divider that is not a member, and counts in a signal.
class Tower : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<int> level{"level"};
  sc_core::sc_out<bool> alert{"alert"};
  std::vector<Time> alerts;

  explicit Tower(sc_core::sc_module_name name)
      : sc_module(name), edges_(std::make_unique<sc_core::sc_signal<int>>("edges")) {
    SC_HAS_PROCESS(Tower);
    SC_METHOD(divide);
    sensitive << clk.pos();
    dont_initialize();
  }
  bool is_quiet() const { return level.read() <= 5 && !alert.read(); }

 private:
  void divide() {
    edges_->write((edges_->read() + 1) % 100);
    if (edges_->read() != 99) return;
    const bool is_high = level.read() > 5;
    if (is_high && !alert.read()) alerts.push_back(stride::systemc::current_time());
    alert.write(is_high);
  }
  std::unique_ptr<sc_core::sc_signal<int>> edges_;
};

struct Run {
  std::vector<Time> alerts;
  Time promise;  ///< in the first quiet time
  std::vector<std::pair<stride::Severity, std::string>> log;
};

/// Levels that change at instants beside the edges, and are high for longer or shorter times.
template <class Module, class Edges>
Run run(Edges edges, bool skips) {
  Run run;
  UnitDriver unit = driver_of<Module>([&](Rows<Module>& rows) {
    rows.clock(&Module::clk, kClock);
    rows.input("level", &Module::level);
    rows.output("alert", &Module::alert);
    rows.output("alerts", [&run](const Module& module) {
      run.alerts = module.alerts;
      return static_cast<int>(module.alerts.size());
    });
    rows.idle_when(&Module::is_quiet, edges);
  });
  if (skips) unit.enable_skipping();
  unit.initialize();
  const auto hold = [&](int level, Duration length) {
    unit.value<int>("level") = level;
    unit.step(unit.now() + length);
  };
  hold(0, 7'654'321 * Duration(1000));
  run.promise = unit.idle_until();
  hold(9, 2 * kMillisecond + Duration(777));
  hold(0, 13 * kMillisecond + Duration(37'000'001));
  hold(9, 30 * kMicrosecond);
  hold(0, kMillisecond);
  hold(8, 150 * kMicrosecond);
  hold(0, 20 * kMillisecond);
  unit.unit().terminate();
  run.log = unit.log;
  return run;
}

bool has_skipped(const Run& run) {
  return !run.log.empty() && run.log[0].second.find(" in 0 skips") == std::string::npos;
}

}  // namespace

TEST_CASE("a divider that is told of skipped edges alerts at the same instants") {
  const Run full = run<Monitor>(counts_nothing(), false);
  REQUIRE(full.alerts.size() == 3);
  CHECK(full.alerts[0] == at(7'699 * kMicrosecond));

  const Run repeating = run<Monitor>(repeats_every(100 * kClock), true);
  CHECK(repeating.alerts == full.alerts);
  CHECK(has_skipped(repeating));
  CHECK(repeating.log.size() == 1);

  const Run counting = run<Monitor>(
      [](Monitor& monitor, const Skipped& skipped) {
        CHECK(skipped.time == skipped.cycles * kClock);
        monitor.edges = static_cast<int>((monitor.edges + skipped.cycles) % 100);
      },
      true);
  CHECK(counting.alerts == full.alerts);
  CHECK(has_skipped(counting));
  CHECK(counting.log.size() == 1);
}

TEMPLATE_TEST_CASE("a divider that is declared wrongly is simulated, with a warning", "", Monitor,
                   Tower) {
  const Run full = run<TestType>(counts_nothing(), false);
  REQUIRE(full.alerts.size() == 3);
  const Run none = run<TestType>(counts_nothing(), true);
  const Run wrong = run<TestType>(repeats_every(30 * kClock), true);
  for (const Run* run : {&none, &wrong}) {
    CHECK(run->alerts == full.alerts);
    CHECK_FALSE(has_skipped(*run));
    CHECK(run->promise == at(7'654'321 * Duration(1000)));
    REQUIRE(run->log.size() == 2);
    CHECK_THAT(run->log[1].second, Contains("repeats_every()"));
  }
  CHECK_THAT(none.log[1].second,
             Contains(std::is_same_v<TestType, Monitor> ? "in or behind device.alert"
                                                        : "in or behind device.edges"));
  CHECK(run<TestType>(repeats_every(100 * kClock), true).alerts == full.alerts);
}

namespace {

/// What comes and goes in each period: a buffered clock, an event, an inner clock; and what settles
/// within some cycles.
class Calm : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<int> in{"in"};
  sc_core::sc_out<int> out{"out"};

  explicit Calm(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Calm);
    SC_METHOD(buffer);
    sensitive << clk;
    SC_METHOD(shift);
    sensitive << buffered_.posedge_event() << inner_.posedge_event() << tick_;
    dont_initialize();
  }

 private:
  void buffer() {
    buffered_.write(clk.read());
    outer_->write(clk.read());
    tick_.notify(sc_core::SC_ZERO_TIME);
  }
  void shift() {
    out.write(stages_[3]);
    for (int i = 3; i > 0; --i) stages_[i] = stages_[i - 1];
    stages_[0] = in.read();
  }
  sc_core::sc_signal<bool> buffered_{"buffered"};
  sc_core::sc_clock inner_{"inner", 1, sc_core::SC_US};
  sc_core::sc_event tick_{"tick"};
  std::unique_ptr<sc_core::sc_signal<bool>> outer_{new sc_core::sc_signal<bool>("outer")};
  int stages_[4] = {};
};

}  // namespace

TEST_CASE("a module that is what it was after each period is skipped") {
  UnitDriver unit = driver_of<Calm>([](Rows<Calm>& rows) {
    rows.clock(&Calm::clk, kClock);
    rows.input("in", &Calm::in);
    rows.output("out", &Calm::out);
    rows.idle_when([](const Calm&) { return true; }, counts_nothing());
  });
  unit.enable_skipping();
  unit.initialize();
  for (int i = 1; i <= 10; ++i) {
    unit.value<int>("in") = i;
    unit.step(at(i * kMillisecond));
    CHECK(unit.value<int>("out") == i);
    CHECK(unit.idle_until() == Time::max());
  }
  unit.unit().terminate();
  REQUIRE(unit.log.size() == 1);
  CHECK_THAT(unit.log[0].second, Contains("in 10 skips"));
}

TEST_CASE("a promise needs a period that has left the module as it was") {
  const auto promise_after = [](auto edges, Duration length) {
    UnitDriver unit = driver_of<Monitor>([&](Rows<Monitor>& rows) {
      rows.clock(&Monitor::clk, kClock);
      rows.input("level", &Monitor::level);
      rows.output("alert", &Monitor::alert);
      rows.idle_when(&Monitor::is_quiet, edges);
    });
    unit.enable_skipping();
    unit.initialize();
    unit.step(at(length));
    return unit.idle_until();
  };
  for (const Duration length : {kClock, 3 * kClock / 2, 2 * kClock, 10 * kClock, 99 * kClock}) {
    CAPTURE(length.count());
    CHECK(promise_after(counts_nothing(), length) == at(length));
    CHECK(promise_after(repeats_every(100 * kClock), length) == at(length));
  }
  for (const Duration length : {100 * kClock, 101 * kClock, 250 * kClock}) {
    CAPTURE(length.count());
    CHECK(promise_after(counts_nothing(), length) == at(length));
    CHECK(promise_after(repeats_every(100 * kClock), length) == Time::max());
  }
}

TEST_CASE("the place of a change in a signal of the unit is the port that is bound to it") {
  struct Counter : sc_core::sc_module {
    sc_core::sc_in<bool> clk{"clk"};
    sc_core::sc_out<int> count{"count"};
    explicit Counter(sc_core::sc_module_name name) : sc_module(name) {
      SC_HAS_PROCESS(Counter);
      SC_METHOD(run);
      sensitive << clk.pos();
      dont_initialize();
    }
    void run() { count.write(++*edges); }
    std::unique_ptr<int> edges = std::make_unique<int>();
  };
  UnitDriver unit = driver_of<Counter>([](Rows<Counter>& rows) {
    rows.clock(&Counter::clk, kClock);
    rows.output("count", &Counter::count);
    rows.idle_when([](const Counter&) { return true; }, counts_nothing());
  });
  unit.enable_skipping();
  unit.initialize();
  unit.step(at(kMillisecond));
  unit.unit().terminate();
  CHECK(unit.value<int>("count") == 1001);
  REQUIRE(unit.log.size() == 2);
  CHECK_THAT(unit.log[1].second, Contains("in or behind device.count;"));
}

namespace {

/// Barks when it has not been kicked for 5000 edges of its clock.
class Watchdog : public sc_core::sc_module {
 public:
  static constexpr int kLimit = 5000;
  sc_core::sc_in<bool> clk{"clk"}, kick{"kick"};
  sc_core::sc_out<bool> bark{"bark"};
  std::vector<Time> barks;
  int edges = 0;

  explicit Watchdog(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Watchdog);
    SC_METHOD(count);
    sensitive << clk.pos();
    dont_initialize();
  }
  bool is_quiet() const { return kick.read() == kicked_; }

 private:
  void count() {
    edges = kick.read() == kicked_ ? std::min(edges + 1, kLimit) : 0;
    kicked_ = kick.read();
    if (edges == kLimit && !bark.read()) barks.push_back(stride::systemc::current_time());
    bark.write(edges == kLimit);
  }
  bool kicked_ = false;
};

class WatchdogUnit : public stride::systemc::ModuleUnit<Watchdog> {
 public:
  WatchdogUnit() : ModuleUnit("watchdog", "A counter with a limit") {
    clock(&Watchdog::clk, kClock);
    input("kick", &Watchdog::kick);
    output("bark", &Watchdog::bark);
    output("barks", [this](const Watchdog& dog) {
      barks = dog.barks;
      return static_cast<int>(dog.barks.size());
    });
    idle_when(&Watchdog::is_quiet, [](Watchdog& dog, const Skipped& skipped) {
      if (dog.edges < Watchdog::kLimit) dog.edges += static_cast<int>(skipped.cycles);
    });
  }
  std::vector<Time> barks;

 protected:
  Duration longest_skip(const Watchdog& dog) const override { return until_limit(dog); }
  Duration tangents_hold_for(const Watchdog& dog) const override { return until_limit(dog); }

 private:
  static Duration until_limit(const Watchdog& dog) {
    if (dog.edges == Watchdog::kLimit) return Duration::max();
    return (Watchdog::kLimit - 1 - dog.edges) * kClock;
  }
};

std::vector<std::int64_t> barks(bool skips, Duration length) {
  auto unit = std::make_unique<WatchdogUnit>();
  WatchdogUnit& watchdog = *unit;
  UnitDriver driver(std::move(unit));
  if (skips) driver.enable_skipping();
  driver.initialize();
  for (const Time end : {at(7 * kMillisecond + Duration(123)), at(30 * kMillisecond)}) {
    while (driver.now() < end) {
      const Time promised = skips ? driver.idle_until() : driver.now();
      driver.step(std::min(end, std::max(driver.now() + length, promised)));
    }
    driver.value<bool>("kick") = true;
  }
  std::vector<std::int64_t> barks;
  for (const Time bark : watchdog.barks) barks.push_back(bark.time_since_epoch() / kMicrosecond);
  return barks;
}

}  // namespace

TEST_CASE("a counter with a limit is skipped up to the limit") {
  for (const Duration length : {100 * kMicrosecond, 900 * kMicrosecond, 7 * kMillisecond}) {
    CAPTURE(length.count());
    const std::vector<std::int64_t> expected = barks(false, length);
    CHECK(expected.size() == 2);
    CHECK(barks(true, length) == expected);
  }
}
