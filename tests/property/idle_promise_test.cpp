// What the units promise they keep, whatever their parameters, and however they are stepped.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/build.h"
#include "tests/property/promise.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}
std::string number(double value) { return fmt::format("{}", value); }
Time after(double seconds) { return time_from_seconds(seconds); }

std::shared_ptr<importer::Fmu> unit(const std::string& name) {
  return importer::Fmu::load(unit_folder() / (name + ".fmu"));
}
std::shared_ptr<importer::Fmu> test_unit(const std::string& name) {
  return importer::Fmu::load(test_unit_folder() / (name + ".fmu"));
}

PromiseCheck promise_check(const std::shared_ptr<importer::Fmu>& fmu,
                           const SteppedUnit::Settings& settings, std::uint64_t seed,
                           Duration max_skip = Duration::max()) {
  return {SteppedUnit(fmu, settings, max_skip), SteppedUnit(fmu, settings, max_skip),
          SteppedUnit(fmu, settings, std::nullopt), seed};
}

/// The same to all three.
template <class Action>
void each(PromiseCheck& check, Action&& action) {
  for (SteppedUnit* stepped : {&check.single_step, &check.small_steps, &check.no_skipping})
    action(*stepped);
}

}  // namespace

TEST_CASE("an idler that keeps its promise passes") {
  const auto fmu = test_unit("idler");
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto check = promise_check(fmu,
                               {{"rate", number(between(random, 0, 2))},
                                {"period", seed % 3 == 0 ? "0" : number(between(random, 0.01, 1))},
                                {"announces", seed % 2 == 0 ? "true" : "false"}},
                               seed);
    each(check,
         [to = after(between(random, 0, 3))](SteppedUnit& stepped) { stepped.advance(to, 100ms); });
    const Time start = check.single_step.now();
    Time promised{};
    CHECK(check.run(promised) == "");
    CHECK(promised > start);
  }
}

TEST_CASE("an idler that breaks its promise is caught") {
  const auto broken = [fmu = test_unit("idler")](const std::string& promise) {
    auto check = promise_check(fmu, {{"promise", promise}}, 1);
    Time promised{};
    return check.run(promised);
  };
  CHECK(broken("honest") == "");
  CHECK_THAT(broken("ticks"), Catch::Contains("it wants an event"));
  CHECK_THAT(broken("returns_early"), Catch::Contains("it returns early"));
  CHECK_THAT(broken("rejects"), Catch::Contains("it rejects a step"));
  CHECK_THAT(broken("drifts"), Catch::Contains("'level'") && Catch::Contains("from its tangent"));
}

TEST_CASE("the environment keeps what it promises") {
  const auto fmu = unit("environment");
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const SteppedUnit::Settings settings = {
        {"ambient.drift.amplitude", seed % 4 == 0 ? "0" : number(between(random, 0, 5))},
        {"ambient.drift.period", number(std::exp(between(random, 0, 9)))},
        {"case.heat_capacity", number(std::exp(between(random, -2, 4)))},
        {"case.thermal_resistance", number(std::exp(between(random, -2, 6)))},
        {"case.initial_temperature", number(between(random, 15, 30))}};
    auto check = promise_check(fmu, settings, seed);
    const std::string power = number(between(random, 0, 0.5));
    const Time start = after(between(random, 0, 100));
    const bool is_new = seed % 5 == 0;
    each(check, [&](SteppedUnit& stepped) {
      stepped.advance(start, 10s);
      stepped.set("absorbed_power", power);
      if (!is_new) stepped.advance(start + 1ms, 1ms);
    });
    check.until = start + 10'000s;
    Time promised{};
    CHECK(check.run(promised) == "");
    CHECK((is_new || promised > start + 1ms));
  }
}

TEST_CASE("an environment in the steady state promises without an end") {
  auto check = promise_check(unit("environment"), {}, 1);
  Time promised{};
  check.until = after(1e6);
  CHECK(check.run(promised) == "");
  CHECK(promised == Time::max());
}

TEST_CASE("the reader keeps what it promises") {
  const auto fmu = unit("reader");
  int promises = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto check = promise_check(fmu,
                               {{"seed", number(static_cast<double>(seed + 1))},
                                {"tremor.amplitude", seed % 10 == 0 ? "0.01" : "0"}},
                               seed);
    each(check,
         [to = after(between(random, 0, 30))](SteppedUnit& stepped) { stepped.advance(to, 5s); });
    const Time start = check.single_step.now();
    check.until = start + 100s;
    Time promised{};
    CHECK(check.run(promised) == "");
    if (promised > start) ++promises;
    CHECK((seed % 10 != 0 || promised == start));
  }
  CHECK(promises > 50);
}

TEST_CASE("an arm that has settled keeps what it promises") {
  const auto fmu = unit("nfc_approach_world");
  int promises = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto check = promise_check(fmu, {}, seed);
    const std::string shoulder = number(between(random, 0.2, 0.45));
    const std::string wrist = number(between(random, -1, 1));
    const Time moved = after(between(random, 0.1, 1.5));
    const Time asked = moved + duration_from_seconds(between(random, 0.001, 1.5));
    each(check, [&](SteppedUnit& stepped) {
      stepped.advance(moved, 50ms);
      stepped.set("actuator.shoulder", shoulder);
      stepped.set("actuator.wrist_3", wrist);
      stepped.advance(asked, 50ms);
    });
    check.until = asked + 5s;
    Time promised{};
    CHECK(check.run(promised) == "");
    if (promised > asked) ++promises;
  }
  CHECK(promises > 5);
  CHECK(promises < 30);
}

TEST_CASE("the channel keeps what it promises") {
  const std::string name = GENERATE("nfc_channel", "rf_channel", "ideal_channel");
  CAPTURE(name);
  const auto fmu = unit(name);
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto check = promise_check(fmu, {{"carrier_power", seed % 2 == 0 ? "0" : "0.2"}}, seed);
    const std::string height = number(between(random, 0.005, 0.1));
    const bool is_new = seed % 5 == 0;
    each(check, [&](SteppedUnit& stepped) {
      stepped.set("tag_coil.position.z", height);
      if (!is_new) stepped.advance(Time(10ms), 3ms);
    });
    check.until = Time(100s);
    Time promised{};
    CHECK(check.run(promised) == "");
    CHECK(promised == (is_new ? Time{} : Time::max()));
  }
}
