#include "master/engine/run/step_policies/step_size_controller.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "master/base/state_archive.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

constexpr StepSizeController::Range kWide{1ns, 100s};
constexpr double kOrder = 2;

}  // namespace

TEST_CASE("the first step has the requested size") {
  CHECK(StepSizeController(10ms, kOrder).size() == Duration(10ms));
}

TEST_CASE("after an error far below the tolerance the step grows to five times its size at most") {
  StepSizeController controller(10ms, kOrder);
  controller.accept(10ms, 0, kWide);
  CHECK(controller.size() == Duration(50ms));
  SECTION("and not beyond the maximum") {
    controller.accept(50ms, 0, {1ns, 60ms});
    CHECK(controller.size() == Duration(60ms));
  }
}

TEST_CASE("a rejected step is followed by a shorter one, which does not grow at once") {
  StepSizeController controller(10ms, kOrder);
  controller.reject(10ms, 4, 1ns);
  CHECK(to_seconds(controller.size()) == Approx(0.9 * 0.01 / 2));
  const Duration shorter = controller.size();
  controller.accept(shorter, 1e-3, kWide);
  CHECK(controller.size() == shorter);
}

TEST_CASE("no rejection makes a step shorter than a tenth, or than the least") {
  StepSizeController controller(10ms, kOrder);
  SECTION("a tenth") {
    controller.reject(10ms, 1e6, 1ns);
    CHECK(controller.size() == Duration(1ms));
  }
  SECTION("the least") {
    controller.reject(10ms, 1e6, 4ms);
    CHECK(controller.size() == Duration(4ms));
  }
}

TEST_CASE("a step that an event cut short makes the next one no shorter") {
  StepSizeController controller(10ms, kOrder);
  controller.accept(1us, 0.9, kWide);
  CHECK(controller.size() == Duration(10ms));
}

TEST_CASE("a controller that goes on from a state chooses the same steps") {
  StepSizeController controller(10ms, kOrder);
  controller.accept(10ms, 0.3, kWide);
  controller.reject(controller.size(), 4, 1ns);
  StateArchive written;
  controller.persist(written);
  StepSizeController other(1ms, kOrder);
  StateArchive read(written.bytes());
  other.persist(read);
  CHECK(other.size() == controller.size());
  for (const double ratio : {1e-3, 1e-3, 0.5}) {
    controller.accept(controller.size(), ratio, kWide);
    other.accept(other.size(), ratio, kWide);
    CHECK(other.size() == controller.size());
  }
}

TEST_CASE("a controller does not go on from what it cannot have been") {
  const auto is_refused = [](Duration size, double ratio) {
    StateArchive written;
    written.mark("step size");
    written.value(size);
    written.value(ratio);
    bool was_rejected = false;
    written.value(was_rejected);
    StateArchive read(written.bytes());
    StepSizeController controller(1ms, kOrder);
    try {
      controller.persist(read);
    } catch (const BadState&) {
      return true;
    }
    return false;
  };
  CHECK_FALSE(is_refused(1ms, 0.5));
  CHECK(is_refused(0ms, 0.5));
  CHECK(is_refused(-1ms, 0.5));
  CHECK(is_refused(1ms, 0));
  CHECK(is_refused(1ms, 2));
  CHECK(is_refused(1ms, std::nan("")));
}
