#include "master/scenario/interventions.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "master/algorithm/loops/evaluation_order.h"
#include "master/scenario/find_variable.h"
#include "master/util/diagnostics.h"
#include "master/util/time_text.h"

namespace stride::scenario {
namespace {

using core::Intervention;
using InterventionKind = Intervention::Kind;

constexpr const char* kSetForm = "COMPONENT.VARIABLE=VALUE@TIME";
constexpr const char* kForceForm = "COMPONENT.VARIABLE[=VALUE]@FROM..[UNTIL]";

[[noreturn]] void fail_form(const char* option, const std::string& text, const char* form) {
  core::fail_input({}, fmt::format("{} {}: expected {}", option, text, form));
}

Time parse_time(const char* option, const std::string& text, const std::string& seconds) {
  try {
    return Time(core::parse_seconds(seconds));
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({}, fmt::format("{} {}: {}", option, text, mistake.what()));
  }
}

/// What is before the last '@', and behind it: a value may contain one.
std::pair<std::string, std::string> split_time(const char* option, const std::string& text,
                                               const char* form) {
  const std::size_t sign = text.rfind('@');
  if (sign == std::string::npos) fail_form(option, text, form);
  return {text.substr(0, sign), text.substr(sign + 1)};
}

core::Context context_of(const core::System& system, core::VariableId id,
                         const core::Location& where) {
  return {where, system.components()[id.component].name, system.variable(id).name, {}};
}

/// The inputs that algebraic loops are solved with.
std::set<core::VariableId> inputs_of_loops(const core::System& system) {
  std::set<core::VariableId> inputs;
  for (const core::EvaluationBlock& block : core::evaluation_order(system, core::Phase::Events)) {
    if (block.is_loop()) inputs.insert(block.inputs.begin(), block.inputs.end());
  }
  return inputs;
}

/// Why the variable cannot be changed so, and what to do instead; empty if it can.
struct Refusal {
  std::string reason, hint;
};

Refusal refusal_to_set(const core::System& system, core::VariableId id) {
  const core::Variable& variable = system.variable(id);
  if (variable.causality == core::Causality::Input) {
    const auto connections = system.connections_to(id);
    if (connections.empty()) return {};
    return {fmt::format("is fed by '{}', so a value would be overwritten",
                        system.full_name(connections.front().from)),
            "force it for some time: <stride:Force>, --force"};
  }
  if (variable.causality == core::Causality::StructuralParameter) {
    return {"is a structural parameter, which has its value before the run", "use --set"};
  }
  if (variable.causality != core::Causality::Parameter) {
    return {"is computed by the unit", "change a tunable parameter or an input of it"};
  }
  if (variable.variability == core::Variability::Tunable) return {};
  return {"is a fixed parameter, which has its value before the run",
          "use --set, or a unit whose parameter is tunable"};
}

Refusal refusal_to_force(const core::System& system, core::VariableId id) {
  const core::Variable& variable = system.variable(id);
  if (variable.causality != core::Causality::Input) {
    return {"is not an input", "force the inputs that it is connected to"};
  }
  if (system.connections_to(id).empty()) {
    return {"is not connected", "set it: <stride:Set>, --set-at"};
  }
  if (!system.unconnected_elements(id).empty()) {
    return {"has elements that are not connected", "connect all of them, or none"};
  }
  if (inputs_of_loops(system).contains(id)) {
    return {"is in an algebraic loop, which is solved for it",
            "force an input outside of the loop"};
  }
  return {};
}

Refusal refusal(const core::System& system, InterventionKind kind, core::VariableId id) {
  if (!system.is_signal(id) || system.is_sampled(id)) {
    return {"belongs to a clock, and changes at its ticks only", "choose a variable without one"};
  }
  return kind == InterventionKind::Set ? refusal_to_set(system, id) : refusal_to_force(system, id);
}

void check_times(const InterventionDeclaration& declared, const core::Context& context,
                 const RunTimes& times) {
  for (const std::optional<Time> time : {std::optional(declared.from), declared.until}) {
    if (!time || (times.start <= *time && *time <= times.stop)) continue;
    core::fail_input(
        context, fmt::format("{} s is outside of the run, from {} s to {} s", core::to_text(*time),
                             core::to_text(times.start), core::to_text(times.stop)));
  }
  if (declared.until && *declared.until <= declared.from) {
    core::fail_input(context,
                     fmt::format("it would end at {} s, and begins at {} s",
                                 core::to_text(*declared.until), core::to_text(declared.from)));
  }
}

Intervention resolve(const core::System& system, const InterventionDeclaration& declared,
                     const RunTimes& times) {
  const core::VariableId id =
      find_variable(system, declared.variable, declared.where, "a variable of a component",
                    [](const auto&, const auto&) { return true; });
  const core::Context context = context_of(system, id, declared.where);
  if (const auto [reason, hint] = refusal(system, declared.kind, id); !reason.empty()) {
    core::fail_input(context,
                     fmt::format("it cannot be {}, since it {}",
                                 declared.kind == InterventionKind::Set ? "set" : "forced", reason),
                     hint);
  }
  check_times(declared, context, times);
  Intervention intervention{declared.kind, id, declared.from, declared.until, std::nullopt};
  if (declared.kind == InterventionKind::Hold) return intervention;
  try {
    intervention.value = core::parse(system.variable(id), declared.value);
  } catch (const std::invalid_argument& mistake) {
    core::fail_input(context, mistake.what());
  }
  return intervention;
}

bool contradict(const Intervention& one, const Intervention& other) {
  if (one.id != other.id) return false;
  if (one.kind == InterventionKind::Set) return one.from == other.from;
  const auto end = [](const Intervention& intervention) {
    return intervention.until.value_or(Time::max());
  };
  return one.from < end(other) && other.from < end(one);
}

/// Interventions with where they were written, in the order of their instants.
using Resolved = std::vector<std::pair<Intervention, core::Location>>;

void check_contradictions(const core::System& system, const Resolved& resolved) {
  std::map<core::VariableId, const Resolved::value_type*> latest;
  for (const auto& entry : resolved) {
    const auto& [intervention, where] = entry;
    const auto [place, is_first] = latest.emplace(intervention.id, &entry);
    if (is_first) continue;
    const auto& [earlier, earlier_where] = *place->second;
    if (contradict(earlier, intervention)) {
      core::fail_input(context_of(system, intervention.id, where),
                       fmt::format("another intervention, from {} s on, contradicts this one, from "
                                   "{} s on",
                                   core::to_text(earlier.from), core::to_text(intervention.from)),
                       "let the first one end before the second begins, or leave one of them out");
    }
    place->second = &entry;
  }
}

}  // namespace

InterventionDeclaration parse_set_at(const std::string& text) {
  constexpr const char* kOption = "--set-at";
  const auto [assignment, time] = split_time(kOption, text, kSetForm);
  const std::size_t sign = assignment.find('=');
  if (sign == std::string::npos || sign == 0) fail_form(kOption, text, kSetForm);
  return {.kind = InterventionKind::Set,
          .variable = assignment.substr(0, sign),
          .value = assignment.substr(sign + 1),
          .from = parse_time(kOption, text, time),
          .where = {fmt::format("{} {}", kOption, text), 0}};
}

InterventionDeclaration parse_force(const std::string& text) {
  constexpr const char* kOption = "--force";
  const auto [assignment, times] = split_time(kOption, text, kForceForm);
  const std::size_t dots = times.find("..");
  const std::size_t sign = assignment.find('=');
  if (dots == std::string::npos || assignment.empty() || sign == 0) {
    fail_form(kOption, text, kForceForm);
  }
  InterventionDeclaration declared{
      .kind = sign == std::string::npos ? InterventionKind::Hold : InterventionKind::Force,
      .variable = assignment.substr(0, sign),
      .value = sign == std::string::npos ? "" : assignment.substr(sign + 1),
      .from = parse_time(kOption, text, times.substr(0, dots)),
      .where = {fmt::format("{} {}", kOption, text), 0}};
  const std::string until = times.substr(dots + 2);
  if (!until.empty()) declared.until = parse_time(kOption, text, until);
  return declared;
}

std::vector<core::Intervention> resolve_interventions(
    const core::System& system, std::span<const InterventionDeclaration> declarations,
    const RunTimes& times) {
  Resolved resolved;
  core::Diagnostics diagnostics;
  for (const InterventionDeclaration& declared : declarations) {
    diagnostics.attempt(
        [&] { resolved.emplace_back(resolve(system, declared, times), declared.where); });
  }
  diagnostics.raise();
  std::ranges::stable_sort(resolved, {}, [](const auto& entry) { return entry.first.from; });
  check_contradictions(system, resolved);
  std::vector<core::Intervention> interventions;
  for (auto& entry : resolved) interventions.push_back(std::move(entry.first));
  return interventions;
}

}  // namespace stride::scenario
