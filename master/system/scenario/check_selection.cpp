#include "master/system/scenario/check_selection.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/diagnostics.h"
#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/engine/model/array_element.h"
#include "master/system/scenario/signal_selection.h"

namespace stride::scenario {
namespace {

using checks::Definition;
using checks::Kind;

struct Element {
  const NamedVariable* variable;
  std::size_t element;
  std::string name;
};

class Selection {
 public:
  Selection(const core::System& system, const ScenarioTimes& times)
      : system_(system), times_(times), finder_(system) {}

  std::vector<Definition> select(const CheckDeclaration& check) const {
    check_window(check);
    switch (check.kind) {
      case Kind::Count:
        return counts(check);
      case Kind::Answer:
        return {answer(check)};
      default:
        return signals(check);
    }
  }

 private:
  void check_window(const CheckDeclaration& check) const;
  std::vector<Definition> signals(const CheckDeclaration& check) const;
  checks::SignalDemand demand(const CheckDeclaration& check, const Element& element,
                              const checks::ConditionText& condition) const;
  Definition signal(const CheckDeclaration& check, const Element& element) const;
  /// Of Until.
  checks::SignalDemand ending(const CheckDeclaration& check) const;
  std::vector<Definition> counts(const CheckDeclaration& check) const;
  Definition answer(const CheckDeclaration& check) const;

  std::vector<Element> find_elements(const CheckDeclaration& check,
                                     const std::string& pattern) const;
  std::vector<core::VariableId> find_messages(const CheckDeclaration& check,
                                              const std::string& pattern) const;
  core::VariableId find_message(const CheckDeclaration& check, const std::string& name) const;
  /// Whether it is a message whose ticks are reported: where they carry values, these are reported
  /// instead.
  bool is_reported(const NamedVariable& variable) const;
  bool is_triggered(const NamedVariable& clock) const;
  const core::UnitDescription& description(const NamedVariable& variable) const;
  [[noreturn]] void fail_unsuitable(const CheckDeclaration& check, const NamedVariable& named,
                                    bool wants_message) const;
  [[noreturn]] void fail_unknown(const CheckDeclaration& check, const std::string& pattern,
                                 bool wants_message) const;

  const core::System& system_;
  const ScenarioTimes& times_;
  VariableFinder finder_;
};

void Selection::check_window(const CheckDeclaration& check) const {
  const auto fail = [&](const char* attribute, Time time, const char* side, Time limit) {
    core::fail_input(
        {.where = check.where},
        fmt::format("{}: {} s is {} the run, at {} s", attribute, core::to_text(time), side,
                    core::to_text(limit)),
        (limit == times_.stop && !times_.stop_hint.empty() ? times_.stop_hint + "; or " : "") +
            fmt::format("leave '{}' out for an interval that is not limited", attribute));
  };
  const auto& [from, to] = check.window;
  if (to && *to < times_.start) fail("to", *to, "before the beginning of", times_.start);
  if (!times_.stop) return;
  if (from && *from > *times_.stop) fail("from", *from, "behind the end of", *times_.stop);
  if (to && *to > *times_.stop) fail("to", *to, "behind the end of", *times_.stop);
}

/// What is named exists, but has not what a check of this kind needs.
[[noreturn]] void Selection::fail_unsuitable(const CheckDeclaration& check,
                                             const NamedVariable& named, bool wants_message) const {
  const core::Context context{.where = check.where};
  if (!wants_message) {
    core::fail_input(
        context,
        fmt::format("'{}' belongs to a clock and has a value only when that ticks", named.name),
        "count its messages with <stride:Count event=\"…\"/>, or wait for them with "
        "<stride:Answer/>");
  }
  if (named.is_signal) {
    core::fail_input(context,
                     fmt::format("'{}' is not a message, but has a value at each time", named.name),
                     "compare it with <stride:Always>, <stride:Never>, <stride:Eventually> or "
                     "<stride:Final>");
  }
  const core::Variable* const carried = description(named).carried_by(system_.variable(named.id));
  core::fail_input(
      context, fmt::format("ticks of '{}' cannot be checked", named.name),
      carried == nullptr || !is_triggered(named)
          ? "it ticks by the time alone"
          : fmt::format("name what it carries: '{}'", system_.prefix(named.id) + carried->name));
}

[[noreturn]] void Selection::fail_unknown(const CheckDeclaration& check, const std::string& pattern,
                                          bool wants_message) const {
  std::vector<std::string> names;
  for (const NamedVariable& variable : finder_.all()) {
    if (!core::is_glob(pattern) && is_meant(system_, variable.id, pattern)) {
      fail_unsuitable(check, variable, wants_message);
    }
    const bool fits = wants_message ? is_reported(variable) : variable.is_signal;
    if (fits) names.push_back(variable.name);
  }
  core::fail_input(
      {.where = check.where},
      fmt::format("there is no {} '{}'", wants_message ? "message" : "signal", pattern),
      core::suggestion(pattern, names));
}

bool Selection::is_triggered(const NamedVariable& clock) const {
  return system_.variable(clock.id).is_triggered_clock();
}

const core::UnitDescription& Selection::description(const NamedVariable& variable) const {
  return *system_.components()[variable.id.component].description;
}

bool Selection::is_reported(const NamedVariable& variable) const {
  return system_.is_reported(variable.id);
}

std::vector<Element> Selection::find_elements(const CheckDeclaration& check,
                                              const std::string& pattern) const {
  std::vector<Element> found;
  const auto add = [&](const NamedVariable& variable, bool is_whole) {
    if (!variable.is_signal) return;
    const core::Variable& described = system_.variable(variable.id);
    for (std::size_t i = 0; i < described.size; ++i) {
      std::string name = system_.prefix(variable.id) + core::element_name(described, i);
      if (is_whole || core::means(pattern, name)) found.push_back({&variable, i, std::move(name)});
    }
  };
  if (core::is_glob(pattern)) {  // or the name of an element, which has brackets
    for (const NamedVariable& variable : finder_.all()) {
      add(variable, is_meant(system_, variable.id, pattern));
    }
  } else {
    for (const NamedVariable* variable : finder_.meant(pattern, check.where)) add(*variable, true);
  }
  if (found.empty()) fail_unknown(check, pattern, false);
  return found;
}

std::vector<core::VariableId> Selection::find_messages(const CheckDeclaration& check,
                                                       const std::string& pattern) const {
  std::vector<core::VariableId> found;
  for (const NamedVariable* variable : finder_.meant(pattern, check.where)) {
    if (is_reported(*variable)) found.push_back(variable->id);
  }
  if (found.empty()) fail_unknown(check, pattern, true);
  return found;
}

core::VariableId Selection::find_message(const CheckDeclaration& check,
                                         const std::string& name) const {
  const auto found = find_messages(check, name);
  if (found.size() == 1) return found.front();
  core::fail_input({.where = check.where},
                   fmt::format("'{}' matches {} messages; expected one", name, found.size()));
}

/// The name that was given, with the signal where it matches several.
std::string name_of(const CheckDeclaration& check, const std::string& subject,
                    const std::string& demand, bool is_alone) {
  if (check.name.empty()) return demand;
  return is_alone ? check.name : fmt::format("{}: {}", check.name, subject);
}

checks::SignalDemand Selection::demand(const CheckDeclaration& check, const Element& element,
                                       const checks::ConditionText& condition) const {
  const core::Variable& variable = system_.variable(element.variable->id);
  try {
    return {element.variable->id, element.element, element.name, variable.unit,
            checks::Condition(variable, condition)};
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({.where = check.where}, fmt::format("'{}': {}", element.name, mistake.what()));
  }
}

Definition Selection::signal(const CheckDeclaration& check, const Element& element) const {
  checks::SignalDemand wanted = demand(check, element, check.condition);
  const std::string text =
      fmt::format("{} {} {}", element.name, check.kind == Kind::Until ? "is" : name(check.kind),
                  wanted.condition.text());
  if (check.kind != Kind::Until) {
    return {check.kind,   "",          text + check.window.text(),
            check.window, check.where, std::move(wanted)};
  }
  checks::UntilDemand until{std::move(wanted), ending(check)};
  return {check.kind,
          "",
          fmt::format("{} until {}{}", text, until.text(), check.window.text()),
          check.window,
          check.where,
          std::move(until)};
}

checks::SignalDemand Selection::ending(const CheckDeclaration& check) const {
  const std::vector<Element> elements = find_elements(check, check.ending_signal);
  if (elements.size() == 1) return demand(check, elements.front(), check.ending);
  core::fail_input({.where = check.where}, fmt::format("'{}' matches {} signals; expected one",
                                                       check.ending_signal, elements.size()));
}

std::vector<Definition> Selection::signals(const CheckDeclaration& check) const {
  std::vector<Definition> definitions;
  const std::vector<Element> elements = find_elements(check, check.subject);
  for (const Element& element : elements) {
    Definition& definition = definitions.emplace_back(signal(check, element));
    definition.name = name_of(check, element.name, definition.demand, elements.size() == 1);
  }
  return definitions;
}

std::string limits_text(const CheckDeclaration& check) {
  if (check.min && check.max && *check.min == *check.max) return fmt::format("= {}", *check.min);
  std::string text;
  if (check.min) text += fmt::format(">= {}", *check.min);
  if (check.max) text += fmt::format("{}<= {}", text.empty() ? "" : " and ", *check.max);
  return text;
}

std::vector<Definition> Selection::counts(const CheckDeclaration& check) const {
  std::vector<Definition> definitions;
  const auto messages = find_messages(check, check.subject);
  for (const core::VariableId id : messages) {
    const std::string subject = system_.full_name(id);
    const std::string demand =
        fmt::format("{} count {}{}", subject, limits_text(check), check.window.text());
    definitions.push_back({check.kind, name_of(check, subject, demand, messages.size() == 1),
                           demand, check.window, check.where,
                           checks::CountDemand{id, check.min, check.max}});
  }
  return definitions;
}

Definition Selection::answer(const CheckDeclaration& check) const {
  const core::VariableId request = find_message(check, check.subject);
  const core::VariableId reply = find_message(check, check.reply);
  if (request == reply) {
    core::fail_input({.where = check.where},
                     fmt::format("'{}' cannot answer itself", check.subject));
  }
  const std::string demand =
      fmt::format("{} answered by {} within {} s{}", system_.full_name(request),
                  system_.full_name(reply), core::to_text(check.within), check.window.text());
  return {check.kind,  name_of(check, "", demand, true),
          demand,      check.window,
          check.where, checks::AnswerDemand{request, reply, check.within, check.repeats}};
}

void check_names(const std::vector<Definition>& definitions) {
  std::map<std::string, const Definition*> known;
  for (const Definition& definition : definitions) {
    const auto [first, is_new] = known.emplace(definition.name, &definition);
    if (is_new) continue;
    core::fail_input({.where = definition.where},
                     fmt::format("a second check '{}'; the first is in line {}", definition.name,
                                 first->second->where.line),
                     "give each a name of its own");
  }
}

}  // namespace

std::vector<Definition> select_checks(const core::System& system,
                                      std::span<const CheckDeclaration> declarations,
                                      const ScenarioTimes& times) {
  const Selection selection(system, times);
  std::vector<Definition> definitions;
  core::Diagnostics diagnostics;
  for (const CheckDeclaration& check : declarations) {
    diagnostics.attempt([&] {
      for (Definition& definition : selection.select(check)) {
        definitions.push_back(std::move(definition));
      }
    });
  }
  diagnostics.raise();
  check_names(definitions);
  return definitions;
}

}  // namespace stride::scenario
