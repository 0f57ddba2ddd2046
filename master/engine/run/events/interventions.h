#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_INTERVENTIONS_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_INTERVENTIONS_H

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/context/intervention.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/events/event_handler.h"

namespace stride::core {

/// Makes the interventions of a run at their instants, which are communication points. A unit with
/// Event Mode is in it where one of its variables changes; the others have new values from the next
/// step on. A unit that is suspended, or behind in a step of its own, goes on from the instant.
class Interventions {
 public:
  /// Both must outlive this object.
  Interventions(RunContext& context, EventHandler& event_handler);

  /// At a communication point whose interventions are made: further ones, which begin at `earliest`
  /// or later. Throws std::logic_error for others.
  void add(std::vector<Intervention> interventions, Time earliest);
  /// Between EventHandler::begin_instant() and handle_events(): variables that are set now, and of
  /// which nothing is to be remembered. Their values must outlive handle_events().
  void make_sets(std::span<const Intervention> sets, Time time);
  /// In a run that goes on at `now`: what has begun by then, and has not ended, is in force. What
  /// is forced is in the exchange.
  void go_on(Time now);

  /// The earliest instant at which something is still to be changed, or `target` if that is
  /// earlier.
  Time next(Time target) const {
    return made_ == changes_.size() ? target : std::min(changes_[made_].time, target);
  }
  /// Between EventHandler::begin_instant() and handle_events() of a communication point: what is
  /// due.
  void make(Time time) {
    if (is_due(time)) [[unlikely]]
      make_all(time);
  }

 private:
  /// The beginning of an intervention, or its end.
  struct Change {
    Time time;
    const Intervention* intervention;
    bool is_end;
  };

  void plan(const Intervention& intervention);
  void sort();
  bool is_due(Time time) const { return made_ != changes_.size() && changes_[made_].time == time; }
  void make_all(Time time);
  void begin(const Intervention& intervention, Time time);
  void end(const Intervention& intervention, Time time);
  void set(const Intervention& intervention, Time time);
  void force(const Intervention& intervention, Time time);
  void report(const Intervention& intervention, Time time, const std::string& text) const;
  const Variable& variable(const Intervention& intervention) const {
    return system_.variable(intervention.id);
  }

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  const std::vector<Observer*>& observers_;
  EventHandler& event_handler_;
  std::deque<Intervention> added_;
  std::vector<Change> changes_;  ///< by time
  std::size_t made_ = 0;
};

}  // namespace stride::core

#endif
