// Units that step elsewhere do so at the same time, and nothing but the time depends on it.
#include <string>
#include <vector>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// "a" is said to begin, "a." to step, in what order it happens.
using Log = std::vector<std::string>;

Describe plain() {
  return Describe("plain").input("u").output("y").can_save_state().never_rejects();
}

ScriptedUnit& add(ScriptedSystem& system, const std::string& name, bool is_concurrent, Log& log,
                  Describe describe = plain()) {
  ScriptedUnit& unit = system.add(name, describe.done());
  unit.is_concurrent = is_concurrent;
  unit.on_begin_step = [&log, name](ScriptedUnit&) { log.push_back(name); };
  unit.on_step = [&log, name](ScriptedUnit&, Time, Time to) {
    log.push_back(name + ".");
    return reached(to);
  };
  return unit;
}

/// That fails at 1 ms.
void make_fail(ScriptedUnit& unit, const std::string& name) {
  unit.on_step = [name](ScriptedUnit&, Time from, Time to) {
    if (from == Time(1ms)) fail_run({{}, name, {}, from}, "it broke");
    return reached(to);
  };
}

}  // namespace

TEST_CASE("all that step elsewhere begin, then the others step, then they are waited for") {
  ScriptedSystem system;
  Log log;
  add(system, "a", false, log);
  add(system, "b", true, log);
  add(system, "c", false, log);
  add(system, "d", true, log);
  system.build(0.001, 1ms).run();
  CHECK(log == Log{"b", "d", "a.", "c.", "b.", "d."});
}

TEST_CASE("with Gauss-Seidel a unit begins when those that feed it are done") {
  ScriptedSystem system;
  Log log;
  for (const char* name : {"a", "b", "c", "d"}) add(system, name, true, log);
  system.wire("a", "y", "b", "u");
  system.wire("a", "y", "c", "u");
  system.wire("c", "y", "d", "u");
  system.options.coupling = Coupling::GaussSeidel;
  system.build(0.001, 1ms).run();
  CHECK(log == Log{"a", "a.", "b", "c", "b.", "c.", "d", "d."});
}

TEST_CASE("units that must not step at the same time step one after another") {
  ScriptedSystem system;
  Log log;
  for (const char* name : {"a", "b", "c"}) add(system, name, true, log);
  system.options.threads.main_only = {0, 1};
  system.build(0.001, 1ms).run();
  CHECK(log == Log{"c", "a.", "b.", "c."});
}

TEST_CASE("of several failures that of the first unit is reported, wherever they step") {
  for (unsigned concurrent = 0; concurrent < 8; ++concurrent) {
    CAPTURE(concurrent);
    ScriptedSystem system;
    Log log;
    for (const char* name : {"a", "b", "c"}) {
      const bool is_concurrent = (concurrent >> system.units.size()) % 2 == 1;
      ScriptedUnit& unit = add(system, name, is_concurrent, log);
      if (*name != 'a') make_fail(unit, name);
    }
    CHECK_THAT(failure(system.build(0.01, 1ms)), Contains("unit 'b', at 0.001 s: it broke"));
    const auto& units = system.simulation->statistics().units;
    CHECK(std::vector{units[0].steps, units[1].steps, units[2].steps} ==
          std::vector<std::uint64_t>{2, 1, 1});
  }
}

TEST_CASE("a step behind one that has failed is not waited for") {
  ScriptedSystem system;
  Log log;
  const bool is_concurrent = GENERATE(false, true);
  make_fail(add(system, "a", is_concurrent, log), "a");
  const ScriptedUnit& later = add(system, "b", true, log);
  ScriptedUnit& local = add(system, "c", false, log);
  bool is_pending = false;
  local.on_terminate = [&](ScriptedUnit&) { is_pending = later.begun.has_value(); };
  CHECK_THAT(failure(system.build(0.01, 1ms)), Contains("unit 'a', at 0.001 s: it broke"));
  CHECK(is_pending);
}

TEST_CASE("a failure that begins with the step is one of its unit") {
  ScriptedSystem system;
  Log log;
  make_fail(add(system, "a", true, log), "a");
  add(system, "b", true, log).on_begin_step = [](ScriptedUnit& unit) {
    if (unit.begun->from == Time(1ms)) fail_run({{}, "b", {}, Time(1ms)}, "it is gone");
  };
  add(system, "c", true, log);
  CHECK_THAT(failure(system.build(0.01, 1ms)), Contains("unit 'a', at 0.001 s: it broke"));
}

TEST_CASE("a state is saved once, before the step, also where inputs change within steps") {
  ScriptedSystem system;
  Log log;
  for (const char* name : {"a", "b"}) {
    ScriptedUnit& unit = add(system, name, true, log, plain().may_return_early());
    unit.on_state = [&log](bool saves) { log.push_back(saves ? "save" : "restore"); };
  }
  const auto extrapolation = GENERATE(Extrapolation::Hold, Extrapolation::Linear);
  system.options.extrapolation = extrapolation;
  system.build(0.001, 1ms).run();
  CHECK(log == Log{"save", "a", "save", "b", "a.", "b."});
  for (const UnitStatistics& unit : system.simulation->statistics().units) CHECK(unit.saves == 1);
}

TEST_CASE("the time of a step is what its unit says, however long it waited to be asked") {
  ScriptedSystem system;
  Log log;
  for (const auto time : {5h, 7h}) {
    add(system, std::to_string(time.count()), true, log).time_of_step = time;
  }
  system.build(0.001, 1ms).run();
  const auto& units = system.simulation->statistics().units;
  CHECK(units[0].step_time / 1h == 5);
  CHECK(units[1].step_time / 1h == 7);
}
