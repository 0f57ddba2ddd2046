#include "master/engine/run/stepping/coasting_row.h"

#include <array>
#include <chrono>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride;
using namespace stride::core;
using stride::tests::at;

namespace {

constexpr ValueReference kRowSummand = 0, kRowSum = 1;
constexpr std::size_t kRowCache = 1 << 20;

/// Adds its input to its output in each step, and notes what it is asked for: 'a' to 'c' a step,
/// which is a capital letter where it may be taken back beyond its beginning.
class Summing : public ScriptedUnit {
 public:
  Summing(std::shared_ptr<const UnitDescription> description, char letter, std::string& journal)
      : ScriptedUnit(std::move(description)), letter_(letter), journal_(journal) {
    on_state = [this](bool save) { journal_ += fmt::format("{}{} ", letter_, save ? '+' : '-'); };
  }
  StepResult step(const StepInterval& interval, const StepValues& values) override {
    journal_ += interval.may_go_back_before ? static_cast<char>(letter_ - 32) : letter_;
    journal_ += ' ';
    return Unit::step(interval, values);
  }

 private:
  char letter_;
  std::string& journal_;
};

struct PlainRow : UnitRow {
  std::vector<StepsInARow::Member> members;
  int* calls;

  std::size_t size() const override { return members.size(); }
  bool step(const StepInterval& interval, Progress& progress) override {
    ++*calls;
    for (; progress.plain < members.size(); ++progress.plain) {
      const auto& [unit, values] = members[progress.plain];
      progress.result = unit->step(interval, values);
      if (!progress.result.reached_without_request(interval.to)) return false;
    }
    return true;
  }
};

/// A clock that only spend() advances.
std::chrono::steady_clock::time_point clock_reading;

void spend(std::chrono::microseconds duration) { clock_reading += duration; }

/// Three units in a row, saved before each `most`-th step unless the interval adapts.
struct CoastingRows {
  explicit CoastingRows(std::size_t most = 4, bool adapts = false) {
    auto plain = std::make_unique<PlainRow>();
    plain->calls = &calls;
    std::vector<CoastingRow::Member> members;
    for (std::size_t i = 0; i < 3; ++i) {
      auto unit = std::make_unique<Summing>(description, static_cast<char>('a' + i), journal);
      units[i] = unit.get();
      units[i]->on_step = [this, i](ScriptedUnit& self, Time from, Time to) {
        self.number(kRowSum) += self.number(kRowSummand) + drift;
        return i == special && special_step ? special_step(self, from, to)
                                            : StepResult{.reached = to};
      };
      coasting[i] = std::make_unique<CoastingUnit>(
          std::move(unit), *description, SaveInterval(most, adapts, [] { return clock_reading; }),
          kRowCache);
      values[i] = {{&bound[2 * i], 1}, {&bound[2 * i + 1], 1}};
      plain->members.push_back({&coasting[i]->in_row(), values[i]});
      members.push_back({coasting[i].get(), values[i]});
    }
    row = std::make_unique<CoastingRow>(std::move(plain), members);
  }

  /// From this time on [ms], with an input that is another one for each unit and step.
  UnitRow::Progress step(int from) {
    for (std::size_t i = 0; i < 3; ++i) input(i) = input_of(i, from);
    UnitRow::Progress progress;
    row->step(StepInterval(at(1e-3 * from), at(1e-3 * (from + 1))), progress);
    return progress;
  }
  void make_steps(int count) {
    for (int i = 0; i < count; ++i) step(i);
  }
  static double input_of(std::size_t unit, int from) {
    return static_cast<double>(unit + 1) * (1 + 10 * from);
  }
  /// Of the unit, behind so many steps.
  static double sum_of(std::size_t unit, int steps) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += input_of(unit, i);
    return sum;
  }
  double& input(std::size_t i) { return blocks[2 * i].numbers<double>()[0]; }
  double output(std::size_t i) { return blocks[2 * i + 1].numbers<double>()[0]; }
  std::string take_journal() { return std::exchange(journal, ""); }

  std::shared_ptr<const UnitDescription> description =
      Describe("summing").input("u").output("y").can_save_state().done();
  std::string journal;
  int calls = 0;  ///< of the row
  double drift = 0;
  std::size_t special = 1;
  std::function<StepResult(ScriptedUnit&, Time, Time)> special_step;
  std::array<Summing*, 3> units{};
  std::array<std::unique_ptr<CoastingUnit>, 3> coasting;
  std::vector<ValueBlock> blocks{6, ValueBlock(ValueType::Float64, 1)};
  std::array<BoundValues, 6> bound{BoundValues{{&kRowSummand, 1}, blocks[0]},
                                   {{&kRowSum, 1}, blocks[1]},
                                   {{&kRowSummand, 1}, blocks[2]},
                                   {{&kRowSum, 1}, blocks[3]},
                                   {{&kRowSummand, 1}, blocks[4]},
                                   {{&kRowSum, 1}, blocks[5]}};
  std::array<StepValues, 3> values;
  std::unique_ptr<CoastingRow> row;
};

}  // namespace

TEST_CASE("units of a row are saved before the same steps, and called as a row in all others") {
  CoastingRows f(3);
  f.make_steps(5);
  CHECK(f.journal == "a+ a b+ b c+ c A B C A B C a+ a b+ b c+ c A B C ");
  CHECK(f.calls == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(f.output(i) == CoastingRows::sum_of(i, 5));
    CHECK(f.coasting[i]->counts().saves == 2);
  }
}

TEST_CASE("each unit of a row that is taken back repeats its own steps, and is saved anew") {
  CoastingRows f;
  const int steps = GENERATE(1, 2, 4, 7);
  f.make_steps(steps);
  f.take_journal();
  for (const std::size_t i : {2, 0}) {
    f.coasting[i]->restore_state();
    CHECK(f.units[i]->number(kRowSum) == CoastingRows::sum_of(i, steps - 1));
    CHECK(f.units[i]->number(kRowSummand) == CoastingRows::input_of(i, steps - 1));
    CHECK_FALSE(f.coasting[i]->counts().inexact_repetition);
  }
  CHECK(f.units[1]->number(kRowSum) == CoastingRows::sum_of(1, steps));
  if (steps == 1) CHECK(f.journal == "c- a- ");
  if (steps == 2) CHECK(f.journal == "c- c c+ a- a a+ ");
  if (steps == 4) CHECK(f.journal == "c- c C C c+ a- a A A a+ ");
  if (steps == 7) CHECK(f.journal == "c- c C c+ a- a A a+ ");
}

TEST_CASE("a unit that was taken back joins its row again, and can be taken back again") {
  CoastingRows f;
  f.make_steps(3);
  for (const auto& unit : f.coasting) {
    unit->restore_state();
    unit->step(StepInterval(at(0.002), at(0.003)), f.values[0]);
    if (&unit == &f.coasting[0]) break;
  }
  f.take_journal();
  f.step(3);  // 'a' has one step behind its save, the others have three
  CHECK(f.take_journal() == "A B C ");
  f.step(4);
  CHECK(f.take_journal() == "A b+ b c+ c ");
  f.step(5);
  CHECK(f.take_journal() == "A B C ");
  f.step(6);
  CHECK(f.take_journal() == "a+ a B C ");
  f.coasting[1]->restore_state();
  CHECK(f.take_journal() == "b- b B b+ ");
  CHECK(f.units[1]->number(kRowSum) == CoastingRows::sum_of(1, 6));
  f.coasting[0]->restore_state();
  CHECK(f.take_journal() == "a- ");
  CHECK(f.units[0]->number(kRowSum) == CoastingRows::sum_of(0, 6));
}

TEST_CASE("an event of a unit in a row ends its stretch, and those of the others go on") {
  CoastingRows f;
  f.make_steps(2);
  f.coasting[1]->enter_event_mode();
  f.coasting[1]->enter_step_mode();
  f.take_journal();
  f.step(2);
  f.step(3);
  CHECK(f.take_journal() == "A b+ b C A B C ");
  f.coasting[1]->restore_state();
  f.coasting[2]->restore_state();
  CHECK(f.take_journal() == "b- b b+ c- c C C c+ ");
  for (const std::size_t i : {1, 2}) CHECK(f.output(i) == CoastingRows::sum_of(i, 3));
}

TEST_CASE("an input that is set between the steps of a row is set again between them") {
  CoastingRows f;
  f.make_steps(2);
  ValueBlock between(ValueType::Float64, 1);
  between.numbers<double>()[0] = 1000;
  f.coasting[1]->set({&kRowSum, 1}, between);
  f.step(2);
  f.step(3);
  f.coasting[1]->restore_state();
  CHECK(f.units[1]->number(kRowSum) == 1000 + CoastingRows::input_of(1, 2));
  CHECK_FALSE(f.coasting[1]->counts().inexact_repetition);
}

TEST_CASE("a row ends at a unit that rejects, and none behind it has the step to repeat") {
  CoastingRows f;
  f.make_steps(2);
  f.special_step = [](ScriptedUnit& unit, Time from, Time) {
    unit.number(kRowSum) -= unit.number(kRowSummand);
    return StepResult{.rejected = true, .reached = from};
  };
  f.take_journal();
  CHECK(f.step(2).plain == 1);
  CHECK(f.take_journal() == "A B ");
  f.special_step = nullptr;
  f.coasting[2]->save_and_step(StepInterval(at(0.002), at(0.003)), f.values[2]);
  f.take_journal();
  for (const auto& unit : f.coasting) unit->restore_state();
  CHECK(f.take_journal() == "a- a A a+ b- b B b+ c- c C c+ ");
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(f.units[i]->number(kRowSum) == CoastingRows::sum_of(i, 2));
    CHECK(f.units[i]->number(kRowSummand) == CoastingRows::input_of(i, 2));
    CHECK_FALSE(f.coasting[i]->counts().inexact_repetition);
  }
}

TEST_CASE("a unit of a row that stops early repeats the step up to there") {
  CoastingRows f;
  f.make_steps(1);
  std::vector<Time> ends;
  f.special_step = [&](ScriptedUnit&, Time from, Time to) {
    ends.push_back(to);
    const bool is_early = from == at(0.001);
    return StepResult{.early_return = is_early, .reached = is_early ? at(0.0015) : to};
  };
  CHECK(f.step(1).result.reached == at(0.0015));
  f.coasting[1]->save_and_step(StepInterval(at(0.0015), at(0.0025)), f.values[1]);
  ends.clear();
  f.coasting[1]->restore_state();
  CHECK(ends == std::vector{at(0.001), at(0.002)});
  CHECK_FALSE(f.coasting[1]->counts().inexact_repetition);
}

TEST_CASE("a unit of a row that does not repeat what it did is saved before each step") {
  CoastingRows f;
  f.make_steps(3);
  f.drift = 0.25;
  f.coasting[1]->restore_state();
  REQUIRE(f.coasting[1]->counts().inexact_repetition);
  CHECK(f.coasting[1]->counts().inexact_repetition->time == at(0.002));
  CHECK(f.coasting[1]->counts().inexact_repetition->first == "24");
  CHECK(f.coasting[1]->counts().inexact_repetition->second == "24.5");
  f.coasting[1]->step(StepInterval(at(0.002), at(0.003)), f.values[1]);
  f.take_journal();
  f.step(3);
  f.step(4);
  f.step(5);
  CHECK(f.journal == "A b+ b C a+ a b+ b c+ c A b+ b C ");
}

TEST_CASE("the more often units of a row are taken back the more often all are saved") {
  constexpr auto kCost = std::chrono::microseconds(5);  // of a save, and of a step
  constexpr int kSteps = 4000;
  const int rollback_each = GENERATE(0, 50);
  CoastingRows f(1000, true);
  for (Summing* unit : f.units) {
    unit->on_state = [kCost](bool) { spend(kCost); };
    unit->on_step = [kCost](ScriptedUnit&, Time, Time to) {
      spend(kCost);
      return StepResult{.reached = to};
    };
  }
  for (int i = 0; i < kSteps; ++i) {
    f.step(i);
    if (rollback_each == 0 || i % rollback_each != rollback_each - 1) continue;
    for (std::size_t unit = 0; unit < 3; ++unit) {
      f.coasting[unit]->restore_state();
      f.coasting[unit]->step(StepInterval(at(1e-3 * i), at(1e-3 * (i + 1))), f.values[unit]);
    }
  }
  // about each sqrt(2 * 4000)-th step without rollbacks, and each tenth with them
  const CoastingUnit::Counts& counts = f.coasting[1]->counts();
  if (rollback_each == 0) {
    CHECK(counts.saves < 250);
    CHECK(counts.repeated_steps == 0);
  } else {
    CHECK(counts.saves > 300);
    CHECK(counts.repeated_steps < 15 * kSteps / 50);
  }
}

TEST_CASE("units of a row that is released have all that was noted of them") {
  CoastingRows f;
  f.make_steps(3);
  f.row->release();
  f.take_journal();
  for (double& input : f.blocks[0].numbers<double>()) input = 77;
  for (const auto& unit : f.coasting) unit->restore_state();
  CHECK(f.take_journal() == "a- a A a+ b- b B b+ c- c C c+ ");
  f.step(2);
  CHECK(f.output(0) == CoastingRows::sum_of(0, 3));
}
