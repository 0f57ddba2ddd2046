#include "master/engine/run/stepping/step_order.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::core {
namespace {

/// A component that keeps its own step stops nobody: others are not called for its steps.
bool may_stop(const Component& component) {
  return !component.keeps_own_step() &&
         (component.may_return_early() || component.description->may_reject);
}

/// Of the units that may stop and have no state of their own, the one that steps when those that
/// can be rolled back have agreed.
std::optional<std::size_t> first_final(const std::vector<Component>& components) {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t i) {
    return std::pair(!components[i].may_return_early(), components[i].has_snapshots);
  };
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!may_stop(components[i]) || components[i].description->can_save_state) continue;
    if (!best || rank(i) < rank(*best)) best = i;
  }
  return best;
}

StepRole role_of(const Component& component, bool is_first_final, const StepPolicyType& policy) {
  const bool may_go_back = policy.controls_error || (may_stop(component) && !is_first_final);
  if (component.can_save_state() && may_go_back) return StepRole::CanRollBack;
  return component.may_return_early() ? StepRole::MayReturnEarly : StepRole::Follows;
}

std::string reason_to_go_back(const Component& component, bool saves_state) {
  if (!saves_state) return "can be rolled back; no other unit may stop, so nothing is saved";
  return component.description->can_save_state
             ? "can be rolled back; its state is saved before each step"
             : "can be rolled back; a snapshot of its process is taken before each step";
}

std::string reason(const Component& component, StepRole role, bool saves_state) {
  const UnitDescription& unit = *component.description;
  if (component.keeps_own_step()) {
    return fmt::format("called each {} s, its own step; nothing waits for it, nothing is saved",
                       to_text(*component.own_step));
  }
  if (role == StepRole::CanRollBack) return reason_to_go_back(component, saves_state);
  if (role == StepRole::Follows && component.can_save_state() && !may_stop(component)) {
    return "never stops: follows the others, so nothing is saved";
  }
  if (component.has_snapshots) {
    return fmt::format(
        "{}; no snapshot needed: it steps after the others have agreed on a time",
        role == StepRole::MayReturnEarly ? "may return early" : "might reject a step");
  }
  if (role == StepRole::MayReturnEarly) {
    return "may return early and cannot be rolled back: what it reaches is final";
  }
  std::string text = "cannot be rolled back; ";
  const bool is_before_fmi3 =
      unit.fmi_version.starts_with("1.") || unit.fmi_version.starts_with("2.");
  if (is_before_fmi3) return text + "might complete a step in part, and discard the rest";
  if (unit.may_return_early) text += "is not allowed to return early; ";
  return text +
         (unit.may_reject ? "does not return early, but might reject a step" : "never stops");
}

std::string early_return_hint(const Component& first, const Component& second) {
  const bool is_second = second.description->allows_snapshots;
  const bool can_any = is_second || first.description->allows_snapshots;
  const std::string& name = is_second || !can_any ? second.name : first.name;
  const std::string snapshots = fmt::format(
      "run one of them in a process of its own, whose snapshots roll it back, <stride:Host "
      "components=\"{}\" snapshots=\"true\"/>, or ",
      name);
  return (can_any ? snapshots : "let one of them ") +
         fmt::format(
             "make its steps to the end, <stride:EarlyReturn components=\"{}\" "
             "allowed=\"false\"/>, or replace it by a unit that can save its state "
             "(canGetAndSetFMUState)",
             name);
}

void check_single(const System& system, const std::vector<StepOrderEntry>& order) {
  std::vector<const Component*> stopping;
  for (const StepOrderEntry& entry : order) {
    if (entry.role != StepRole::MayReturnEarly) continue;
    stopping.push_back(&system.components()[entry.component]);
  }
  if (stopping.size() < 2) return;
  fail_input({},
             fmt::format("'{}' and '{}' may both return early from a step, and neither can be "
                         "rolled back: when one stops, the other may already be too far",
                         stopping[0]->name, stopping[1]->name),
             early_return_hint(*stopping[0], *stopping[1]));
}

/// The components that each component feeds with values that exist between events, too.
std::vector<std::set<std::size_t>> fed_components(const System& system) {
  std::vector<std::set<std::size_t>> fed(system.components().size());
  for (const Connection& connection : system.connections()) {
    const bool feeds = connection.from.component != connection.to.component &&
                       !system.variable(connection.from).is_clocked();
    if (feeds) fed[connection.from.component].insert(connection.to.component);
  }
  return fed;
}

/// Kahn's topological sort of the entries of one role; where all that are left wait for each other,
/// the first of them goes on.
void sort_along_connections(const std::vector<std::set<std::size_t>>& fed,
                            std::span<StepOrderEntry> entries) {
  std::map<std::size_t, std::size_t> position;  // by component
  for (std::size_t i = 0; i < entries.size(); ++i) position[entries[i].component] = i;
  const auto for_each_fed = [&](std::size_t i, auto&& action) {
    for (const std::size_t target : fed[entries[i].component]) {
      if (const auto found = position.find(target); found != position.end()) action(found->second);
    }
  };
  std::vector<std::size_t> sources(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for_each_fed(i, [&](std::size_t target) { ++sources[target]; });
  }
  std::set<std::pair<bool, std::size_t>> left;  // those without open sources first
  for (std::size_t i = 0; i < entries.size(); ++i) left.insert({sources[i] > 0, i});
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
  std::vector<StepOrderEntry> sorted;
  for (const std::size_t i : order) sorted.push_back(entries[i]);
  std::move(sorted.begin(), sorted.end(), entries.begin());
}

void sort_along_connections(const System& system, std::vector<StepOrderEntry>& order) {
  const auto fed = fed_components(system);
  for (auto first = order.begin(); first != order.end();) {
    const auto end = std::find_if(first, order.end(), [&](const StepOrderEntry& entry) {
      return entry.role != first->role || entry.keeps_own_step != first->keeps_own_step;
    });
    sort_along_connections(fed, {first, end});
    first = end;
  }
}

void form_stages(const System& system, std::vector<StepOrderEntry>& order) {
  std::size_t stage = 0;
  bool stage_may_stop = false;
  for (StepOrderEntry& entry : order) {
    const bool is_final = entry.role != StepRole::CanRollBack || entry.keeps_own_step;
    if (is_final && stage_may_stop) {
      ++stage;
      stage_may_stop = false;
    }
    entry.stage = stage;
    stage_may_stop |= may_stop(system.components()[entry.component]);
  }
}

/// As large as the order allows.
void form_batches(const System& system, std::vector<StepOrderEntry>& order) {
  const auto fed = fed_components(system);
  auto first = order.begin();  // of the batch
  for (auto entry = order.begin(); entry != order.end(); ++entry) {
    const bool is_same_stage = first->stage == entry->stage;
    const bool is_wired = std::any_of(first, entry, [&](const StepOrderEntry& other) {
      return fed[other.component].contains(entry->component) ||
             fed[entry->component].contains(other.component);
    });
    if (is_same_stage) entry->batch = first->batch + (is_wired ? 1 : 0);
    if (!is_same_stage || is_wired) first = entry;
  }
}

}  // namespace

std::vector<StepOrderEntry> step_order(const System& system, const StepPolicyType& policy,
                                       Coupling coupling) {
  const auto& components = system.components();
  const std::optional<std::size_t> final = first_final(components);
  const std::ptrdiff_t stopping = std::ranges::count_if(components, may_stop);
  std::vector<StepOrderEntry> order;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const UnitDescription& unit = *components[i].description;
    const StepRole role = role_of(components[i], i == final, policy);
    const std::ptrdiff_t others = stopping - (may_stop(components[i]) ? 1 : 0);
    const bool saves_state = role == StepRole::CanRollBack && (policy.controls_error || others > 0);
    const bool keeps = components[i].keeps_own_step();
    order.push_back({i, role, unit.can_vary_step, saves_state,
                     reason(components[i], role, saves_state), keeps});
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](const StepOrderEntry& a, const StepOrderEntry& b) {
                     if (a.role != b.role) return a.role < b.role;
                     if (a.keeps_own_step != b.keeps_own_step) return b.keeps_own_step;
                     if (a.role != StepRole::Follows) return false;
                     // the first of them can still reject, since nothing final has happened before
                     // it
                     return components[a.component].description->may_reject &&
                            !components[b.component].description->may_reject;
                   });
  check_single(system, order);
  if (coupling == Coupling::GaussSeidel) sort_along_connections(system, order);
  form_stages(system, order);
  if (coupling == Coupling::GaussSeidel) form_batches(system, order);
  return order;
}

std::vector<std::size_t> missing_snapshots(std::span<const ComponentDeclaration> components,
                                           const StepPolicyType& policy,
                                           std::span<const SnapshotProcess> processes) {
  const bool all_go_back = policy.controls_error;
  std::vector<std::size_t> lacking;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const UnitDescription& unit = *components[i].description;
    if (!all_go_back && !components[i].may_return_early()) continue;
    if (!unit.can_save_state && !components[i].has_snapshots) lacking.push_back(i);
  }
  if (!all_go_back && !lacking.empty()) {
    lacking.erase(
        std::ranges::min_element(lacking, {}, [&](std::size_t i) { return processes[i]; }));
  }
  std::erase_if(lacking, [&](std::size_t i) { return processes[i] == SnapshotProcess::None; });
  return lacking;
}

}  // namespace stride::core
