// A device as a unit: its idle times, its promises and its traces.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <unistd.h>

#include <stride/systemc/unit.h>

#include "tests/units/systemc/meter.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"
#include "tests/units/systemc/vcd.h"

using Catch::Matchers::Contains;
using meter::Meter;
using stride::Duration;
using stride::Time;
using stride::tests::read_vcd;
using stride::tests::UnitDriver;
using stride::tests::Vcd;

namespace fs = std::filesystem;

namespace {

using stride::tests::at;
using stride::tests::kMicrosecond;
using stride::tests::kMillisecond;

/// A device of somebody else's, wrapped: all that is said of idle times is in the last four
/// functions.
class MeterUnit : public stride::systemc::DeviceUnit<Meter> {
 public:
  MeterUnit() : DeviceUnit("A meter") {
    may_idle();
    input("request", request_);
    output("measurements", measurements_);
    output("charge", charge_).unit("C").derivative(rate_).tolerance(1e-12);
  }

 private:
  std::unique_ptr<Device> make_device(Log log) override {
    return std::make_unique<Device>(std::move(log), "meter");
  }
  void write_inputs(Meter& meter) override { meter.request.write(request_); }
  void read_outputs(Meter& meter) override {
    measurements_ = meter.measurements.read();
    charge_ = meter.charge;
    rate_ = -meter.current();
  }

 protected:
  bool idle(const Meter& meter) const override { return meter.sleeps(); }

 private:
  Duration clock_period(const Meter&) const override { return meter::kPeriod; }
  void on_skip(Meter& meter, Duration skipped) override {
    meter.charge -= meter.current() * stride::to_seconds(skipped);
  }
  // the charge moves in steps of a cycle, 0.04 pC, around its tangent
  Duration tangents_hold_for(const Meter&) const override { return Duration::max(); }

  bool request_ = false;
  std::int32_t measurements_ = 0;
  double charge_ = 0;
  double rate_ = 0;
};

struct MeterDriver : UnitDriver {
  MeterDriver() : UnitDriver(std::make_unique<MeterUnit>()) {}
  explicit MeterDriver(Duration max_skip) : MeterDriver() { enable_skipping(max_skip); }
  std::int32_t measurements() { return value<std::int32_t>("measurements"); }
  double charge() { return value<double>("charge"); }
};

struct UnitFolder {
  fs::path path = fs::temp_directory_path() / ("stride_unit_" + std::to_string(getpid()));
  UnitFolder() { fs::create_directory(path); }
  ~UnitFolder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

}  // namespace

TEST_CASE("a unit with skipping gives the values of one without") {
  MeterDriver full;
  MeterDriver skipping(Duration::max());
  MeterDriver cautious(kMillisecond);
  std::mt19937 random(7);  // its sequence is part of the C++ standard
  for (MeterDriver* unit : {&full, &skipping, &cautious}) unit->initialize(at(kMillisecond));
  for (int i = 0; i < 40; ++i) {
    const bool request = random() % 3 == 0;
    const Time to = full.now() + Duration(1 + random() % 3'000'000'000);
    for (MeterDriver* unit : {&full, &skipping, &cautious}) {
      unit->value<bool>("request") = request;
      CHECK(unit->step(to) == to);
    }
    CAPTURE(i, request);
    CHECK(skipping.measurements() == full.measurements());
    CHECK(cautious.measurements() == full.measurements());
    CHECK(skipping.charge() == Approx(full.charge()).epsilon(1e-9));
    CHECK(cautious.charge() == Approx(full.charge()).epsilon(1e-9));
  }
  CHECK(full.measurements() > 5);
}

TEST_CASE("a promise holds while the device sleeps, and is paid by one step") {
  MeterDriver promising(Duration::max());
  MeterDriver finely;
  promising.initialize();
  finely.initialize();
  for (MeterDriver* unit : {&promising, &finely}) unit->step(at(100 * kMicrosecond));
  CHECK(promising.idle_until() == Time::max());
  const double charge = promising.charge();
  const double rate =
      promising.value<double>("charge") == 0 ? 0 : *promising.row("charge").derivative;
  for (Time now = finely.now(); now < at(5 * kMillisecond);) {
    now += Duration(777'777'777);
    finely.step(now);
    const double expected = charge + rate * stride::to_seconds(now - at(100 * kMicrosecond));
    CHECK(std::abs(finely.charge() - expected) < 1e-12);
  }
  CHECK(promising.step(finely.now()) == finely.now());
  CHECK(std::abs(promising.charge() - finely.charge()) < 1e-12);
}

TEST_CASE("nothing is promised while the device works, or has an input to take up") {
  MeterDriver unit(Duration::max());
  unit.initialize();
  unit.step(at(100 * kMicrosecond));
  REQUIRE(unit.idle_until() > unit.now());
  unit.value<bool>("request") = true;
  CHECK(unit.idle_until() == unit.now());
  unit.step(at(102 * kMicrosecond));
  CHECK(unit.idle_until() == unit.now());
  unit.step(at(110 * kMicrosecond));
  CHECK(unit.measurements() == 1);
  CHECK(unit.idle_until() > unit.now());
}

TEST_CASE("what a clock's edge has to sample is neither skipped nor promised away") {
  /// Does not look at its input.
  struct Careless : MeterUnit {
    bool idle(const Meter& meter) const override { return !meter.busy.read(); }
  };
  UnitDriver unit(std::make_unique<Careless>());
  unit.enable_skipping();
  unit.initialize();
  CHECK(unit.idle_until() == unit.now());
  unit.step(at(kMillisecond + Duration(15'000)));
  CHECK(unit.idle_until() > unit.now());

  unit.value<bool>("request") = true;
  unit.step(unit.now() + Duration(2'000));  // the edge is 3 ns later
  CHECK(unit.idle_until() == unit.now());
  unit.step(unit.now() + kMillisecond);
  CHECK(unit.value<std::int32_t>("measurements") == 1);
  unit.event();
  CHECK(unit.idle_until() == unit.now());
}

TEST_CASE("the skipped time is logged at the end") {
  MeterDriver unit(2 * kMillisecond);
  unit.initialize();
  unit.step(at(10 * kMillisecond));
  unit.unit().terminate();
  REQUIRE(unit.log.size() == 1);
  CHECK_THAT(unit.log[0].second, Contains("in 5 skips, the longest of 0.002 s") ||
                                     Contains("in 5 skips, the longest of 0.00199998 s"));
  MeterDriver plain;
  plain.initialize();
  plain.step(at(10 * kMillisecond));
  plain.unit().terminate();
  CHECK(plain.log.empty());
}

TEST_CASE("each device can be traced, from its parameters") {
  const UnitFolder folder;
  const auto run = [&](std::optional<Duration> max_skip, const char* name) {
    MeterDriver unit;
    if (max_skip) unit.enable_skipping(*max_skip);
    unit.value<std::string>("trace.file") = folder / name;
    unit.value<std::string>("trace.signals") = "busy measurements";
    unit.initialize();
    unit.initialize();  // as an importer may, and the file begins anew
    for (int i = 1; i <= 10; ++i) {
      unit.value<bool>("request") = i % 2 == 1;
      unit.step(at(i * kMillisecond + i * Duration(1234)));
    }
    unit.unit().terminate();
    return read_vcd(folder / name);
  };
  const Vcd full = run(std::nullopt, "full.vcd");
  const Vcd skipping = run(Duration::max(), "skipping.vcd");
  CHECK(full.signals.size() == 3);
  CHECK(full.of("meter.measurements").size() == 6);
  CHECK(full.of("meter.busy").size() == 11);
  CHECK(skipping.of("meter.measurements") == full.of("meter.measurements"));
  CHECK(skipping.of("meter.busy") == full.of("meter.busy"));
  CHECK(skipping.last_stamp < full.last_stamp / 100);
}

TEST_CASE("a trace that cannot be made is an error at initialization") {
  const UnitFolder folder;
  MeterDriver unit;
  unit.value<std::string>("trace.file") = folder / "missing/x.vcd";
  CHECK_THROWS_WITH(unit.initialize(), Contains("trace.file"));
  unit.value<std::string>("trace.file") = folder / "x.vcd";
  unit.value<std::string>("trace.signals") = "nothing";
  CHECK_THROWS_WITH(unit.initialize(), Contains("trace.signals") && Contains("measurements"));
  unit.value<std::string>("trace.signals") = "*";
  CHECK_NOTHROW(unit.initialize());
}

TEST_CASE("a trace is among the run's results, if the importer gives their folder") {
  const UnitFolder folder;
  MeterDriver unit;
  unit.unit().set_results(folder.path);
  unit.value<std::string>("trace.file") = "meter";
  unit.initialize();
  CHECK(fs::exists(folder.path / "meter.vcd"));
}

TEST_CASE("a trace is off unless a file is named, and closed with the unit") {
  const UnitFolder folder;
  {
    MeterDriver unit;
    unit.initialize();
    unit.step(at(kMicrosecond));
  }
  CHECK(fs::is_empty(folder.path));
  {
    MeterDriver unit;
    unit.value<std::string>("trace.file") = folder / "meter.vcd";
    unit.initialize();
    unit.step(at(kMicrosecond));
    unit.value<bool>("request") = true;
    unit.step(at(2 * kMicrosecond));
  }
  CHECK(read_vcd(folder / "meter.vcd").of("meter.request").size() == 2);
}
