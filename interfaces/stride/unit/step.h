#ifndef STRIDE_UNIT_STEP_H
#define STRIDE_UNIT_STEP_H

#include <optional>
#include <string>
#include <utility>

#include <stride/time.h>

namespace stride {

/// Sets inputs within a step.
class InputUpdater {
 public:
  virtual void update_inputs(double seconds_into_step) = 0;

 protected:
  ~InputUpdater() = default;
};

/// One communication step, from one communication point to the next.
class Step {
 public:
  /// `updater` sets the intermediate inputs; none if null.
  Step(Time from, Time to, bool early_return_allowed, InputUpdater* updater = nullptr)
      : from_(from), to_(to), early_return_allowed_(early_return_allowed), updater_(updater) {}

  Time from() const { return from_; }
  Time to() const { return to_; }
  Duration size() const { return to_ - from_; }

  /// Brings the inputs that are listed as intermediate() to this instant, from 0 to
  /// to_seconds(size()) after the beginning of the step, for an importer that lets them follow
  /// something; with another they stay what they are. Instants may come in any order, as the stages
  /// of a solver do.
  void update_inputs(double seconds_into_step) const {
    if (updater_ != nullptr) updater_->update_inputs(seconds_into_step);
  }

  /// Whether return_early() may be called. An importer that does not allow it gets its events at
  /// to().
  bool early_return_allowed() const { return early_return_allowed_; }

  /// The unit stopped at this instant (from() <= at <= to()): a communication point is wanted
  /// there. Needs UnitInfo::early_return.
  void return_early(Time at) { reached_ = at; }
  /// Event Mode is wanted where the step ends. A tick of an output clock implies it.
  void need_event() { event_needed_ = true; }
  /// The unit cannot make this step and is as it was before it: fmi3Discard, with the reason in the
  /// importer's log. Needs UnitInfo::may_reject.
  void reject(std::string reason) { rejection_ = std::move(reason); }
  /// Requests the end of the simulation where the step ends.
  void terminate_simulation() { terminate_ = true; }

  std::optional<Time> reached() const { return reached_; }
  bool event_needed() const { return event_needed_; }
  const std::optional<std::string>& rejection() const { return rejection_; }
  bool terminates() const { return terminate_; }

 private:
  Time from_;
  Time to_;
  bool early_return_allowed_;
  InputUpdater* updater_;
  std::optional<Time> reached_;
  bool event_needed_ = false;
  std::optional<std::string> rejection_;
  bool terminate_ = false;
};

/// One super-dense instant of Event Mode.
class Event {
 public:
  /// `announced`: the next event, if the unit announced one before.
  explicit Event(Time time, std::optional<Time> announced = std::nullopt)
      : time_(time), next_(announced) {}

  Time time() const { return time_; }

  /// Announces the next instant at which the unit needs Event Mode, in the place of the one that
  /// was announced before. It stays announced at each event until one at or after it has come, so
  /// call it only if the time changes. The importer comes there, or, if its
  /// communication points are elsewhere, to the first one after it. Time::max() is never, as
  /// no_next_event() says.
  void next_event(Time time) {
    if (time == Time::max()) return no_next_event();
    next_ = time;
  }
  /// Withdraws what was announced.
  void no_next_event() { next_.reset(); }
  /// Another event iteration at this same instant is wanted. A tick of an output clock implies it.
  void iterate() { iterate_ = true; }
  /// Requests the end of the simulation here.
  void terminate_simulation() { terminate_ = true; }

  std::optional<Time> next() const { return next_; }
  bool iterates() const { return iterate_; }
  bool terminates() const { return terminate_; }

 private:
  Time time_;
  std::optional<Time> next_;
  bool iterate_ = false;
  bool terminate_ = false;
};

}  // namespace stride

#endif
