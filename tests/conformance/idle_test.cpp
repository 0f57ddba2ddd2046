// What <stride/idle.h> promises an importer. A unit without its manifest has nothing to keep, but
// must not be asked in vain.
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "master/base/error.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "tests/property/promise.h"

namespace {

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

const std::shared_ptr<importer::Fmu>& fmu() {
  static const std::shared_ptr<importer::Fmu> fmu = [] {
    const char* const path = std::getenv("STRIDE_FMU");
    if (path == nullptr) throw std::runtime_error("name the unit in STRIDE_FMU");
    return importer::Fmu::load(path);
  }();
  return fmu;
}

bool promises() { return fmu()->description()->promises_idle; }

/// Instants at which a unit is asked: at once, soon, and later.
constexpr Duration kInstants[] = {0ms, 1ms, 7ms, 30ms, 200ms};

SteppedUnit stepped_to(Duration instant, std::optional<Duration> max_skip) {
  SteppedUnit stepped(fmu(), {}, max_skip);
  stepped.advance(Time(instant), 1ms);
  return stepped;
}

}  // namespace

TEST_CASE("a unit that never promises refuses to skip") {
  if (promises()) return;
  CHECK(fmu()->instantiate("unit", {})->capability<core::IdlePromises>() == nullptr);
  const auto& enable = fmu()->load_fmi3_library()->idle_functions().EnableIdleSkipping;
  CHECK((enable == nullptr || enable(nullptr, 1.0) == fmi3Error));
}

TEST_CASE("nothing is promised unless skipping is enabled") {
  if (!promises()) return;
  const auto library = fmu()->load_fmi3_library();
  const auto& fmi = library->functions();
  const auto& description = *fmu()->description();
  const auto root = library->path().parent_path().parent_path().parent_path();
  const std::string resources = importer::resource_path(root / "resources");
  fmi3Instance const unit = fmi.InstantiateCoSimulation(
      "unit", description.instantiation_token.c_str(),
      resources.empty() ? nullptr : resources.c_str(), false, false, description.has_event_mode,
      false, nullptr, 0, nullptr, nullptr, nullptr);
  REQUIRE(unit != nullptr);
  CHECK(fmi.EnterInitializationMode(unit, false, 0, 2.5, false, 0) == fmi3OK);
  CHECK(fmi.ExitInitializationMode(unit) == fmi3OK);
  if (description.has_event_mode) CHECK(fmi.EnterStepMode(unit) == fmi3OK);
  double until = std::numeric_limits<double>::infinity();
  CHECK(library->idle_functions().GetIdlePromise(unit, &until) == fmi3OK);
  CHECK(until <= 2.5);
  fmi.FreeInstance(unit);
}

TEST_CASE("what is promised is kept, in one step or in many") {
  if (!promises() || fmu()->description()->single_instance) return;
  std::uint64_t seed = 0;
  for (const Duration instant : kInstants) {
    CAPTURE(instant.count());
    PromiseCheck check{stepped_to(instant, Duration::max()), stepped_to(instant, Duration::max()),
                       stepped_to(instant, std::nullopt), ++seed};
    check.until = Time(instant + 1s);
    Time promised{};
    CHECK(check.run(promised) == "");
  }
}

TEST_CASE("no promise is longer than maxSkip") {
  if (!promises()) return;
  for (const Duration max_skip : {Duration(1), Duration(3us), Duration(20ms)}) {
    for (const Duration instant : kInstants) {
      CAPTURE(max_skip.count(), instant.count());
      SteppedUnit stepped = stepped_to(instant, max_skip);
      CHECK(stepped.promise() <= Time(instant + max_skip));
    }
  }
}

TEST_CASE("a step over the whole promise goes through, again and again") {
  if (!promises()) return;
  SteppedUnit stepped(fmu(), {}, 50ms);
  for (int i = 0; i < 20; ++i) {
    const Time begin = stepped.now();
    const Time until = stepped.promise();
    if (until > begin) {
      const core::StepResult result = stepped.step(until);
      CHECK_FALSE(result.rejected);
      CHECK_FALSE(result.early_return);
      CHECK(stepped.now() == until);
      if (result.event_handling_needed) stepped.handle_event();
    } else {
      stepped.advance(begin + 1ms, 1ms);
    }
  }
}

TEST_CASE("a restored state promises what the saved one did") {
  if (!promises() || !fmu()->description()->can_save_state) return;
  for (const Duration instant : kInstants) {
    CAPTURE(instant.count());
    SteppedUnit stepped = stepped_to(instant, 10s);
    const Time promised = stepped.promise();
    state(stepped.unit()).save_state();
    stepped.advance(stepped.now() + 20ms, 3ms);
    state(stepped.unit()).restore_state();
    CHECK(std::max(Time(instant), idle(stepped.unit()).idle_until()) == promised);
  }
}
