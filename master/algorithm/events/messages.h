// The exchange of messages: values that exist at the ticks of a clock only.
#ifndef STRIDE_MASTER_ALGORITHM_EVENTS_MESSAGES_H
#define STRIDE_MASTER_ALGORITHM_EVENTS_MESSAGES_H

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "master/algorithm/observer.h"
#include "master/algorithm/unit.h"
#include "master/model/system.h"

namespace stride::core {

/// For each unit: its triggered output clocks and its time-based clocks that are connected, the
/// clocked variables of each, and the connected inputs.
class MessageExchange {
 public:
  MessageExchange(const System& system, std::span<const std::unique_ptr<Unit>> units);

  /// A new super-dense instant begins: each clock may tick once in it.
  void begin_instant();

  /// Reads the output clocks of a unit in Event Mode and hands over those that tick and were not
  /// handed over in this instant. `prepare` is called with each receiving component before anything
  /// is set there (it must be in Event Mode then), `report` with each message sent or received.
  template <class Prepare, class Report>
  void transmit(std::size_t component, Prepare&& prepare, Report&& report) {
    if (!poll(component)) return;
    Sender& sender = senders_[component];
    for (std::size_t i = 0; i < sender.triggered.size(); ++i) {
      if (!sender.ticked.numbers<bool>()[i]) continue;
      forward(component, sender.triggered[i], prepare, report);
    }
  }

  /// Likewise for the unit's time-based clocks that tick.
  template <class Prepare, class Report>
  void transmit_ticks(std::size_t component, std::span<const ValueReference> ticking,
                      Prepare&& prepare, Report&& report) {
    for (SourceClock& clock : senders_[component].time_based) {
      if (std::ranges::find(ticking, clock.reference) == ticking.end()) continue;
      forward(component, clock, prepare, report);
    }
  }

 private:
  /// A connected input, and the converted value.
  struct Receiver {
    VariableId id;
    const Connection* connection;
    ValueBlock block;
  };
  /// A variable that belongs to such a clock.
  struct Payload {
    VariableId id;
    ValueReference reference;
    ValueBlock block;
    std::vector<Receiver> receivers;
  };
  struct SourceClock {
    VariableId id;
    ValueReference reference;
    std::vector<Payload> payloads;
    std::vector<VariableId> targets;
    bool is_forwarded = false;  ///< in this instant
  };
  /// A component with its clocks.
  struct Sender {
    std::vector<SourceClock> time_based;
    std::vector<SourceClock> triggered;
    std::vector<ValueReference> references;  ///< of the triggered ones
    ValueBlock ticked{ValueType::Clock, 0};
  };

  void add_clock(VariableId id);
  bool poll(std::size_t component);
  void read_payload(std::size_t component, Payload& payload);
  void set_clock(VariableId target);
  void set_payload(Receiver& receiver, const ValueBlock& payload);
  std::vector<Receiver> receivers_of(VariableId value,
                                     std::span<const VariableId> clock_targets) const;

  template <class Prepare, class Report>
  void forward(std::size_t component, SourceClock& clock, Prepare& prepare, Report& report) {
    if (std::exchange(clock.is_forwarded, true)) return;
    for (Payload& payload : clock.payloads) {
      read_payload(component, payload);
      report(payload.id, false, &payload.block);
    }
    if (clock.payloads.empty()) report(clock.id, false, static_cast<const ValueBlock*>(nullptr));
    for (const VariableId target : clock.targets) {
      prepare(target.component);
      set_clock(target);
      if (clock.payloads.empty()) report(target, true, static_cast<const ValueBlock*>(nullptr));
    }
    for (Payload& payload : clock.payloads) {
      for (Receiver& receiver : payload.receivers) {
        set_payload(receiver, payload.block);
        report(receiver.id, true, &receiver.block);
      }
    }
  }

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  std::vector<Sender> senders_;
  ValueBlock tick_{ValueType::Clock, 1};
};

}  // namespace stride::core

#endif
