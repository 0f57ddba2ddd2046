#include "master/observe/checks/checks.h"

#include <utility>

#include "master/observe/checks/message_checks.h"
#include "master/observe/checks/signal_check.h"
#include "master/observe/checks/until_check.h"

namespace stride::checks {

namespace {

std::unique_ptr<Check> make_check(const Definition& definition) {
  switch (definition.kind) {
    case Kind::Until:
      return std::make_unique<UntilCheck>(definition);
    case Kind::Count:
      return std::make_unique<CountCheck>(definition);
    case Kind::Answer:
      return std::make_unique<AnswerCheck>(definition);
    default:
      return std::make_unique<SignalCheck>(definition);
  }
}

}  // namespace

Checks::Checks(std::vector<Definition> definitions) : definitions_(std::move(definitions)) {
  for (const Definition& definition : definitions_) {
    checks_.push_back(make_check(definition));
    if (checks_.back()->signals().empty()) message_checks_.push_back(checks_.back().get());
  }
}

std::vector<core::VariableId> Checks::signals() const {
  std::vector<core::VariableId> ids;
  for (const auto& check : checks_) {
    const std::vector<core::VariableId> of_check = check->signals();
    ids.insert(ids.end(), of_check.begin(), of_check.end());
  }
  return ids;
}

void Checks::on_start(std::span<const core::Signal> signals) {
  for (const auto& check : checks_) {
    const std::size_t count = check->signals().size();
    check->attach(signals.first(count));
    signals = signals.subspan(count);
  }
}

void Checks::on_message(const core::Message& message) {
  for (Check* check : message_checks_) check->on_message(message);
}

void Checks::on_communication_point(Time time) {
  for (const auto& check : checks_) check->on_point(time);
}

void Checks::persist(core::StateArchive& state) {
  state.mark("checks");
  state.fixed(checks_, [&](const std::unique_ptr<Check>& check) { check->persist(state); });
}

std::vector<core::Verdict> Checks::verdicts(const Ending& ending) const {
  std::vector<core::Verdict> verdicts;
  for (const auto& check : checks_) verdicts.push_back(check->verdict(ending));
  return verdicts;
}

}  // namespace stride::checks
