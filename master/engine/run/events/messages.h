// The exchange of messages: values that exist at the ticks of a clock only.
#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_MESSAGES_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_MESSAGES_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/port/unit.h"
#include "master/engine/run/context/intervention.h"
#include "master/engine/run/events/sent_message.h"

namespace stride::core {

class StateArchive;

/// For each unit: its triggered output clocks and its time-based clocks that are connected, the
/// clocked variables of each, and the connected inputs.
class MessageExchange {
 public:
  /// What happens around a message.
  class Participants {
   public:
    /// Before anything is set in this component: it must be in Event Mode then.
    virtual void receive(std::size_t component) = 0;
    /// The first instant not before `time` at which this component can receive something.
    virtual Time next_receipt(std::size_t component, Time time) = 0;
    /// A message, or a tick without a value, was sent or received.
    virtual void report(VariableId id, bool received, const ValueBlock* block) = 0;
    /// A message was not received as it was sent.
    virtual void report_disturbed(VariableId id, const std::string& text) = 0;

   protected:
    ~Participants() = default;
  };

  /// All must outlive this object.
  MessageExchange(const System& system, std::span<const std::unique_ptr<Unit>> units,
                  Participants& participants);

  /// A new super-dense instant begins: each clock may tick once in it.
  void begin_instant(Time time);

  /// Hands over the messages whose delay is over.
  void deliver_delayed();
  /// One from outside of the system; its clock ticks in this instant.
  void deliver(const SentMessage& message) { deliver(message.clock, message.values); }
  /// Reads the output clocks of a unit in Event Mode and hands over those that tick and were not
  /// handed over in this instant.
  void transmit(std::size_t component);
  /// Likewise for the unit's time-based clocks that tick.
  void transmit_ticks(std::size_t component, std::span<const ValueReference> ticking);

  /// From now on, what the intervention's clock would receive is dropped, delayed or corrupted. The
  /// intervention must outlive this object, or the call of release().
  void disturb(const Intervention& intervention);
  void release(const Intervention& intervention);

  /// Those on their way, and what was counted; not the disturbances.
  void persist(StateArchive& state, Time now);

  /// When the next delayed message arrives.
  Time next_delivery() const { return delayed_.front().due; }
  /// Whether there is one up to this time.
  bool has_delivery(Time time) const { return !delayed_.empty() && delayed_.front().due <= time; }

 private:
  /// A connected input, and the converted value.
  struct Receiver {
    VariableId id;
    const Connection* connection;
    std::size_t payload;  ///< the index of what it receives
    ValueBlock block;
  };
  /// An input clock, and the inputs that belong to it.
  struct Target {
    VariableId clock;
    std::vector<Receiver> receivers;
    const Intervention* disturbance = nullptr;
    std::uint64_t corrupted = 0;  ///< messages in this run
    bool has_ticked = false;      ///< in this instant
  };
  /// A variable that belongs to a source clock.
  struct Payload {
    VariableId id;
    ValueReference reference;
    ValueBlock block;
  };
  struct SourceClock {
    VariableId id;
    ValueReference reference;
    std::vector<Payload> payloads;
    std::vector<Target> targets;
    bool is_forwarded = false;  ///< in this instant
  };
  /// A component with its clocks.
  struct Sender {
    std::vector<SourceClock> time_based;
    std::vector<SourceClock> triggered;
    std::vector<ValueReference> references;  ///< of the triggered ones
    ValueBlock ticked{ValueType::Clock, 0};
  };
  /// A message on its way.
  struct Delayed {
    Time due{};
    Target* target = nullptr;
    std::vector<ValueBlock> values{};  ///< of its receivers
  };

  void add_clock(VariableId id);
  Target make_target(VariableId clock, std::span<const Payload> payloads) const;
  Target& target_of(const Intervention& intervention);
  template <class Function>
  void for_each_target(Function&& function);
  static void persist(StateArchive& state, Delayed& message, std::span<Target* const> targets);
  bool poll(std::size_t component);
  void forward(SourceClock& clock);
  void send(SourceClock& clock);
  void convert(Target& target, std::span<const Payload> payloads);
  bool passes(Target& target);
  void corrupt(Target& target);
  void delay(Target& target, Time earliest);
  void deliver(Target& target);
  template <class Values>
  void deliver(VariableId clock, const Values& values);
  void set(VariableId id, const ValueBlock& value);

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Participants& participants_;
  std::vector<Sender> senders_;
  std::deque<Delayed> delayed_;  ///< by the time at which they arrive
  Time time_{};
  ValueBlock tick_{ValueType::Clock, 1};
};

template <class Values>
void MessageExchange::deliver(VariableId clock, const Values& values) {
  participants_.receive(clock.component);
  set(clock, tick_);
  if (values.empty()) participants_.report(clock, true, nullptr);
  for (const auto& value : values) {
    set(value.id, value.block);
    participants_.report(value.id, true, &value.block);
  }
}

}  // namespace stride::core

#endif
