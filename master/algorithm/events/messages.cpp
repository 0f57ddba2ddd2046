#include "master/algorithm/events/messages.h"

#include <algorithm>

namespace stride::core {
namespace {

std::vector<VariableId> targets_of(const System& system, VariableId source) {
  std::vector<VariableId> targets;
  for (const Connection& connection : system.connections()) {
    if (connection.from == source) targets.push_back(connection.to);
  }
  return targets;
}

}  // namespace

MessageExchange::MessageExchange(const System& system, std::span<const std::unique_ptr<Unit>> units)
    : system_(system), units_(units), senders_(system.components().size()) {
  tick_.numbers<bool>()[0] = true;
  for (std::size_t component = 0; component < senders_.size(); ++component) {
    const auto& variables = system.components()[component].description->variables;
    for (std::size_t i = 0; i < variables.size(); ++i) add_clock({component, i});
    Sender& sender = senders_[component];
    sender.ticked = ValueBlock(ValueType::Clock, sender.triggered.size());
  }
}

/// If it is one that may be the source of messages.
void MessageExchange::add_clock(VariableId id) {
  const UnitDescription& description = *system_.components()[id.component].description;
  const Variable& clock = description.variables[id.variable];
  if (clock.type != ValueType::Clock) return;
  const bool is_output = clock.causality == Causality::Output;
  if (!is_output && !system_.ticks_triggered(id)) return;
  SourceClock source{id, clock.reference, {}, targets_of(system_, id), false};
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    const Variable& variable = description.variables[i];
    if (!variable.belongs_to(clock.reference) || variable.causality != Causality::Output) continue;
    const VariableId value{id.component, i};
    source.payloads.push_back({value, variable.reference, ValueBlock(variable.type, variable.size),
                               receivers_of(value, source.targets)});
  }
  Sender& sender = senders_[id.component];
  if (is_output) sender.references.push_back(clock.reference);
  (is_output ? sender.triggered : sender.time_based).push_back(std::move(source));
}

/// The inputs that the value travels to when the clock ticks: those that belong to a clock wired to
/// it.
std::vector<MessageExchange::Receiver> MessageExchange::receivers_of(
    VariableId value, std::span<const VariableId> clock_targets) const {
  std::vector<Receiver> receivers;
  for (const Connection& connection : system_.connections()) {
    if (connection.from != value) continue;
    const VariableId input = connection.to;
    const Variable& variable = system_.variable(input);
    const bool is_reached = std::ranges::any_of(clock_targets, [&](VariableId clock) {
      return clock.component == input.component &&
             variable.belongs_to(system_.variable(clock).reference);
    });
    if (!is_reached) continue;
    receivers.push_back({input, &connection, ValueBlock(variable.type, variable.size)});
  }
  return receivers;
}

void MessageExchange::begin_instant() {
  for (Sender& sender : senders_) {
    for (SourceClock& clock : sender.time_based) clock.is_forwarded = false;
    for (SourceClock& clock : sender.triggered) clock.is_forwarded = false;
  }
}

bool MessageExchange::poll(std::size_t component) {
  Sender& sender = senders_[component];
  if (sender.triggered.empty()) return false;
  units_[component]->get(sender.references, sender.ticked);
  const auto ticked = sender.ticked.numbers<bool>();
  return std::find(ticked.begin(), ticked.end(), true) != ticked.end();
}

void MessageExchange::read_payload(std::size_t component, Payload& payload) {
  units_[component]->get({&payload.reference, 1}, payload.block);
}

void MessageExchange::set_clock(VariableId target) {
  units_[target.component]->set({&system_.variable(target).reference, 1}, tick_);
}

void MessageExchange::set_payload(Receiver& receiver, const ValueBlock& payload) {
  copy_elements(receiver.block, 0, payload, 0, payload.size(), receiver.connection->conversion);
  units_[receiver.id.component]->set({&system_.variable(receiver.id).reference, 1}, receiver.block);
}

}  // namespace stride::core
