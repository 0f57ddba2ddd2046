#include "master/engine/run/stepping/stepper.h"

#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

Describe integrator() {
  return Describe("integrator").input("u").output("y").never_rejects().event_mode();
}

/// For all that the master knows it may reject a step.
Describe may_reject() { return Describe("unknown").input("u").output("y").can_save_state(); }

/// y' = u + 1, exactly in each step, so that a step too many or too few shows.
StepResult integrate(ScriptedUnit& unit, Time from, Time to) {
  unit.number(1) += (unit.number(0) + 1) * to_seconds(to - from);
  return reached(to);
}

/// Integrates to the first of the instants inside the step, and stops there with an event.
auto stopping_at(std::set<Time> instants) {
  return [instants](ScriptedUnit& unit, Time from, Time to) {
    const auto stop = instants.upper_bound(from);
    const bool stops = stop != instants.end() && *stop < to;
    StepResult result = integrate(unit, from, stops ? *stop : to);
    result.early_return = stops;
    result.event_handling_needed = stop != instants.end() && *stop <= to;
    return result;
  };
}

using stride::tests::at;

}  // namespace

TEST_CASE("a unit that stops early makes a communication point for all") {
  const bool can_go_back = GENERATE(true, false);
  ScriptedSystem f;
  auto& a = f.add("a", may_reject().done());
  auto stopper = integrator().may_return_early();
  auto& b = f.add("b", (can_go_back ? stopper.can_save_state() : stopper).done());
  auto& c = f.add("c", integrator().done());
  a.on_step = c.on_step = integrate;
  b.on_step = stopping_at({at(0.0013), at(0.0027)});
  const auto times = points(f, 0.003, 1ms);
  CHECK(times == std::vector<Time>{at(0), at(0.001), at(0.0013), at(0.002), at(0.0027), at(0.003)});
  for (ScriptedUnit* unit : {&a, &b, &c}) CHECK(unit->number(1) == Approx(0.003).epsilon(1e-12));
  const auto& statistics = f.simulation->statistics();
  CHECK(statistics.units[0].rollbacks == 2);
  CHECK(statistics.units[1].early_returns == 2);
  CHECK(statistics.units[2].rollbacks == 0);
  CHECK(statistics.units[2].steps == 5);
}

TEST_CASE("two that stop on their own agree where one of them has snapshots") {
  ScriptedSystem f;
  const auto stopper = integrator().may_return_early().done();
  auto& a = f.add("a", stopper);
  auto& b = f.add("b", stopper);
  f.declaration.components[0].has_snapshots = f.declaration.components[1].has_snapshots = true;
  a.on_step = stopping_at({at(0.0013), at(0.0024)});
  b.on_step = stopping_at({at(0.0017), at(0.0021)});
  const auto times = points(f, 0.003, 1ms);
  CHECK(times == std::vector<Time>{at(0), at(0.001), at(0.0013), at(0.0017), at(0.002), at(0.0021),
                                   at(0.0024), at(0.003)});
  for (ScriptedUnit* unit : {&a, &b}) CHECK(unit->number(1) == Approx(0.003).epsilon(1e-12));
  const auto& units = f.simulation->statistics().units;
  CHECK(units[0].saves == 0);
  CHECK(units[1].saves == 7);
  CHECK(units[1].rollbacks == 2);
}

TEST_CASE("a unit that never stops goes where the others have got, and is not saved") {
  ScriptedSystem f;
  auto& a = f.add("a", integrator().can_save_state().done());
  auto& b = f.add("b", integrator().may_return_early().done());
  a.on_step = integrate;
  b.on_step = stopping_at({at(0.0013), at(0.0027)});
  f.build(0.003, 1ms).run();
  CHECK(a.number(1) == Approx(0.003).epsilon(1e-12));
  const auto& statistics = f.simulation->statistics().units[0];
  CHECK(statistics.steps == 5);
  CHECK(statistics.saves == 0);
  CHECK(statistics.rollbacks == 0);
}

TEST_CASE("the earliest of several stops counts, in any order of the units") {
  const bool swapped = GENERATE(false, true);
  ScriptedSystem f;
  const auto description = integrator().may_return_early().can_save_state().done();
  auto& a = f.add("a", description);
  auto& b = f.add("b", description);
  a.on_step = stopping_at({at(0.0002), at(0.0004), at(0.0007)});
  b.on_step = stopping_at({at(0.0003), at(0.0004), at(0.0009)});
  if (swapped) std::swap(a.on_step, b.on_step);
  const auto times = points(f, 0.001, 1ms);
  CHECK(times == std::vector<Time>{at(0), at(0.0002), at(0.0003), at(0.0004), at(0.0007),
                                   at(0.0009), at(0.001)});
  CHECK(a.number(1) == Approx(0.001).epsilon(1e-12));
  CHECK(b.number(1) == Approx(0.001).epsilon(1e-12));
}

TEST_CASE("a unit that rejects at random changes nothing but the statistics") {
  const auto run = [](bool rejects) {
    ScriptedSystem f;
    auto& a = f.add("a", may_reject().done());
    auto& b = f.add("b", may_reject().done());
    f.wire("a", "y", "b", "u");
    a.on_step = integrate;
    std::mt19937 random(7);
    std::set<std::int64_t> asked;
    b.on_step = [&, rejects](ScriptedUnit& unit, Time from, Time to) {
      if (rejects && to - from > 300us && asked.insert(from.time_since_epoch().count()).second &&
          random() % 3 == 0) {
        StepResult result;
        result.rejected = true;
        result.reached = from;
        return result;
      }
      unit.number(1) += to_seconds(to - from);
      return reached(to);
    };
    f.build(0.2, 1ms).run();
    const auto& statistics = f.simulation->statistics();
    CHECK((statistics.units[1].rejections > 20) == rejects);
    CHECK((statistics.units[0].rollbacks > 20) == rejects);
    return std::pair(a.number(1), b.number(1));
  };
  const auto plain = run(false);
  const auto rejecting = run(true);
  CHECK(rejecting.first == Approx(plain.first).epsilon(1e-12));
  CHECK(rejecting.second == Approx(plain.second).epsilon(1e-12));
}

TEST_CASE("where one unit rejects a step that another stops in, their order changes nothing") {
  const bool swapped = GENERATE(false, true);
  ScriptedSystem f;
  const auto rejects = [&] {
    f.add("rejects", Describe("r").can_save_state().done()).on_step = [](ScriptedUnit&, Time from,
                                                                         Time to) {
      if (to - from > 800us) return StepResult{.rejected = true, .reached = from};
      return reached(to);
    };
  };
  const auto stops = [&] {
    f.add("stops", integrator().may_return_early().can_save_state().done()).on_step =
        stopping_at({at(0.0007)});
  };
  swapped ? (stops(), rejects()) : (rejects(), stops());
  f.add("follows", integrator().can_save_state().done()).on_step = integrate;
  // half of the rejected step is nearer than the stop
  CHECK(points(f, 0.001, 1ms) == std::vector<Time>{at(0), at(0.0005), at(0.0007), at(0.001)});
  CHECK(f.instances[2]->number(1) == Approx(0.001).epsilon(1e-12));
}

TEST_CASE("the time that a unit could have reached becomes a communication point") {
  const bool is_alone = GENERATE(true, false);
  ScriptedSystem f;
  f.add("turns", Describe("t").can_save_state().output("y").done()).on_step =
      [](ScriptedUnit&, Time from, Time to) {
        const Time turn = at(0.0013);
        if (from < turn && turn < to) return StepResult{.rejected = true, .reached = turn};
        return reached(to);
      };
  if (!is_alone) f.add("follows", integrator().can_save_state().done()).on_step = integrate;
  CHECK(points(f, 0.002, 1ms) == std::vector<Time>{at(0), at(0.001), at(0.0013), at(0.002)});
  if (!is_alone) CHECK(f.instances[1]->number(1) == Approx(0.002).epsilon(1e-12));
}

TEST_CASE("half the way is tried where a unit names no instant within the step that it rejected") {
  const Time said = GENERATE(at(0), at(0.001), at(0.5), at(-1));
  ScriptedSystem f;
  f.add("vague", Describe("v").can_save_state().output("y").done()).on_step =
      [said](ScriptedUnit&, Time from, Time to) {
        if (to - from > 800us) return StepResult{.rejected = true, .reached = said};
        return reached(to);
      };
  CHECK(points(f, 0.001, 1ms) == std::vector<Time>{at(0), at(0.0005), at(0.001)});
}

TEST_CASE("an instant that is nearer than the minimum step is not tried") {
  ScriptedSystem f;
  f.add("near", Describe("n").can_save_state().output("y").done()).on_step = [](ScriptedUnit&,
                                                                                Time from, Time) {
    return StepResult{.rejected = true, .reached = from + Duration(10)};
  };
  CHECK_THAT(
      failure(f.build(1, 1ms)),
      Contains("unit 'near', at 0 s: the unit rejected the step to 0.001 s, once in all, and "
               "the next one to try, to 0.00000000001 s, would be shorter"));
}

TEST_CASE("a unit that always rejects is named, with how often and where") {
  ScriptedSystem f;
  f.add("calm", integrator().can_save_state().done()).on_step = integrate;
  f.add("stubborn", Describe("stubborn").output("y").done()).on_step = [](ScriptedUnit&, Time from,
                                                                          Time to) {
    StepResult result = reached(to);
    if (to > at(0.005)) result = {.rejected = true, .reached = from};
    return result;
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("unit 'stubborn', at 0.005 s") &&
                                           Contains("20 times") &&
                                           Contains("minimum of 0.000000001 s"));
}

TEST_CASE("a rejection after another unit's final step is an error that names both") {
  ScriptedSystem f;
  f.add("first", Describe("first").output("y").done()).on_step = [](ScriptedUnit&, Time, Time to) {
    return reached(to);
  };
  f.add("second", Describe("second").output("y").done()).on_step =
      [](ScriptedUnit&, Time from, Time) { return StepResult{.rejected = true, .reached = from}; };
  CHECK_THAT(failure(f.build(1, 1ms)),
             Contains("unit 'second'") && Contains("'first' is at 0.001 s already"));
}

TEST_CASE("a unit that stops for ever at one instant is named") {
  ScriptedSystem f;
  f.add("stuck", integrator().may_return_early().done()).on_step = [](ScriptedUnit&, Time from,
                                                                      Time) {
    return StepResult{.early_return = true, .reached = from};
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("'stuck'") && Contains("in a row"));
}

TEST_CASE("a unit of one step size is not given another") {
  ScriptedSystem f;
  auto description = std::make_shared<UnitDescription>(*integrator().done());
  description->can_vary_step = false;
  f.add("rigid", description).on_step = integrate;
  f.add("b", integrator().may_return_early().can_save_state().done()).on_step =
      stopping_at({at(0.0013)});
  CHECK_THAT(failure(f.build(1, 1ms)),
             Contains("unit 'rigid', at 0.001 s") && Contains("one size only"));
}

TEST_CASE("run to T is run to T/2, then on: any grid gives the same stops") {
  const auto stops = [](Duration step) {
    ScriptedSystem f;
    auto& a = f.add("a", integrator().may_return_early().can_save_state().done());
    f.add("b", integrator().can_save_state().done()).on_step = integrate;
    a.on_step = stopping_at({at(0.00123), at(0.0042), at(0.0077)});
    std::vector<Time> events;
    a.on_event = [&](ScriptedUnit&) {
      events.push_back(at(f.instances[1]->number(1)));
      return EventResult{};
    };
    f.build(0.01, step).run();
    return events;
  };
  CHECK(stops(1ms) == stops(5ms));
  CHECK(stops(1ms) == stops(333us));
}

TEST_CASE("a unit of one step size that rejects is blamed itself") {
  ScriptedSystem f;
  auto& rigid = f.add("rigid", Describe("rigid").fixed_step().done());
  rigid.on_step = [](ScriptedUnit&, Time from, Time to) {
    return to > Time(3ms) ? StepResult{.rejected = true, .reached = from} : reached(to);
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("unit 'rigid', at 0.003 s") &&
                                           Contains("rejected its step") &&
                                           Contains("one size only"));
}

TEST_CASE("a unit of one step size that rejects another one was made for its own") {
  ScriptedSystem f;
  auto description = std::make_shared<UnitDescription>(*Describe("rigid").fixed_step().done());
  description->default_step = 5ms;
  f.add("rigid", description).on_step = [](ScriptedUnit&, Time from, Time) {
    return StepResult{.rejected = true, .reached = from};
  };
  CHECK_THAT(failure(f.build(1, 1ms)),
             Contains("made for steps of 0.005 s") && Contains("use --step rigid=0.005"));
}

TEST_CASE("the error of a unit that rejects the shortened last step has the way out") {
  ScriptedSystem f;
  auto& whole = f.add("whole", integrator().can_save_state().done());
  whole.on_step = [](ScriptedUnit&, Time from, Time to) {
    return to - from < Duration(1ms) ? StepResult{.rejected = true, .reached = from} : reached(to);
  };
  CHECK_THAT(failure(f.build(0.0035, 1ms)),
             Contains("unit 'whole', at 0.003 s") && Contains("(--stop 0.003)"));
}

TEST_CASE("a rejection that a unit of one step size cannot follow is an error") {
  ScriptedSystem f;
  f.add("rigid", Describe("rigid").fixed_step().can_save_state().done());
  auto& picky = f.add("picky", Describe("picky").done());
  picky.on_step = [](ScriptedUnit&, Time from, Time to) {
    return to > Time(3ms) ? StepResult{.rejected = true, .reached = from} : reached(to);
  };
  CHECK_THAT(failure(f.build(1, 1ms)),
             Contains("unit 'rigid', at 0.003 s") && Contains("'picky', which rejected its step"));
}

TEST_CASE("how often a unit rejected is counted for each") {
  ScriptedSystem f;
  for (const char* name : {"a", "b"}) {
    f.add(name, Describe(name).can_save_state().done()).on_step = [](ScriptedUnit&, Time from,
                                                                     Time) {
      return StepResult{.rejected = true, .reached = from};
    };
  }
  f.options.step.minimum = 1us;
  const std::string error = failure(f.build(1, 1ms));
  const auto count = f.simulation->statistics().units[0].rejections;
  CHECK(count > 1);
  CHECK_THAT(error, Contains("unit 'a'") && Contains(fmt::format(" {} times ", count)));
}

TEST_CASE("super-dense instants are counted on while the time stays the same") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a")
                           .add("c", ValueType::Clock, Causality::Output)
                           .event_mode()
                           .may_return_early()
                           .done());
  int zero_steps = 3;
  a.on_step = [&](ScriptedUnit& unit, Time from, Time to) {
    if (from != Time(2ms) || zero_steps-- == 0) return reached(to);
    unit.clock(0) = true;
    StepResult result = reached(from);
    result.early_return = result.event_handling_needed = true;
    return result;
  };
  a.on_event = [](ScriptedUnit& unit) {
    unit.clock(0) = false;
    return EventResult{};
  };
  struct Indices : Observer {
    std::vector<std::uint32_t> at_stop;
    void on_message(const Message& message) override {
      if (message.time == Time(2ms)) at_stop.push_back(message.index);
    }
  } indices;
  f.build(0.004, 1ms).add_observer(indices);
  f.simulation->run();
  CHECK(indices.at_stop == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("after a rejection a step as long as the minimum is tried, and none that is shorter") {
  const bool is_enough = GENERATE(false, true);
  ScriptedSystem f;
  auto& unit = f.add("unit", may_reject().done());
  unit.on_step = [](ScriptedUnit&, Time from, Time to) {
    StepResult result = reached(to);
    result.rejected = to - from > Duration(500us);
    return result;
  };
  f.options.step.minimum = is_enough ? Duration(500us) : Duration(500us) + Duration(1);
  CHECK((failure(f.build(0.001, 1ms)) == "none") == is_enough);
}
