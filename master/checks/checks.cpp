#include "master/checks/checks.h"

#include <utility>

#include "master/checks/message_checks.h"

namespace stride::checks {

Checks::Checks(std::vector<Definition> definitions) : definitions_(std::move(definitions)) {
  for (const Definition& definition : definitions_) {
    if (std::holds_alternative<SignalDemand>(definition.what)) {
      auto check = std::make_unique<SignalCheck>(definition);
      signal_checks_.push_back(check.get());
      checks_.push_back(std::move(check));
      continue;
    }
    if (std::holds_alternative<CountDemand>(definition.what)) {
      checks_.push_back(std::make_unique<CountCheck>(definition));
    } else {
      checks_.push_back(std::make_unique<AnswerCheck>(definition));
    }
    message_checks_.push_back(checks_.back().get());
  }
}

std::vector<core::VariableId> Checks::signals() const {
  std::vector<core::VariableId> ids;
  for (const SignalCheck* check : signal_checks_) ids.push_back(check->id());
  return ids;
}

void Checks::on_start(std::span<const core::Signal> signals) {
  for (std::size_t i = 0; i < signals.size(); ++i) signal_checks_[i]->attach(signals[i]);
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
