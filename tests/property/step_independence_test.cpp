// Results that do not depend on the communication step: a linear unit's, however its steps are
// split, and all that happens at events.
#include <catch2/catch.hpp>

#include "master/base/time_text.h"
#include "tests/property/random_system.h"
#include "tests/test_units/counted_random.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

/// Drives a linear unit alone, by hand.
class LinearUnit {
 public:
  LinearUnit(double damping, double frequency) : unit_(test_unit("linear")->instantiate("linear")) {
    set("damping", damping);
    set("frequency", frequency);
    unit_->enter_initialization(Time{}, std::nullopt);
    unit_->exit_initialization();
    unit_->update_discrete_states();
    unit_->enter_step_mode();
    set("u", 3);
  }
  void step_to(Time to) {
    REQUIRE(unit_->step({now_, to}).reached == to);
    now_ = to;
  }
  double get(const std::string& name) {
    core::ValueBlock value(core::ValueType::Float64, 1);
    unit_->get({&reference(name), 1}, value);
    return value.numbers<double>()[0];
  }

 private:
  const core::ValueReference& reference(const std::string& name) const {
    const auto& description = *test_unit("linear")->description();
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

/// All kinds of units, coupled by messages and by a level that changes at events.
Assembly interplay() {
  Assembly system;
  system.add("ball", "bouncing_ball", {{"start_height", "0.01"}})
      .add("other_ball", "bouncing_ball", {{"start_height", "0.02"}, {"restitution", "0.7"}})
      .add("announces", "ticker", {{"period", "0.0031"}})
      .add("finds", "ticker", {{"period", "0.0047"}, {"announces", "0"}})
      .add("rejects", "rejecter", {{"shortest", "0.0001"}, {"longest", "0.004"}})
      .add("stops", "early", {{"instants", "0.0123 0.05 0.0505 0.1111 0.2 0.25001 0.3 0.399"}})
      .add("linear", "linear")
      .wire("announces.level", "linear.u")
      .wire("finds.level", "stops.u")
      .wire("finds.level", "rejects.u");
  const std::pair<const char*, const char*> wires[] = {{"ball.impact", "hears_ball"},
                                                       {"other_ball.impact", "hears_other_ball"},
                                                       {"announces.tick", "hears_announced"},
                                                       {"finds.tick", "hears_found"}};
  for (const auto& [sender, listener] : wires) {
    system.add(listener, "listener").wire_message(sender, std::string(listener) + ".message");
  }
  return system;
}

}  // namespace

TEST_CASE("any split of a step gives what one step gives, for a linear unit") {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    std::uint64_t count = 0;
    const auto random = [&] { return random_uniform(trial, count++); };
    const double damping = trial == 0 ? 0 : 10 * random();
    const double frequency = trial < 2 ? 0 : 200 * (random() - 0.5);
    const Time end(Duration(1ms) * (1 + static_cast<int>(100 * random())));
    CAPTURE(trial, damping, frequency, core::to_text(end));
    LinearUnit whole(damping, frequency);
    whole.step_to(end);
    LinearUnit split(damping, frequency);
    for (Time now{}; now < end;) {
      const auto longest = static_cast<double>((end - now).count());
      // now and then a very short one, down to a picosecond
      const double share = random() < 0.1 ? 1e-9 * random() : random();
      now += Duration(1 + static_cast<std::int64_t>(share * (longest - 1)));
      if (count > 100) now = end;
      split.step_to(now);
    }
    for (const char* name : {"x", "y"}) {
      CHECK(split.get(name) == Approx(whole.get(name)).epsilon(1e-12).margin(1e-13));
    }
    CHECK(whole.get("x") != 1);
  }
}

TEST_CASE("messages are the same to the bit, whatever the communication step") {
  const Time stop(400ms);
  const Results expected = run(interplay(), 1ms, stop);
  const Duration step =
      GENERATE(Duration(5ms), Duration(700us), Duration(333'333'333), Duration(1s), Duration(57us));
  const Results results = run(interplay(), step, stop);
  CHECK(results.event_rows().size() > 200);
  const bool same_events = results.events == expected.events;
  CHECK(same_events);
  for (const char* listener :
       {"hears_ball", "hears_other_ball", "hears_announced", "hears_found"}) {
    INFO(listener);
    const std::string name(listener);
    CHECK(results.value(stop, name + ".received") > 10);
    CHECK(results.value(stop, name + ".misplaced") == 0);
    CHECK(results.value(stop, name + ".out_of_turn") == 0);
  }
  CHECK(results.value(stop, "stops.stops") == 8);
  CHECK(results.value(stop, "stops.events") == 8);
  for (const char* name : {"ball.h", "linear.x", "linear.y", "stops.y", "rejects.y"}) {
    INFO(name);
    CHECK(results.value(stop, name) == Approx(expected.value(stop, name)).epsilon(1e-11));
  }
}

TEST_CASE("ticks that are found within the step are those that are announced") {
  const auto ticks = [](const char* announces) {
    const Assembly system =
        Assembly()
            .add("ticker", "ticker", {{"period", "0.0017"}, {"announces", announces}})
            .add("listener", "listener")
            .wire_message("ticker.tick", "listener.message");
    return run(system, 1ms, Time(1s));
  };
  const Results announced = ticks("1");
  const Results found = ticks("0");
  CHECK(announced.units.at("ticker").early_returns == 0);
  CHECK(found.units.at("ticker").early_returns > 400);
  CHECK(announced.events == found.events);
  CHECK(announced.signals == found.signals);
}

TEST_CASE("random systems that are coupled through events only have one result for all steps") {
  const unsigned kSystems = kSanitized ? 5 : 50;
  const Time stop(100ms);
  for (unsigned seed = 0; seed < kSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::EventsOnly);
    const Duration step = Duration(20us) + Duration(random_bits(seed, 0) % 10'000'000'000);
    INFO("seed " << seed << ", step " << stride::decimal_seconds(step) << " s\n" << system.text());
    const Results expected = run(system, 1ms, stop);
    const Assembly varied = seed % 2 == 0 ? system : system.with_own_steps(seed);
    const Results results = run(varied, step, stop);
    CHECK(results.event_rows() == expected.event_rows());
    for (const std::string& name : expected.names) {
      if (name.find(".steps") != std::string::npos) continue;
      INFO(name);
      CHECK(results.value(stop, name) ==
            Approx(expected.value(stop, name)).epsilon(1e-11).margin(1e-12));
    }
  }
}
