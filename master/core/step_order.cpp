#include "master/core/step_order.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace stride::core {
namespace {

bool may_stop(const Component& component) {
  return component.may_return_early() || component.description->may_reject;
}

StepRole role_of(const Component& component, StepPolicy policy) {
  const bool may_go_back = may_stop(component) || policy == StepPolicy::ErrorControlled;
  if (component.can_save_state() && may_go_back) return StepRole::CanRollBack;
  return component.may_return_early() ? StepRole::MayStopEarly : StepRole::DoesAsTold;
}

std::string reason(const Component& component, StepRole role, bool saves_state) {
  switch (role) {
    case StepRole::CanRollBack:
      return saves_state ? "can be rolled back; its state is saved before each step"
                         : "can be rolled back; no other unit may stop, so nothing is saved";
    case StepRole::MayStopEarly:
      return "may return early and cannot be rolled back: what it reaches is final";
    case StepRole::DoesAsTold:
      break;
  }
  const UnitDescription& unit = *component.description;
  if (component.can_save_state()) return "never stops: follows the others, so nothing is saved";
  std::string text = "cannot be rolled back; ";
  if (unit.may_return_early) text += "is not allowed to return early; ";
  return text + (unit.may_reject ? "does not return early, but might reject a step"
                                 : "does as it is told");
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
             fmt::format("let one of them make its steps to the end, <stride:EarlyReturn "
                         "components=\"{}\" allowed=\"false\"/>, or replace it by a unit that can "
                         "save its state (canGetAndSetFMUState)",
                         names[1]));
}

/// Whom each component feeds with values that exist between events too.
std::vector<std::set<std::size_t>> fed_components(const System& system) {
  std::vector<std::set<std::size_t>> fed(system.components().size());
  for (const Connection& connection : system.connections()) {
    const bool feeds = connection.from.component != connection.to.component &&
                       !system.variable(connection.from).is_clocked();
    if (feeds) fed[connection.from.component].insert(connection.to.component);
  }
  return fed;
}

/// Kahn's topological sort of the places of one role; where all that are left wait for each other,
/// the first of them goes on.
void sort_along_connections(const std::vector<std::set<std::size_t>>& fed,
                            std::span<StepPlace> places) {
  std::map<std::size_t, std::size_t> position;  // by component
  for (std::size_t i = 0; i < places.size(); ++i) position[places[i].component] = i;
  const auto for_each_fed = [&](std::size_t i, auto&& action) {
    for (const std::size_t target : fed[places[i].component]) {
      if (const auto found = position.find(target); found != position.end()) action(found->second);
    }
  };
  std::vector<std::size_t> sources(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for_each_fed(i, [&](std::size_t target) { ++sources[target]; });
  }
  std::set<std::pair<bool, std::size_t>> left;  // those that wait for nobody first
  for (std::size_t i = 0; i < places.size(); ++i) left.insert({sources[i] > 0, i});
  std::vector<std::size_t> order;
  while (!left.empty()) {
    const std::size_t next = left.extract(left.begin()).value().second;
    order.push_back(next);
    for_each_fed(next, [&](std::size_t target) {
      if (left.erase({sources[target] > 0, target}) == 0) return;
      --sources[target];
      left.insert({sources[target] > 0, target});
    });
  }
  std::vector<StepPlace> sorted;
  for (const std::size_t i : order) sorted.push_back(places[i]);
  std::move(sorted.begin(), sorted.end(), places.begin());
}

void sort_along_connections(const System& system, std::vector<StepPlace>& order) {
  const auto fed = fed_components(system);
  for (auto first = order.begin(); first != order.end();) {
    const auto end = std::find_if(
        first, order.end(), [&](const StepPlace& place) { return place.role != first->role; });
    sort_along_connections(fed, {first, end});
    first = end;
  }
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
    stage_may_stop |= may_stop(system.components()[place.component]);
  }
}

}  // namespace

std::vector<StepPlace> step_order(const System& system, StepPolicy policy, Coupling coupling) {
  const auto& components = system.components();
  std::vector<StepPlace> order;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const UnitDescription& unit = *components[i].description;
    const StepRole role = role_of(components[i], policy);
    bool another_may_stop = policy == StepPolicy::ErrorControlled;
    for (std::size_t k = 0; k < components.size(); ++k) {
      another_may_stop |= k != i && may_stop(components[k]);
    }
    const bool saves_state = role == StepRole::CanRollBack && another_may_stop;
    order.push_back(
        {i, role, unit.can_vary_step, saves_state, reason(components[i], role, saves_state), 0});
  }
  std::stable_sort(order.begin(), order.end(), [&](const StepPlace& a, const StepPlace& b) {
    if (a.role != b.role) return a.role < b.role;
    if (a.role != StepRole::DoesAsTold) return false;
    // the first to be asked can still reject, since nothing final has happened before it
    return components[a.component].description->may_reject &&
           !components[b.component].description->may_reject;
  });
  check_single(system, order);
  if (coupling == Coupling::GaussSeidel) sort_along_connections(system, order);
  form_stages(system, order);
  return order;
}

}  // namespace stride::core
