#include "master/engine/run/stepping/coasting_unit.h"

#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride;
using namespace stride::core;
using stride::tests::at;

namespace {

constexpr std::size_t kCache = 1 << 20;
constexpr ValueReference kSummand = 0, kSum = 1, kLabel = 2;

std::shared_ptr<const UnitDescription> summing() {
  return Describe("summing")
      .input("u")
      .output("y")
      .add("text", ValueType::String, Causality::Input)
      .can_save_state()
      .done();
}

/// A unit that adds its input to its output in each step, and notes what it is asked for.
struct Coasting {
  explicit Coasting(std::size_t interval = 4, bool is_concurrent = false) {
    auto scripted = std::make_unique<ScriptedUnit>(description);
    unit = scripted.get();
    unit->is_concurrent = is_concurrent;
    unit->on_step = [this](ScriptedUnit& self, Time from, Time to) {
      journal += fmt::format(
          " {}", std::chrono::round<std::chrono::milliseconds>(to.time_since_epoch()).count());
      self.number(kSum) += self.number(kSummand) + drift;
      StepResult result;
      result.reached = rejected_from && from >= *rejected_from ? from : to;
      result.rejected = rejected_from && from >= *rejected_from;
      return result;
    };
    unit->on_state = [this](bool save) { journal += save ? " save" : " restore"; };
    coasting = std::make_unique<CoastingUnit>(std::move(scripted), *description,
                                              SaveInterval(interval, false), kCache);
  }

  /// Saves, and makes a step with this input. The time is in ms.
  StepResult step(int from, double input, int to = 0) {
    const StepInterval interval(at(1e-3 * from), at(1e-3 * (to == 0 ? from + 1 : to)));
    const StepValues values{{&bound_input, 1}, {&bound_output, 1}};
    inputs.numbers<double>()[0] = input;
    if (unit->is_concurrent) {
      auto& steps = coasting->require_capability<ConcurrentSteps>();
      steps.begin_step(interval, values, {.saves_state = true});
      return steps.finish_step();
    }
    coasting->save_state();
    return coasting->step(interval, values);
  }
  double output() const { return outputs.numbers<double>()[0]; }

  std::shared_ptr<const UnitDescription> description = summing();
  std::string journal;
  double drift = 0;
  std::optional<Time> rejected_from;
  ScriptedUnit* unit = nullptr;
  std::unique_ptr<CoastingUnit> coasting;
  ValueBlock inputs{ValueType::Float64, 1}, outputs{ValueType::Float64, 1};
  BoundValues bound_input{{&kSummand, 1}, inputs}, bound_output{{&kSum, 1}, outputs};
};

}  // namespace

TEST_CASE("a state is saved before some of the steps only") {
  Coasting f(4, GENERATE(false, true));
  for (int i = 0; i < 9; ++i) f.step(i, 1);
  CHECK(f.journal == " save 1 2 3 4 save 5 6 7 8 save 9");
  CHECK(f.output() == 9);
  CHECK(f.coasting->counts().saves == 3);
  CHECK(f.coasting->counts().repeated_steps == 0);
}

TEST_CASE("what is taken back repeats the steps since the save, with their inputs") {
  Coasting f(4, GENERATE(false, true));
  f.step(0, 1);
  f.step(1, 20);
  f.step(2, 300);
  f.coasting->restore_state();
  CHECK(f.journal == " save 1 2 3 restore 1 2 save");
  CHECK(f.unit->number(kSum) == 21);
  CHECK(f.output() == 21);
  CHECK(f.coasting->counts().repeated_steps == 2);
  CHECK_FALSE(f.coasting->counts().inexact_repetition);
  f.step(2, 4000);
  CHECK(f.output() == 4021);
}

TEST_CASE("what is taken back twice repeats nothing the second time") {
  Coasting f;
  f.step(0, 1);
  f.step(1, 2);
  f.coasting->restore_state();
  f.journal.clear();
  f.inputs.numbers<double>()[0] = 5;
  f.coasting->step(StepInterval(at(0.001), at(0.0015)),
                   {{&f.bound_input, 1}, {&f.bound_output, 1}});
  f.coasting->restore_state();
  CHECK(f.journal == " 2 restore");
  CHECK(f.unit->number(kSum) == 1);
}

TEST_CASE("inputs that are set between steps are set again") {
  Coasting f;
  f.step(0, 1);
  ValueBlock between(ValueType::Float64, 1);
  between.numbers<double>()[0] = 7;
  f.coasting->set({&kSummand, 1}, between);
  f.coasting->save_state();
  f.coasting->step(StepInterval(at(0.001), at(0.002)), {{}, {&f.bound_output, 1}});
  f.coasting->save_state();
  f.coasting->set({&kSummand, 1}, ValueBlock(ValueType::Float64, 1));
  f.coasting->restore_state();
  CHECK(f.unit->number(kSum) == 8);
  CHECK(f.unit->number(kSummand) == 7);
  between.numbers<double>()[0] = 9;
  f.coasting->set({&kSummand, 1}, between);
  f.coasting->save_state();
  f.coasting->set({&kSummand, 1}, ValueBlock(ValueType::Float64, 1));
  f.coasting->restore_state();
  CHECK(f.unit->number(kSummand) == 9);
}

TEST_CASE("an event, and an input that is no number, end a stretch") {
  Coasting f;
  f.step(0, 1);
  const bool is_event = GENERATE(true, false);
  if (is_event) {
    f.coasting->enter_event_mode();
    f.coasting->enter_step_mode();
  } else {
    f.coasting->set({&kLabel, 1}, ValueBlock(ValueType::String, 1));
  }
  f.step(1, 1);
  f.step(2, 1);
  CHECK(f.journal == " save 1 save 2 3");
}

TEST_CASE("a unit that sets inputs within its step is saved before each") {
  Coasting f;
  auto step = f.unit->on_step;
  f.unit->on_step = [&](ScriptedUnit& self, Time from, Time to) {
    f.coasting->set({&kSummand, 1}, f.inputs);
    return step(self, from, to);
  };
  f.step(0, 1);
  f.step(1, 1);
  f.step(2, 1);
  CHECK(f.journal == " save 1 save 2 save 3");
}

TEST_CASE("inputs that come with a step elsewhere are a part of the state before it") {
  Coasting f(4, true);
  f.step(0, 7);
  f.coasting->restore_state();
  CHECK(f.unit->number(kSum) == 0);
  CHECK(f.unit->number(kSummand) == 7);
  f.step(0, 1);
  f.step(1, 20);
  f.coasting->restore_state();
  CHECK(f.unit->number(kSum) == 1);
  CHECK(f.unit->number(kSummand) == 20);
  CHECK(f.journal == " save 1 restore 1 2 restore 1 save");
}

TEST_CASE("a measured save and its step elsewhere are two requests") {
  auto scripted = std::make_unique<ScriptedUnit>(summing());
  ScriptedUnit& unit = *scripted;
  unit.is_concurrent = true;
  unit.time_of_step = std::chrono::hours(1);
  int saves = 0, saves_in_step = 0;
  unit.on_state = [&](bool) { ++saves; };
  unit.on_begin_step = [&](ScriptedUnit& self) { saves_in_step += self.saved_with_step; };
  const auto description = summing();
  CoastingUnit coasting(std::move(scripted), *description, SaveInterval(8, true), kCache);
  for (int i = 0; i < 32; ++i) {
    coasting.begin_step(StepInterval(at(0.001 * i), at(0.001 * (i + 1))), {},
                        {.saves_state = true});
    coasting.finish_step();
  }
  CHECK(saves == 32);  // each: a step of an hour is not repeated to spare a save
  CHECK(saves_in_step == 30);
}

TEST_CASE("a step that was rejected is not repeated") {
  Coasting f(4, GENERATE(false, true));
  f.step(0, 1);
  f.rejected_from = at(0.001);
  CHECK(f.step(1, 1).rejected);
  f.rejected_from.reset();
  f.unit->number(kSum) = 1;  // it is as it was
  f.coasting->step(StepInterval(at(0.001), at(0.0015)), {{}, {&f.bound_output, 1}});
  f.coasting->save_state();
  f.coasting->step(StepInterval(at(0.0015), at(0.002)), {{}, {&f.bound_output, 1}});
  f.journal.clear();
  f.coasting->restore_state();
  CHECK(f.journal == " restore 1 2 save");
  CHECK(f.unit->number(kSum) == 2);
}

TEST_CASE("a unit may be taken back beyond the beginning of a step but for the first one") {
  Coasting f;
  std::string seen;
  struct Watching : ForwardingUnit {
    Watching(std::unique_ptr<Unit> unit, std::string& text)
        : ForwardingUnit(std::move(unit)), seen(text) {}
    StepResult step(const StepInterval& interval, const StepValues& values) override {
      seen += interval.may_go_back_before ? 'b' : '-';
      return ForwardingUnit::step(interval, values);
    }
    std::string& seen;
  };
  CoastingUnit unit(std::make_unique<Watching>(std::make_unique<ScriptedUnit>(f.description), seen),
                    *f.description, SaveInterval(3, false), kCache);
  for (int i = 0; i < 5; ++i) {
    unit.save_state();
    unit.step(StepInterval(at(0.001 * i), at(0.001 * (i + 1))), {});
  }
  CHECK(seen == "-bb-b");
}

TEST_CASE("a unit that does not repeat what it did is found, and is saved before each step") {
  Coasting f;
  f.step(0, 1);
  f.step(1, 1);
  f.drift = 0.25;
  f.coasting->restore_state();
  REQUIRE(f.coasting->counts().inexact_repetition);
  CHECK(f.coasting->counts().inexact_repetition->time == at(0.001));
  CHECK(f.coasting->counts().inexact_repetition->variable == "y");
  CHECK(f.coasting->counts().inexact_repetition->first == "1");
  CHECK(f.coasting->counts().inexact_repetition->second == "1.25");
  f.journal.clear();
  f.step(1, 1);
  f.step(2, 1);
  f.step(3, 1);
  CHECK(f.journal == " save 2 save 3 save 4");
}
