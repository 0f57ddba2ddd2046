#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/device.h>
#include <stride/systemc/idle.h>
#include <stride/systemc/time.h>
#include <stride/systemc/timer.h>
#include <stride/tangent.h>

#include "tests/units/systemc/meter.h"
#include "tests/units/systemc/times.h"

using meter::kPeriod;
using meter::Meter;
using stride::Duration;
using stride::Time;
using stride::systemc::Device;
using stride::systemc::IdleRules;
using stride::systemc::IdleSkipper;
using stride::systemc::Timer;

namespace {

using stride::tests::kMicrosecond;
using stride::tests::kMillisecond;
constexpr Duration kEver = Duration::max();

using stride::tests::at;

class MeterRules : public IdleRules {
 public:
  MeterRules(Device<Meter>& device, double tolerance) : device_(device), tolerance_(tolerance) {}
  bool idle() const override { return meter().sleeps(); }
  Duration clock_period() const override { return kPeriod; }
  Duration longest_skip() const override {
    if (meter().leakage_time() == 0) return kEver;
    return stride::tangent_holds_for(tolerance_, meter().current() / meter().leakage_time());
  }
  void on_skip(Duration skipped) override {
    meter().charge -= meter().current() * stride::to_seconds(skipped);
  }

 private:
  Meter& meter() const { return device_.module(); }
  Device<Meter>& device_;
  double tolerance_;
};

struct MeterBench {
  explicit MeterBench(double leakage_time = 0,
                      double tolerance = std::numeric_limits<double>::infinity())
      : device({}, "meter", leakage_time), rules(device, tolerance) {}

  void run(Time to, std::optional<Duration> max_skip) {
    if (max_skip) {
      skipper.advance(to, false, *max_skip);
    } else {
      device.advance(to);
    }
  }
  void request(bool wanted) {
    device.within([=](Meter& meter) { meter.request.write(wanted); });
  }
  Meter& meter() { return device.module(); }

  Device<Meter> device;
  MeterRules rules;
  IdleSkipper skipper{device.kernel(), rules};
};

/// Ten requests at seeded instants within 30 ms, in steps of any size.
void measure_now_and_then(MeterBench& bench, std::optional<Duration> max_skip, unsigned seed) {
  std::mt19937 random(seed);  // its sequence is part of the C++ standard
  Time now;
  for (int i = 0; i < 20; ++i) {
    const Time next = now + Duration(1 + random() % 3'000'000'000);
    while (now < next) {
      now = std::min(next, now + Duration(1 + random() % 1'000'000'000));
      bench.run(now, max_skip);
      REQUIRE(bench.device.now() == now);
    }
    bench.request(i % 2 == 0);
  }
  bench.run(now + kMillisecond, max_skip);
}

}  // namespace

TEST_CASE("a device with a clock of its own does the same with and without skipping") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    MeterBench full;
    measure_now_and_then(full, std::nullopt, seed);
    REQUIRE(full.meter().done.size() == 10);
    for (const Duration max_skip : {kEver, 300 * kMicrosecond}) {
      MeterBench skipping;
      measure_now_and_then(skipping, max_skip, seed);
      CAPTURE(seed, max_skip.count());
      CHECK(skipping.meter().done == full.meter().done);
      CHECK(skipping.meter().charge == Approx(full.meter().charge).epsilon(1e-9));
      CHECK(skipping.device.now() == full.device.now());

      const auto& edges = skipping.meter().edges;
      CHECK(std::is_sorted(edges.begin(), edges.end()));
      CHECK(std::includes(full.meter().edges.begin(), full.meter().edges.end(), edges.begin(),
                          edges.end()));
      CHECK(edges.size() < full.meter().edges.size() / 50);
      CHECK(skipping.skipper.statistics().longest <= max_skip);
      CHECK(skipping.skipper.statistics().skipped == skipping.device.kernel().skipped());
      CHECK(skipping.skipper.statistics().skipped % kPeriod == Duration{});
    }
  }
}

TEST_CASE("an input that is set when the device has just been skipped acts at its instant") {
  const Time pressed = at(7 * kMillisecond + Duration(123'457));
  std::vector<Time> done[2];
  for (const bool skips : {false, true}) {
    MeterBench bench;
    bench.run(pressed, skips ? std::optional(kEver) : std::nullopt);
    bench.request(true);
    bench.run(at(8 * kMillisecond), skips ? std::optional(kEver) : std::nullopt);
    done[skips ? 1 : 0] = bench.meter().done;
  }
  REQUIRE(done[0].size() == 1);
  CHECK(done[1] == done[0]);
}

TEST_CASE("a second of idle time takes a few clock periods") {
  MeterBench bench;
  bench.run(at(1000 * kMillisecond), kEver);
  CHECK(bench.meter().edges.size() <= 4);
  CHECK(bench.skipper.statistics().skips == 1);
  CHECK(bench.device.now() == at(1000 * kMillisecond));
}

TEST_CASE("what a device adds up along a bending curve stays within the tolerance of each skip") {
  const double leakage_time = 0.02;  // [s]
  const auto charge = [&](double tolerance, std::optional<Duration> max_skip, std::int64_t& skips) {
    MeterBench bench(leakage_time, tolerance);
    bench.run(at(10 * kMillisecond), max_skip);
    skips = bench.skipper.statistics().skips;
    return bench.meter().charge;
  };
  std::int64_t skips = 0;
  const double exact = charge(0, std::nullopt, skips);
  const double careless = charge(std::numeric_limits<double>::infinity(), kEver, skips);
  CHECK(skips == 1);
  CHECK(std::abs(careless - exact) > 0.1 * exact);  // the line is wrong on purpose

  double previous = std::abs(careless - exact);
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const double error = std::abs(charge(tolerance, kEver, skips) - exact);
    CAPTURE(tolerance, error, skips);
    CHECK(error <= tolerance * static_cast<double>(skips));
    CHECK(error < previous);
    previous = error;
  }
}

namespace {

/// Sleeps between the alarms of a timer, or of a wait(time). Has no clock.
class Sleeper : public sc_core::sc_module {
 public:
  Timer timer{"timer"};
  std::vector<Time> woken;

  Sleeper(sc_core::sc_module_name name, bool uses_timer) : sc_module(name) {
    SC_HAS_PROCESS(Sleeper);
    if (uses_timer) {
      SC_METHOD(on_timer);
      sensitive << timer.event();
    } else {
      SC_THREAD(sleep);
    }
  }

 private:
  void on_timer() {
    if (sc_core::sc_delta_count() > 0) woken.push_back(stride::systemc::current_time());
    timer.set_after(700 * kMicrosecond);
  }
  void sleep() {
    for (;;) {
      wait(700, sc_core::SC_US);
      woken.push_back(stride::systemc::current_time());
    }
  }
};

struct Unclocked : IdleRules {
  bool idle() const override { return true; }
  Duration clock_period() const override { return {}; }
  Duration longest_skip() const override { return kEver; }
  void on_skip(Duration) override {}
};

}  // namespace

TEST_CASE("a timer wakes a device at its instant, and so does what SystemC has to notify") {
  const std::vector<Time> expected = {at(700 * kMicrosecond), at(1400 * kMicrosecond),
                                      at(2100 * kMicrosecond), at(2800 * kMicrosecond)};
  for (const bool uses_timer : {true, false}) {
    Device<Sleeper> device({}, "sleeper", uses_timer);
    Unclocked rules;
    IdleSkipper skipper(device.kernel(), rules);
    for (const int end : {500, 1000, 1400, 3000})
      skipper.advance(at(end * kMicrosecond), false, kEver);
    CAPTURE(uses_timer);
    CHECK(device.module().woken == expected);
    // such a notification would be late, so its time is simulated, and the log can say why
    CHECK((device.kernel().skipped() > Duration{}) == uses_timer);
    CHECK(skipper.obstacle().has_value() == !uses_timer);
  }
}

namespace {

/// Asks for a communication point at each of these instants.
class Pauser : public sc_core::sc_module {
 public:
  Pauser(sc_core::sc_module_name name, std::vector<Time> when)
      : sc_module(name), when_(std::move(when)) {
    SC_HAS_PROCESS(Pauser);
    SC_METHOD(run);
    sensitive << timer_.event();
  }

 private:
  void run() {
    if (next_ > 0) sc_core::sc_pause();
    if (next_ < when_.size()) timer_.set(when_[next_++]);
  }
  Timer timer_{"timer"};
  std::vector<Time> when_;
  std::size_t next_ = 0;
};

struct Busy : Unclocked {
  bool idle() const override { return false; }
};

}  // namespace

TEST_CASE("no pause is overlooked, wherever the device is looked at") {
  // 1 ps and 10 us after a start or a pause are where a device is looked at
  const std::vector<Time> when = {at(Duration(1)),
                                  at(Duration(2)),
                                  at(10 * kMicrosecond),
                                  at(10 * kMicrosecond + Duration(2)),
                                  at(20 * kMicrosecond),
                                  at(30 * kMicrosecond),
                                  at(30 * kMicrosecond + Duration(1))};
  for (const bool is_idle : {false, true}) {
    Device<Pauser> device({}, "pauser", when);
    Unclocked idle;
    Busy busy;
    IdleSkipper skipper(device.kernel(), is_idle ? static_cast<IdleRules&>(idle) : busy);
    std::vector<Time> pauses;
    const Time end = at(50 * kMicrosecond);
    for (Time now; now < end;) {
      now = skipper.advance(end, true, kEver);
      if (now < end) pauses.push_back(now);
    }
    CHECK(pauses == when);
  }
}

TEST_CASE("what is too short to be worth a skip is simulated") {
  Device<Sleeper> device({}, "sleeper", true);
  Unclocked rules;
  IdleSkipper skipper(device.kernel(), rules);
  const auto skips_until = [&](Duration end, Duration max_skip) {
    const std::int64_t before = skipper.statistics().skips;
    skipper.advance(at(end), false, max_skip);
    return skipper.statistics().skips - before;
  };
  CHECK(skips_until(500 * kMicrosecond, Duration(1)) == 0);
  CHECK(skips_until(500 * kMicrosecond + Duration(500'000), kEver) == 0);
  CHECK(skips_until(600 * kMicrosecond, 20 * kMicrosecond) == 5);
}

TEST_CASE("a skip leaves something to be simulated on both sides") {
  Device<Sleeper> device({}, "sleeper", true);
  Unclocked rules;
  IdleSkipper skipper(device.kernel(), rules);
  skipper.advance(at(100 * kMicrosecond), false, kEver);
  // a picosecond before the skip, and one after it
  CHECK(device.kernel().skipped() == 100 * kMicrosecond - Duration(2));
  skipper.advance(at(100 * kMicrosecond + Duration(2)), false, kEver);
  CHECK(skipper.statistics().skips == 1);
}

namespace {

/// Waits beside a clock that goes on, and notes where the wait ended.
class Waiter : public sc_core::sc_module {
 public:
  std::vector<Time> woken;
  Waiter(sc_core::sc_module_name name, bool has_sc_clock) : sc_module(name) {
    if (has_sc_clock) {
      clock_ = std::make_unique<sc_core::sc_clock>("clock", 20, sc_core::SC_NS);
    } else {
      SC_HAS_PROCESS(Waiter);
      SC_METHOD(oscillate);
    }
    SC_HAS_PROCESS(Waiter);
    SC_THREAD(run);
  }

 private:
  void oscillate() { next_trigger(10, sc_core::SC_NS); }
  void run() {
    wait(130, sc_core::SC_US);
    woken.push_back(stride::systemc::current_time());
  }
  std::unique_ptr<sc_core::sc_clock> clock_;
};

struct Clocked : Unclocked {
  Duration clock_period() const override { return Duration(20'000); }
};

}  // namespace

TEST_CASE("a wait beside a clock that goes on is simulated, and what follows it is skipped") {
  const bool has_sc_clock = GENERATE(true, false);
  CAPTURE(has_sc_clock);
  Device<Waiter> device({}, "waiter", has_sc_clock);
  Clocked rules;
  IdleSkipper skipper(device.kernel(), rules);
  for (const int end : {50, 100, 500, 1000}) skipper.advance(at(end * kMicrosecond), false, kEver);
  CHECK(device.module().woken == std::vector<Time>{at(130 * kMicrosecond)});
  CHECK(skipper.obstacle() == at(130 * kMicrosecond));
  CHECK(device.kernel().skipped() > 700 * kMicrosecond);
}
