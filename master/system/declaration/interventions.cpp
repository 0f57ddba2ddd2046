#include "master/system/declaration/interventions.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/diagnostics.h"
#include "master/base/parse_option.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"
#include "master/engine/model/finite.h"
#include "master/engine/run/loops/evaluation_order.h"
#include "master/system/declaration/find_variable.h"

namespace stride::scenario {
namespace {

using core::Intervention;
using InterventionKind = Intervention::Kind;

constexpr const char* kSetForm = "COMPONENT.VARIABLE=VALUE@TIME";
constexpr const char* kForceForm = "COMPONENT.VARIABLE[=VALUE]@FROM..[UNTIL]";
constexpr const char* kDropForm = "COMPONENT.VARIABLE@FROM..[UNTIL]";
constexpr const char* kDelayForm = "COMPONENT.VARIABLE=SECONDS@FROM..[UNTIL]";
constexpr const char* kCorruptForm = "COMPONENT.VARIABLE[=BITS[,HEADER[,SEED]]]@FROM..[UNTIL]";

[[noreturn]] void fail_form(const char* option, const std::string& text, const char* form,
                            const std::string& hint = "") {
  core::fail_input({}, fmt::format("{} {}: expected {}", option, text, form), hint);
}

Time parse_time(const char* option, const std::string& text, const std::string& seconds) {
  return core::parse_option(option, text, [&](const auto&) { return core::parse_time(seconds); });
}

/// What is before the last '@', and behind it: a value may contain one.
std::pair<std::string, std::string> split_time(const char* option, const std::string& text,
                                               const char* form) {
  const std::size_t sign = text.rfind('@');
  if (sign == std::string::npos) fail_form(option, text, form);
  return {text.substr(0, sign), text.substr(sign + 1)};
}

/// The form that all but --set-at have in common, without the kind.
InterventionDeclaration parse_from_until(const char* option, const std::string& text,
                                         const char* form, const core::KnownNames& names) {
  const auto [assignment, times] = split_time(option, text, form);
  const std::size_t dots = times.find("..");
  if (dots == std::string::npos) {
    fail_form(
        option, text, form,
        fmt::format("write {} {}.. for a time without an end, or {}..UNTIL", option, text, text));
  }
  auto [variable, value] = names.split(option, assignment, true);
  if (variable.empty()) fail_form(option, text, form);
  InterventionDeclaration declared{.variable = std::move(variable),
                                   .value = std::move(value),
                                   .from = parse_time(option, text, times.substr(0, dots)),
                                   .where = {fmt::format("{} {}", option, text), 0}};
  const std::string until = times.substr(dots + 2);
  if (!until.empty()) declared.until = parse_time(option, text, until);
  return declared;
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

Refusal refusal_to_change(const core::System& system, InterventionKind kind, core::VariableId id) {
  if (system.is_message(id)) {
    return {"is a message", "disturb it: <stride:Drop>, <stride:Delay>, <stride:Corrupt>"};
  }
  if (!system.is_signal(id) || system.is_sampled(id)) {
    return {"belongs to a clock, and changes at its ticks only", "choose a variable without one"};
  }
  return kind == InterventionKind::Set ? refusal_to_set(system, id) : refusal_to_force(system, id);
}

/// The clocks with which the input receives messages: itself, or the connected ones to which it
/// belongs.
std::vector<core::VariableId> clocks_of(const core::System& system, core::VariableId id) {
  std::vector<core::VariableId> clocks;
  const auto add = [&](core::VariableId clock) {
    if (!system.connections_to(clock).empty()) clocks.push_back(clock);
  };
  const core::Variable& variable = system.variable(id);
  if (variable.type == core::ValueType::Clock) {
    add(id);
    return clocks;
  }
  for (const core::ValueReference clock : variable.clocks) {
    add({id.component, *system.components()[id.component].description->find(clock)});
  }
  return clocks;
}

/// Whether Binary values are received in it, or with it.
bool has_bits(const core::System& system, core::VariableId id) {
  const core::Variable& variable = system.variable(id);
  if (variable.type != core::ValueType::Clock) return variable.type == core::ValueType::Binary;
  const auto& variables = system.components()[id.component].description->variables;
  return std::ranges::any_of(variables, [&](const core::Variable& other) {
    return other.type == core::ValueType::Binary && other.belongs_to(variable.reference) &&
           other.causality == core::Causality::Input;
  });
}

Refusal refusal_to_disturb(const core::System& system, InterventionKind kind, core::VariableId id) {
  const core::Variable& variable = system.variable(id);
  const bool is_clock = variable.type == core::ValueType::Clock;
  if (variable.causality != core::Causality::Input || (!is_clock && !system.is_message(id))) {
    return {"receives no messages",
            "choose an input clock, or an input that belongs to a triggered clock"};
  }
  const std::size_t clocks = clocks_of(system, id).size();
  if (clocks == 0 || (!is_clock && system.connections_to(id).empty())) {
    return {"is not connected", "choose an input that receives messages"};
  }
  if (clocks > 1) return {"belongs to more than one connected clock", "choose one of its clocks"};
  if (kind == InterventionKind::Corrupt && !has_bits(system, id)) {
    return {"receives no Binary values", "drop or delay its messages"};
  }
  return {};
}

Refusal refusal(const core::System& system, InterventionKind kind, core::VariableId id) {
  return disturbs_messages(kind) ? refusal_to_disturb(system, kind, id)
                                 : refusal_to_change(system, kind, id);
}

const char* participle(InterventionKind kind) {
  if (kind == InterventionKind::Set) return "set";
  return disturbs_messages(kind) ? "disturbed" : "forced";
}

void require_changeable(const core::System& system, InterventionKind kind, core::VariableId id,
                        const core::Context& context) {
  const auto [reason, hint] = refusal(system, kind, id);
  if (reason.empty()) return;
  core::fail_input(context, fmt::format("it cannot be {}, since it {}", participle(kind), reason),
                   hint);
}

std::size_t parse_count(std::string_view text, const char* of_what) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw std::invalid_argument(
        fmt::format("'{}' is not a number of {}: expected a whole number", text, of_what));
  }
  return count;
}

void read_bits(std::string_view text, Intervention& intervention) {
  const std::size_t comma = text.find(',');
  intervention.bits = parse_count(text.substr(0, comma), "bits");
  if (comma != std::string_view::npos) {
    intervention.header = parse_count(text.substr(comma + 1), "bytes of a header");
  }
  if (intervention.bits == 0) throw std::invalid_argument("0 bits leave messages as they are");
}

void warn_of_odd(const InterventionDeclaration& declared, const core::ValueBlock& value) {
  const std::string place = core::to_text(core::Context{.where = declared.where}) +
                            fmt::format("the value for '{}' from {} s on ", declared.variable,
                                        core::to_text(declared.from));
  if (const auto odd = core::not_finite(value)) {
    spdlog::warn("{}is {}, which is not a finite number", place, *odd);
  } else if (const auto lost = core::lost_number(*declared.value, value)) {
    spdlog::warn("{}{}", place, *lost);
  }
}

/// Throws std::invalid_argument if it is none.
void read_value(const core::System& system, const InterventionDeclaration& declared,
                Intervention& intervention) {
  switch (declared.kind) {
    case InterventionKind::Set:
    case InterventionKind::Force:
      intervention.value = core::parse(system.variable(intervention.id), *declared.value);
      warn_of_odd(declared, *intervention.value);
      return;
    case InterventionKind::Delay:
      intervention.delay = core::parse_seconds(*declared.value);
      if (intervention.delay > Duration{}) break;
      throw std::invalid_argument(fmt::format("a delay of {} s is not above 0 s", *declared.value));
    case InterventionKind::Corrupt:
      read_bits(*declared.value, intervention);
      intervention.seed = declared.seed;
      break;
    case InterventionKind::Hold:
      return;
    case InterventionKind::Drop:
      break;
  }
  intervention.clock = clocks_of(system, intervention.id).front();
}

/// What begins before the run may go on in it.
std::string early_hint(const InterventionDeclaration& declared, const RunTimes& times) {
  const std::string start = core::to_text(declared.from);
  const bool has_rest =
      declared.kind != InterventionKind::Set && (!declared.until || *declared.until > times.start);
  if (has_rest) {
    return fmt::format(
        "let it begin at {} s, where the run does, or start the run (--start) at "
        "{} s or earlier",
        core::to_text(times.start), start);
  }
  return fmt::format("leave it out, or start the run (--start) at {} s or earlier", start);
}

std::string late_hint(const InterventionDeclaration& declared, const RunTimes& times) {
  if (declared.from > times.stop || !declared.until) return times.stop_hint;
  const std::string hint =
      fmt::format("leave the end out for one that lasts: {} s..", core::to_text(declared.from));
  return times.stop_hint.empty() ? hint : hint + "; " + times.stop_hint;
}

void check_times(const InterventionDeclaration& declared, const core::Context& context,
                 const RunTimes& times) {
  for (const std::optional<Time> time : {std::optional(declared.from), declared.until}) {
    if (!time || (times.start <= *time && *time <= times.stop)) continue;
    core::fail_input(
        context,
        fmt::format("{} s is outside of the run, from {} s to {} s", core::to_text(*time),
                    core::to_text(times.start), core::to_text(times.stop)),
        *time < times.start ? early_hint(declared, times) : late_hint(declared, times));
  }
  if (declared.until && *declared.until <= declared.from) {
    core::fail_input(context,
                     fmt::format("it would end at {} s, and begins at {} s",
                                 core::to_text(*declared.until), core::to_text(declared.from)));
  }
}

/// Of a value that cannot be read.
std::string value_hint(const core::System& system, const InterventionDeclaration& declared,
                       core::VariableId id) {
  const std::string text = declared.value.value_or("");
  if (declared.kind == InterventionKind::Delay) {
    return core::number_with_unit_hint(text, {"s", std::nullopt}, true);
  }
  if (declared.kind != InterventionKind::Set && declared.kind != InterventionKind::Force) return "";
  const core::Variable& variable = system.variable(id);
  return core::number_with_unit_hint(text, system.unit_of_measure(id), variable.is_relative);
}

Intervention resolve(const core::System& system, const InterventionDeclaration& declared,
                     const RunTimes& times) {
  const core::VariableId id =
      find_variable(system, declared.variable, declared.where, "a variable of a component",
                    [](const auto&, const auto&) { return true; });
  const core::Context context = context_of(system, id, declared.where);
  require_changeable(system, declared.kind, id, context);
  check_times(declared, context, times);
  Intervention intervention{declared.kind, id, declared.from, declared.until};
  try {
    read_value(system, declared, intervention);
  } catch (const std::invalid_argument& mistake) {
    core::fail_input(context, mistake.what(), value_hint(system, declared, id));
  }
  return intervention;
}

/// What an intervention changes: messages are received with their clock.
core::VariableId changed(const Intervention& intervention) {
  return disturbs_messages(intervention.kind) ? intervention.clock : intervention.id;
}

bool contradict(const Intervention& one, const Intervention& other) {
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
    const auto [place, is_first] = latest.emplace(changed(intervention), &entry);
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

InterventionDeclaration parse_set_at(const std::string& text, const core::KnownNames& names) {
  constexpr const char* kOption = "--set-at";
  const auto [assignment, time] = split_time(kOption, text, kSetForm);
  auto [variable, value] = names.split(kOption, assignment, false);
  if (!value || variable.empty()) fail_form(kOption, text, kSetForm);
  return {.kind = InterventionKind::Set,
          .variable = std::move(variable),
          .value = std::move(value),
          .from = parse_time(kOption, text, time),
          .where = {fmt::format("{} {}", kOption, text), 0}};
}

InterventionDeclaration parse_force(const std::string& text, const core::KnownNames& names) {
  InterventionDeclaration declared = parse_from_until("--force", text, kForceForm, names);
  declared.kind = declared.value ? InterventionKind::Force : InterventionKind::Hold;
  return declared;
}

InterventionDeclaration parse_drop(const std::string& text, const core::KnownNames& names) {
  InterventionDeclaration declared = parse_from_until("--drop", text, kDropForm, names);
  if (declared.value) fail_form("--drop", text, kDropForm);
  declared.kind = InterventionKind::Drop;
  return declared;
}

InterventionDeclaration parse_delay(const std::string& text, const core::KnownNames& names) {
  InterventionDeclaration declared = parse_from_until("--delay", text, kDelayForm, names);
  if (!declared.value) fail_form("--delay", text, kDelayForm);
  declared.kind = InterventionKind::Delay;
  return declared;
}

InterventionDeclaration parse_corrupt(const std::string& text, const core::KnownNames& names) {
  InterventionDeclaration declared = parse_from_until("--corrupt", text, kCorruptForm, names);
  if (!declared.value) declared.value = "1";
  declared.kind = InterventionKind::Corrupt;
  const std::size_t header = declared.value->find(',');
  const std::size_t seed = header == text.npos ? header : declared.value->find(',', header + 1);
  if (seed == text.npos) return declared;
  const auto number = xml::to_number<std::uint64_t>(declared.value->substr(seed + 1));
  if (!number) fail_form("--corrupt", text, kCorruptForm);
  declared.seed = *number;
  declared.value->resize(seed);
  return declared;
}

void require_settable(const core::System& system, core::VariableId id) {
  require_changeable(system, InterventionKind::Set, id, context_of(system, id, {}));
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
