#include "master/core/step_order.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::core {
namespace {

StepRole role_of(const UnitDescription& unit) {
  if (unit.can_save_state) return StepRole::CanRollBack;
  return unit.may_return_early ? StepRole::MayStopEarly : StepRole::DoesAsTold;
}

bool may_stop(const UnitDescription& unit) { return unit.may_return_early || unit.may_reject; }

std::string reason(const UnitDescription& unit, StepRole role, bool saves_state) {
  switch (role) {
    case StepRole::CanRollBack:
      return saves_state ? "can be rolled back; its state is saved before each step"
                         : "can be rolled back; no other unit may stop, so nothing is saved";
    case StepRole::MayStopEarly:
      return "may return early and cannot be rolled back: what it reaches is final";
    case StepRole::DoesAsTold:
      break;
  }
  return unit.may_reject ? "cannot be rolled back; does not return early, but might reject a step"
                         : "cannot be rolled back; does as it is told";
}

void check_single(const System& system, const std::vector<StepPlace>& order) {
  std::vector<std::string> names;
  for (const StepPlace& place : order) {
    if (place.role == StepRole::MayStopEarly) {
      names.push_back(system.components()[place.component].name);
    }
  }
  if (names.size() < 2) return;
  fail_input({},
             fmt::format("'{}' and '{}' may both return early from a step, and neither can be "
                         "rolled back: when one stops, the other may already be too far",
                         names[0], names[1]),
             "use a unit that can save its state (canGetAndSetFMUState) in place of one of them");
}

void form_stages(const System& system, std::vector<StepPlace>& order) {
  std::size_t stage = 0;
  bool stage_may_stop = false;
  for (StepPlace& place : order) {
    if (place.role != StepRole::CanRollBack && stage_may_stop) {
      ++stage;
      stage_may_stop = false;
    }
    place.stage = stage;
    stage_may_stop |= may_stop(*system.components()[place.component].description);
  }
}

}  // namespace

std::vector<StepPlace> step_order(const System& system) {
  const auto& components = system.components();
  std::vector<StepPlace> order;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const UnitDescription& unit = *components[i].description;
    const StepRole role = role_of(unit);
    bool another_may_stop = false;
    for (std::size_t k = 0; k < components.size(); ++k) {
      another_may_stop |= k != i && may_stop(*components[k].description);
    }
    const bool saves_state = role == StepRole::CanRollBack && another_may_stop;
    order.push_back({i, role, unit.can_vary_step, saves_state, reason(unit, role, saves_state), 0});
  }
  std::stable_sort(order.begin(), order.end(), [&](const StepPlace& a, const StepPlace& b) {
    if (a.role != b.role) return a.role < b.role;
    if (a.role != StepRole::DoesAsTold) return false;
    // the first to be asked can still reject, since nothing final has happened before it
    return components[a.component].description->may_reject &&
           !components[b.component].description->may_reject;
  });
  check_single(system, order);
  form_stages(system, order);
  return order;
}

}  // namespace stride::core
