#include "master/engine/run/events/messages.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/engine/run/events/bit_errors.h"
#include "master/engine/run/exchange/item_check.h"

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

MessageExchange::MessageExchange(const System& system, std::span<const std::unique_ptr<Unit>> units,
                                 Participants& participants)
    : system_(system),
      units_(units),
      participants_(participants),
      senders_(system.components().size()) {
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
  SourceClock source{id, clock.reference, {}, {}, false};
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    const Variable& variable = description.variables[i];
    if (!variable.belongs_to(clock.reference) || variable.causality != Causality::Output) continue;
    source.payloads.push_back(
        {{id.component, i}, variable.reference, ValueBlock(variable.type, variable.size)});
  }
  for (const VariableId target : targets_of(system_, id)) {
    source.targets.push_back(make_target(target, source.payloads));
  }
  Sender& sender = senders_[id.component];
  if (is_output) sender.references.push_back(clock.reference);
  (is_output ? sender.triggered : sender.time_based).push_back(std::move(source));
}

/// With the inputs that belong to this clock and are connected to one of the payloads.
MessageExchange::Target MessageExchange::make_target(VariableId clock,
                                                     std::span<const Payload> payloads) const {
  Target target{clock, {}};
  const ValueReference reference = system_.variable(clock).reference;
  for (std::size_t payload = 0; payload < payloads.size(); ++payload) {
    for (const Connection& connection : system_.connections()) {
      const VariableId input = connection.to;
      if (connection.from != payloads[payload].id || input.component != clock.component) continue;
      const Variable& variable = system_.variable(input);
      if (!variable.belongs_to(reference)) continue;
      target.receivers.push_back(
          {input, &connection, payload, ValueBlock(variable.type, variable.size)});
    }
  }
  return target;
}

template <class Function>
void MessageExchange::for_each_target(Function&& function) {
  for (Sender& sender : senders_) {
    for (std::vector<SourceClock>* const clocks : {&sender.time_based, &sender.triggered}) {
      for (SourceClock& clock : *clocks) std::ranges::for_each(clock.targets, function);
    }
  }
}

MessageExchange::Target& MessageExchange::target_of(const Intervention& intervention) {
  Target* found = nullptr;
  for_each_target([&](Target& target) {
    if (target.clock == intervention.clock) found = &target;
  });
  if (found == nullptr) throw std::logic_error("an intervention on a clock without messages");
  return *found;
}

void MessageExchange::disturb(const Intervention& intervention) {
  target_of(intervention).disturbance = &intervention;
}

void MessageExchange::release(const Intervention& intervention) {
  target_of(intervention).disturbance = nullptr;
}

void MessageExchange::persist(StateArchive& state, Time now) {
  state.mark("messages");
  std::vector<Target*> targets;
  for_each_target([&](Target& target) { targets.push_back(&target); });
  state.fixed(targets, [&](Target* target) { state.value(target->corrupted); });
  Time earliest = now + Duration(1);
  state.sequence(delayed_, [&](Delayed& message) {
    persist(state, message, targets);
    if (message.due < earliest) state.fail("a message has not been received, or not in its turn");
    earliest = message.due;
  });
}

void MessageExchange::persist(StateArchive& state, Delayed& message,
                              std::span<Target* const> targets) {
  auto target =
      static_cast<std::size_t>(std::ranges::find(targets, message.target) - targets.begin());
  state.value(message.due);
  state.value(target);
  if (target >= targets.size()) state.fail("a message has no receiver");
  message.target = targets[target];
  if (state.is_reading()) {
    for (const Receiver& receiver : message.target->receivers) {
      message.values.emplace_back(receiver.block.type(), receiver.block.size());
    }
  }
  for (ValueBlock& value : message.values) core::persist(state, value);
}

void MessageExchange::begin_instant(Time time) {
  time_ = time;
  for (Sender& sender : senders_) {
    for (SourceClock& clock : sender.time_based) clock.is_forwarded = false;
    for (SourceClock& clock : sender.triggered) clock.is_forwarded = false;
  }
  for_each_target([](Target& target) { target.has_ticked = false; });
}

void MessageExchange::deliver_delayed() {
  for (auto next = delayed_.begin(); next != delayed_.end() && next->due <= time_;) {
    Target& target = *next->target;
    if (target.has_ticked) {  // a clock ticks once in an instant, so the next one has to wait
      ++next;
      continue;
    }
    for (std::size_t i = 0; i < target.receivers.size(); ++i) {
      target.receivers[i].block = std::move(next->values[i]);
    }
    next = delayed_.erase(next);
    deliver(target);
  }
}

void MessageExchange::transmit(std::size_t component) {
  if (!poll(component)) return;
  Sender& sender = senders_[component];
  for (std::size_t i = 0; i < sender.triggered.size(); ++i) {
    if (sender.ticked.numbers<bool>()[i]) forward(sender.triggered[i]);
  }
}

void MessageExchange::transmit_ticks(std::size_t component,
                                     std::span<const ValueReference> ticking) {
  for (SourceClock& clock : senders_[component].time_based) {
    if (std::ranges::find(ticking, clock.reference) != ticking.end()) forward(clock);
  }
}

bool MessageExchange::poll(std::size_t component) {
  Sender& sender = senders_[component];
  if (sender.triggered.empty()) return false;
  units_[component]->get(sender.references, sender.ticked);
  const auto ticked = sender.ticked.numbers<bool>();
  return std::find(ticked.begin(), ticked.end(), true) != ticked.end();
}

void MessageExchange::forward(SourceClock& clock) {
  if (std::exchange(clock.is_forwarded, true)) return;
  send(clock);
  for (Target& target : clock.targets) {
    convert(target, clock.payloads);
    if (target.disturbance != nullptr && !passes(target)) continue;
    if (const Time receipt = participants_.next_receipt(target.clock.component, time_);
        receipt != time_) {
      participants_.report_disturbed(
          target.clock,
          fmt::format("received at {} s, where the unit's step ends", to_text(receipt)));
      delay(target, receipt);
      continue;
    }
    target.has_ticked ? delay(target, time_) : deliver(target);
  }
}

void MessageExchange::send(SourceClock& clock) {
  for (Payload& payload : clock.payloads) {
    units_[clock.id.component]->get({&payload.reference, 1}, payload.block);
    participants_.report(payload.id, false, &payload.block);
  }
  if (clock.payloads.empty()) participants_.report(clock.id, false, nullptr);
}

void MessageExchange::convert(Target& target, std::span<const Payload> payloads) {
  for (Receiver& receiver : target.receivers) {
    const ValueBlock& sent = payloads[receiver.payload].block;
    const Connection& wire = *receiver.connection;
    copy_elements(receiver.block, 0, sent, 0, sent.size(), wire.conversion);
    check_converted(system_, wire.from, wire.to, wire.conversion, {&receiver.block, 0, sent.size()},
                    time_);
  }
}

/// Does what the intervention demands. Returns whether the message is received now.
bool MessageExchange::passes(Target& target) {
  const Intervention& disturbance = *target.disturbance;
  switch (disturbance.kind) {
    case Intervention::Kind::Drop:
      participants_.report_disturbed(disturbance.id, "dropped");
      return false;
    case Intervention::Kind::Delay: {
      const Time due = later(time_, disturbance.delay);
      participants_.report_disturbed(disturbance.id,
                                     fmt::format("delayed until {} s", to_text(due)));
      delay(target, due);
      return false;
    }
    default:
      corrupt(target);
      return true;
  }
}

void MessageExchange::corrupt(Target& target) {
  const Intervention& disturbance = *target.disturbance;
  const bool is_whole = disturbance.id == disturbance.clock;
  std::vector<std::span<std::uint8_t>> values;
  for (Receiver& receiver : target.receivers) {
    if (receiver.block.type() != ValueType::Binary) continue;
    if (!is_whole && receiver.id != disturbance.id) continue;
    for (Binary& value : receiver.block.binaries()) {
      values.push_back(std::span(value).subspan(std::min(disturbance.header, value.size())));
    }
  }
  const std::size_t inverted =
      invert_bits(values, disturbance.bits, {disturbance.seed, target.corrupted++});
  participants_.report_disturbed(disturbance.id, counted(inverted, "bit") + " inverted");
}

void MessageExchange::delay(Target& target, Time earliest) {
  const Time due = participants_.next_receipt(target.clock.component, earliest);
  std::vector<ValueBlock> values;
  for (const Receiver& receiver : target.receivers) values.push_back(receiver.block);
  const auto after = std::ranges::upper_bound(delayed_, due, {}, &Delayed::due);
  delayed_.insert(after, {due, &target, std::move(values)});
}

void MessageExchange::deliver(Target& target) {
  target.has_ticked = true;
  deliver(target.clock, target.receivers);
}

void MessageExchange::set(VariableId id, const ValueBlock& value) {
  units_[id.component]->set({&system_.variable(id).reference, 1}, value);
}

}  // namespace stride::core
