// A million steps: no drift, no rejection, an exact end.
#include <cmath>

#include <catch2/catch.hpp>
#include <dlfcn.h>

#include "tests/master/loader/fmu/support.h"
#include "tests/property/assembly.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const std::int64_t kSteps = kSanitized ? 20'000 : 1'000'000;

/// Sets the only step size that the instance of the library accepts.
void set_raw_step(importer::Fmu& fmu, Duration step) {
  void* const handle = dlopen(fmu.load_library()->path().c_str(), RTLD_NOW | RTLD_NOLOAD);
  REQUIRE(handle != nullptr);
  *static_cast<long long*>(dlsym(handle, "raw_step")) = step.count();
  dlclose(handle);
}

struct LastPoint : core::Observer {
  Time time{};
  std::int64_t count = -1;  // the first one is the start
  void on_communication_point(Time now) override {
    time = now;
    ++count;
  }
};

core::RunStatistics run_beside(const Assembly& system, Duration step, Time stop, LastPoint& last) {
  const core::System checked(system.declaration());
  core::Simulation simulation(checked, system.instantiate(), fixed_steps(step, stop));
  simulation.add_observer(last);
  simulation.run();
  return simulation.statistics();
}

}  // namespace

TEST_CASE("a million steps lead exactly to the end, for a unit that accepts one step size only") {
  const Duration step = GENERATE(Duration(1ms), Duration(333'333'333));
  const Scratch scratch;
  const auto raw = importer::Fmu::load(make_raw_fmu(scratch, "raw"));
  set_raw_step(*raw, step);
  Assembly system;
  system.add("insists", raw);
  system.add("a", "linear").add("b", "linear").wire("a.x", "b.u").wire("b.x", "a.u");
  LastPoint last;
  const Time stop(kSteps * step);
  const core::RunStatistics statistics = run_beside(system, step, stop, last);
  CHECK(last.time == stop);
  CHECK(last.count == kSteps);
  CHECK(statistics.reached == stop);
  for (const core::UnitStatistics& unit : statistics.units) {
    CHECK(unit.steps == static_cast<std::uint64_t>(kSteps));
    CHECK(unit.rejections == 0);
    CHECK(unit.rollbacks == 0);
  }
}

TEST_CASE("the unit that accepts one step size only does reject another") {
  const Scratch scratch;
  const auto raw = importer::Fmu::load(
      make_raw_fmu(scratch, "raw", "canHandleVariableCommunicationStepSize=\"true\""));
  set_raw_step(*raw, 1ms);
  Assembly system;
  system.add("insists", raw);
  LastPoint last;
  CHECK_THROWS_WITH(run_beside(system, 1ms, Time(2500us), last),
                    Catch::Contains("rejected the step"));
  CHECK(last.time == Time(2ms));
}

TEST_CASE("a hundred thousand irrational instants are met to the picosecond") {
  const int kTicks = kSanitized ? 2'000 : 100'000;
  const Assembly system = Assembly()
                              .add("ticker", "ticker", {{"period", "0.0001"}, {"announces", "0"}})
                              .add("listener", "listener")
                              .wire_message("ticker.tick", "listener.message");
  const Time stop = time_from_seconds((kTicks + 0.5) * std::sqrt(2.0) * 1e-4);
  const Results results = run(system, 1ms, stop);
  CHECK(results.value(stop, "listener.received") == kTicks);
  CHECK(results.value(stop, "listener.misplaced") == 0);
  CHECK(results.value(stop, "listener.out_of_turn") == 0);
}
