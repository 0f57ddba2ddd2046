// FMI 2.0 units, alone and beside those of FMI 3.0: what they do does not hang on how the run is
// cut into steps, and a step that one of them discards is redone by all.
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "master/base/time_text.h"
#include "tests/property/assembly.h"
#include "tests/test_units/counted_random.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const std::uint64_t kTrials = kSanitized ? 20 : 200;

/// Drives an FMI 2.0 relaxation by hand.
class Relaxation {
 public:
  Relaxation(double k, double u) : unit_(fmu()->instantiate("relaxation")) {
    set("k", k);
    set("u", u);
    unit_->enter_initialization(Time{}, std::nullopt);
    unit_->exit_initialization();
  }
  void step_to(Time to) {
    REQUIRE(unit_->step({now_, to}).reached_without_request(to));
    now_ = to;
  }
  double x() {
    core::ValueBlock value(core::ValueType::Float64, 1);
    unit_->get({&reference("x"), 1}, value);
    return value.numbers<double>()[0];
  }

 private:
  static std::shared_ptr<importer::Fmu> fmu() { return test_unit("fmi2_relaxation"); }
  static const core::ValueReference& reference(const std::string& name) {
    const auto& description = *fmu()->description();
    return description.variables[description.find(name).value()].reference;
  }
  void set(const std::string& name, double number) {
    core::ValueBlock value(core::ValueType::Float64, 1);
    value.numbers<double>()[0] = number;
    unit_->set({&reference(name), 1}, value);
  }

  std::unique_ptr<core::Unit> unit_;
  Time now_{};
};

/// The time of a turner that turns at this instant [s].
double turned(Time time, double turn) {
  const double seconds = to_seconds(time);
  return seconds <= turn ? seconds : 2 * turn - seconds;
}

/// A picosecond count as the seconds that a scenario has.
std::string seconds_text(Time time) { return core::to_text(time); }

Time random_instant(std::uint64_t seed, std::uint64_t& count) {
  return Time(Duration(1 + static_cast<std::int64_t>(0.4e12 * random_uniform(seed, count++))));
}

std::set<Time> instants(const Results& results) {
  std::set<Time> times;
  for (const auto& [time, values] : results.values) times.insert(time);
  return times;
}

/// The integral from 0 to 1 s of exp(-2 t), by a unit that knows derivatives of its input, from one
/// that is exact: the error.
double integration_error(core::Extrapolation extrapolation, Duration step) {
  Assembly system;
  system.add("source", "fmi2_relaxation").add("sum", "fmi2_integrator").wire("source.x", "sum.u");
  core::RunOptions options = fixed_steps(step, Time(1s));
  options.extrapolation = extrapolation;
  options.coupling = core::Coupling::GaussSeidel;  // whose first step is not of a lower order
  const double exact = (1 - std::exp(-2.0)) / 2;
  return std::abs(run(system, options).value(Time(1s), "sum.x") - exact);
}

}  // namespace

TEST_CASE("any split of a step gives what one step gives, for an FMI 2.0 unit") {
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    std::uint64_t count = 0;
    const double k = 5 * random_uniform(trial, count++);
    const double u = 2 * random_uniform(trial, count++) - 1;
    CAPTURE(trial, k, u);
    Relaxation whole(k, u);
    Relaxation split(k, u);
    whole.step_to(Time(500ms));
    std::set<Time> ends{Time(500ms)};
    for (int i = 0; i < 10; ++i) ends.insert(random_instant(trial, count));
    for (const Time end : ends) split.step_to(end);
    CHECK(split.x() == Approx(whole.x()).epsilon(1e-12));
    CHECK(whole.x() == Approx(u + (1 - u) * std::exp(-k / 2)).epsilon(1e-12));
  }
}

TEST_CASE("where an FMI 2.0 unit came to is a communication point for all, to the picosecond") {
  const bool has_state = GENERATE(true, false);
  for (std::uint64_t trial = 0; trial < kTrials / 10; ++trial) {
    std::uint64_t count = 0;
    const Time turn = random_instant(trial, count);
    CAPTURE(has_state, trial, turn.time_since_epoch().count());
    Assembly system;
    system.add("linear", "linear", {{"u", "3"}})
        .add("turner", has_state ? "fmi2_turner" : "fmi2_turner_without_state",
             {{"turn", seconds_text(turn)}})
        .add("other", "fmi2_turner", {{"turn", "0.15"}})
        .add("relaxation", "fmi2_relaxation", {{"u", "0.5"}});
    const Results results = run(system, 70ms, Time(420ms));
    CHECK(instants(results).count(turn) == 1);
    CHECK(instants(results).count(Time(150ms)) == 1);
    for (const Time time : instants(results)) {
      CAPTURE(time.time_since_epoch().count());
      CHECK(results.value(time, "turner.y") == Approx(turned(time, to_seconds(turn))).margin(1e-9));
      CHECK(results.value(time, "other.y") == Approx(turned(time, 0.15)).margin(1e-9));
      CHECK(results.value(time, "relaxation.x") ==
            Approx(0.5 + 0.5 * std::exp(-2 * to_seconds(time))).epsilon(1e-12));
    }
    Assembly alone;
    alone.add("linear", "linear", {{"u", "3"}});
    const Results undisturbed = run(alone, 70ms, Time(420ms));
    for (const std::string& name : undisturbed.names) {
      CHECK(results.value(Time(420ms), name) ==
            Approx(undisturbed.value(Time(420ms), name)).epsilon(1e-9));
    }
    // once more where the other turns in the same step
    const core::UnitStatistics& turner = results.units.at("turner");
    CHECK((turner.rejections > 0) == has_state);
    CHECK(turner.rejections <= 2);
    CHECK(turner.early_returns == (has_state ? 0u : 1u));
  }
}

TEST_CASE("threads and the order of components change nothing with FMI 2.0 units") {
  Assembly system;
  system.add("first", "fmi2_turner", {{"turn", "0.0333"}})
      .add("sleeper", "fmi2_sleeper")
      .add("second", "fmi2_turner", {{"turn", "0.0777"}})
      .add("relaxation", "fmi2_relaxation")
      .add("linear", "linear")
      .wire("first.y", "relaxation.u")
      .wire("relaxation.x", "linear.u");
  const Results serial = run(system, 5ms, Time(100ms));
  const Results parallel = run(system, 5ms, Time(100ms), {.count = 3, .always = true});
  CHECK(serial.signals == parallel.signals);
  CHECK(run(system.shuffled(7), 5ms, Time(100ms)).signals == serial.signals);
  CHECK(serial.value(Time(100ms), "sleeper.y") == Approx(0.1));
}

TEST_CASE("a unit that ends the simulation within a step ends it for all, there") {
  const bool has_state = GENERATE(true, false);
  Assembly system;
  system.add("linear", "linear")
      .add("turner", has_state ? "fmi2_turner" : "fmi2_turner_without_state",
           {{"turn", "0.123"}, {"ends", "true"}});
  const Results results = run(system, 50ms, Time(400ms));
  CHECK(results.statistics.end == core::RunEnd::EndedByUnit);
  CHECK(results.statistics.reached == Time(123ms));
  CHECK(results.value(Time(123ms), "turner.y") == Approx(0.123));
}

TEST_CASE("a unit without a state cannot follow one that is discarded after it") {
  Assembly system;
  system.add("a", "fmi2_relaxation_without_state").add("b", "fmi2_turner_without_state");
  CHECK_THROWS_WITH(run(system, 100ms, Time(400ms)),
                    Contains("unit 'b', at 0.25 s: the unit stopped here, but 'a' is at 0.3 s "
                             "already and cannot be rolled back") &&
                        Contains("<stride:Host components=\"b\" snapshots=\"true\"/>"));
}

TEST_CASE("derivatives of inputs raise the order with the degree of the extrapolation") {
  const auto order = [](core::Extrapolation extrapolation) {
    return std::log2(integration_error(extrapolation, 20ms) /
                     integration_error(extrapolation, 10ms));
  };
  CHECK(order(core::Extrapolation::Hold) == Approx(1).margin(0.1));
  CHECK(order(core::Extrapolation::Linear) == Approx(2).margin(0.15));
  CHECK(order(core::Extrapolation::Quadratic) == Approx(3).margin(0.25));
}
