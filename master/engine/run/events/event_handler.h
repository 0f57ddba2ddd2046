// The exchange of values and the handling of events at a communication point.
#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_EVENT_HANDLER_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_EVENT_HANDLER_H

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/events/clocks.h"
#include "master/engine/run/events/messages.h"
#include "master/engine/run/idle/idle_scheduler.h"
#include "master/engine/run/loops/ordered_evaluation.h"
#include "master/engine/run/stepping/own_steps.h"

namespace stride::core {

class StateArchive;

/// Handles the events at a communication point, and keeps the times of the next ones.
class EventHandler : private OrderedEvaluation::Participants,
                     private MessageExchange::Participants {
 public:
  /// All must outlive this object. `idle`, `own_steps`: optional.
  explicit EventHandler(RunContext& context, IdleScheduler* idle = nullptr,
                        OwnSteps* own_steps = nullptr);

  /// Before the end of Initialization Mode: determines the first ticks of the time-based clocks.
  void begin_clocks(Time start) { clocks_.begin(start); }
  /// After Initialization Mode, where units with Event Mode are in it: each handles at least one
  /// event in the next handle_events(). Fetches the outputs of all units.
  void begin();
  /// A unit that is suspended, or behind in a step of its own, is stepped to this time. Where it
  /// asks for the end of the run meanwhile, the run ends here.
  void catch_up(std::size_t component, Time time);
  /// Makes the unit enter Event Mode in the next handle_events(), like a unit whose announced event
  /// is due.
  void request_event(std::size_t component) {
    if (description(component).has_event_mode) activate(component);
  }
  /// Likewise, and sets a variable of the unit there, which has Event Mode. The value must outlive
  /// the call of handle_events().
  void set_in_event(VariableId id, const ValueBlock& value) {
    assignments_.push_back({id, &value});
    activate(id.component);
  }
  /// Its receiver gets it in the next handle_events(). It must outlive that call.
  void send(const SentMessage& message) {
    sent_.push_back(&message);
    activate(message.clock.component);
  }
  /// What a clock receives is dropped, delayed or corrupted from now on, and until release().
  void disturb(const Intervention& intervention) { messages_.disturb(intervention); }
  void release(const Intervention& intervention) { messages_.release(intervention); }
  /// At a communication point, after the steps: finds the announced events and exchanges the
  /// outputs that have been read. Throws Error (Run) if a connected output is NaN.
  void begin_instant(Time time);
  /// Handles events until no unit needs another
  /// event iteration. Outputs of units in Event Mode that depend directly on inputs follow them at
  /// once, and algebraic loops between such units are solved. Units are left in Step Mode; the
  /// inputs of those without an event are still to be written (Exchange::write_routed_inputs).
  /// Throws Error (Run) if a connected output is NaN, a loop has no solution, or events do not
  /// settle after 1000 iterations.
  void handle_events();

  /// After handle_events(): until when nothing is to be done at a communication point but
  /// pass_quietly(); the least time where a unit may have an event at any of them.
  Time quiet_until() const;
  /// Instead of begin_instant() and handle_events(), at a communication point before that.
  void pass_quietly(const Time& time) {
    index_ = 0;
    time_ = time;
    exchange_.route(time);
  }

  /// At the communication point `now`, after its events.
  void persist(StateArchive& state, Time start, Time now);

  /// Whether the unit has announced an event for this time.
  bool has_announced(std::size_t component, Time time) const {
    return next_event_[component] == time;
  }

  /// Whether the unit handled an event in the last handle_events(), by component.
  std::span<const char> had_event() const { return had_event_; }

  /// The earliest event announced, tick of a time-based clock, or arrival of a delayed message, for
  /// later than the last handle_events(), or `target` if that is earlier.
  Time next_event(Time target) const;

 private:
  std::size_t count() const { return units_.size(); }
  const UnitDescription& description(std::size_t i) const {
    return *system_.components()[i].description;
  }
  void activate(std::size_t i) { active_[i] = has_active_ = true; }
  void make_assignments();
  void activate_announced();
  void update_announced();
  bool prepare_events();
  void leave_event_mode();
  void enter_event_mode(std::size_t i);
  bool must_wait(std::size_t i) const {
    return own_steps_ != nullptr && own_steps_->must_wait(i, time_);
  }
  bool event_iteration();
  void tick_clocks();
  bool exchange_samples(std::span<const std::size_t> ticking);
  void exchange_after_events();
  void exchange_messages();
  void transmit_triggered();
  void notify_observers(VariableId id, bool received, const ValueBlock* block);
  std::string content_of(VariableId id, const ValueBlock& block) const;
  std::string described_by(VariableId id, const ValueBlock& block) const;
  void find_discontinuities(std::span<const ContinuousLink> links);
  void route();
  void check_sent(VariableId id, const ValueBlock& block) const;
  [[noreturn]] void fail_nan(VariableId id) const;
  [[noreturn]] void fail_ticking() const;
  [[noreturn]] void fail_sample_loop(std::span<const std::size_t> ticking) const;

  bool takes_part(std::size_t i) const override { return in_event_mode_[i]; }
  void on_discontinuity(VariableId input, bool is_followed) override;
  bool include(std::size_t i) override;

  Time next_receipt(std::size_t receiver, Time time) override {
    return own_steps_ != nullptr ? own_steps_->next_event_from(receiver, time) : time;
  }
  void receive(std::size_t receiver) override;
  void report(VariableId id, bool received, const ValueBlock* block) override;
  void report_disturbed(VariableId id, const std::string& text) override;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  MessageExchange messages_;
  std::vector<MessageText*> texts_;  ///< by component; null = none
  Clocks clocks_;
  std::optional<OrderedEvaluation> evaluation_;  ///< where outputs follow inputs at once
  const std::vector<Observer*>& observers_;
  const Activities& activities_;
  RunStatistics& statistics_;
  const WallClock& clock_;
  IdleScheduler* idle_;
  OwnSteps* own_steps_;

  struct Assignment {
    VariableId id;
    const ValueBlock* value;
  };
  std::vector<Assignment> assignments_;   ///< in the next event iteration
  std::vector<const SentMessage*> sent_;  ///< likewise

  Time time_{};
  std::uint32_t index_ = 0;                  ///< of the super-dense instant at that time
  std::vector<std::size_t> event_units_;     ///< those with Event Mode
  std::vector<std::size_t> discrete_units_;  ///< those of them with discrete inputs
  std::vector<ContinuousLink> links_;        ///< to event_units_, where `evaluation_` is not needed
  std::vector<ContinuousLink> jumping_links_;  ///< to those of them that keep steps of their own
  std::vector<char> active_;                   ///< takes part in the next event iteration
  bool has_active_ = false;
  bool has_event_ = false;  ///< a unit is in Event Mode
  std::vector<char> in_event_mode_;
  std::vector<char> had_event_;
  bool had_any_event_ = false;
  bool has_new_participant_ = false;  ///< a unit has entered Event Mode during an evaluation
  std::vector<char> polled_;          ///< its output clocks are to be read
  std::vector<std::optional<Time>> next_event_;
  std::optional<Time> announced_;  ///< the earliest of these
};

}  // namespace stride::core

#endif
