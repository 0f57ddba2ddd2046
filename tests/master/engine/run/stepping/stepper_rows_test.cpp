// Units that step in rows, and what a stepper notes of them.
#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/engine/run/row_unit.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

/// A ring of units that are never saved: a row of two, one by itself, and another row of two.
struct Rows : ScriptedSystem {
  explicit Rows(bool steps_in_rows) {
    options.steps_in_rows = options.steps_in_stretches = steps_in_rows;
    const auto description =
        Describe("unit").input("u").output("y").exact().event_mode().depends_on({}).done();
    for (const char* name : {"a", "b"}) add<RowUnit>(name, description);
    add("c", description);
    for (const char* name : {"d", "e"}) add<RowUnit>(name, description);
    for (std::size_t i = 0; i < 5; ++i) {
      instances[i]->on_step = integrate;
      const auto& components = declaration.components;
      wire(components[i].name, "y", components[(i + 1) % 5].name, "u");
    }
  }

  /// Beside what it does: in the step that begins then.
  void request_event(std::size_t unit, Time from) {
    instances[unit]->on_step = [from](ScriptedUnit& stepped, Time begin, Time end) {
      StepResult result = integrate(stepped, begin, end);
      result.event_handling_needed = begin == from;
      return result;
    };
  }
  /// All that can be seen of it.
  std::string run() {
    std::string text = failure(build(0.01, 1ms));
    const RunStatistics& counted = simulation->statistics();
    text += fmt::format(", {} steps, {} event iterations\n", counted.communication_steps,
                        counted.event_iterations);
    for (std::size_t i = 0; i < 5; ++i) {
      const UnitStatistics& unit = counted.units[i];
      auto* const in_row = dynamic_cast<RowUnit*>(instances[i]);
      text += fmt::format(
          "{} steps, {} rejections, {} early, {} events, {} gets, {} sets, y = {}\n", unit.steps,
          unit.rejections, unit.early_returns, unit.events, instances[i]->gets,
          in_row != nullptr ? in_row->sets : 0, instances[i]->number(1));
    }
    return text;
  }
  int rows() const {
    return dynamic_cast<RowUnit&>(*instances[0]).rows + dynamic_cast<RowUnit&>(*instances[3]).rows;
  }

 private:
  static StepResult integrate(ScriptedUnit& unit, Time from, Time to) {
    unit.number(1) += (unit.number(0) + 1) * to_seconds(to - from);
    return reached(to);
  }
};

/// `prepare` makes a unit do something.
template <class Prepare>
void check_same(Prepare&& prepare) {
  Rows singly(false), in_rows(true);
  prepare(singly);
  prepare(in_rows);
  CHECK(in_rows.run() == singly.run());
  CHECK(singly.rows() == 0);
  CHECK(in_rows.rows() > 0);
}

using stride::tests::at;

}  // namespace

TEST_CASE("units that can step in a row do so") {
  Rows rows(true);
  CHECK_THAT(rows.run(), Catch::Matchers::StartsWith("none, 10 steps"));
  CHECK(rows.rows() > 10);
  check_same([](Rows&) {});
}

TEST_CASE("a request within a row is its unit's, and is not repeated with that of another unit") {
  const std::size_t first = GENERATE(0, 1, 4);
  const std::size_t second = GENERATE(2, 3);
  check_same([&](Rows& rows) {
    rows.request_event(first, at(0.004));
    rows.request_event(second, at(0.005));
  });
}

TEST_CASE("a unit of a row that stops early stops all, or fails if another one is too far") {
  const std::size_t stopped = GENERATE(0, 1, 4);
  check_same([&](Rows& rows) {
    rows.instances[stopped]->on_step = [](ScriptedUnit&, Time from, Time to) {
      StepResult result = reached(from == at(0.004) ? at(0.0045) : to);
      result.early_return = from == at(0.004);
      return result;
    };
  });
}

TEST_CASE("a unit of a row that rejects a step keeps the inputs for the shorter one") {
  const std::size_t rejecting = GENERATE(0, 1, 4);
  check_same([&](Rows& rows) {
    rows.instances[rejecting]->on_step = [](ScriptedUnit&, Time from, Time to) {
      StepResult result = reached(to);
      result.rejected = from == at(0.004) && to > at(0.0043);
      if (result.rejected) result.reached = from;
      return result;
    };
  });
}

TEST_CASE("the steps before a failure in a row count") {
  const std::size_t failing = GENERATE(0, 1, 3, 4);
  check_same([&](Rows& rows) {
    rows.instances[failing]->on_step = [](ScriptedUnit&, Time from, Time to) -> StepResult {
      if (from == at(0.004)) fail_run({{}, "it", {}, from}, "it fails");
      return reached(to);
    };
  });
}
