// The time-based input clocks of a system: when each of them ticks, and the ticks.
#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_CLOCKS_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_CLOCKS_H

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/time/grid.h"
#include "master/engine/model/time/interval.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/unit.h"

namespace stride::core {

class StateArchive;

/// Follows FMI 3.0, 2.2.8. Intervals are read from the units, except those that the description
/// gives; fmi3SetInterval is not called.
///
/// Tick k of a periodic clock is at start + shift + k * interval, rounded once to the
/// picosecond, and never at a sum of earlier ticks. An interval that a unit names in an event
/// counts from that event before it was rounded: from the point of a grid of steps or the tick of a
/// constant, fixed or calculated clock that is there, else from the clock's own tick, so intervals
/// of 1/30 s meet each whole second. A tick of such an interval of 1 us or more that would be a
/// picosecond beside a point or tick of those kinds, or beside the next tick of another clock, is
/// made together with it.
///
/// Ticks are made, and counted, at communication points that all units have reached, so a rollback
/// never undoes one. Call order: begin(), then at each instant {due(), tick(), update() for the
/// units that had an event} until nothing is due.
class Clocks {
 public:
  /// `units` in the order of system.components(); both must outlive this object. `steps`: the grids
  /// of communication points.
  Clocks(const System& system, std::span<const std::unique_ptr<Unit>> units,
         std::vector<Grid> steps = {});

  /// Reads the intervals and shifts that units determine; these are in Initialization Mode and have
  /// all their parameters. Throws Error (Run) with unit, clock and time where an interval is not
  /// possible, as update() does.
  void begin(Time start);

  /// At a communication point at which nothing more is due. Reading is instead of begin().
  void persist(StateArchive& state, Time start, Time now);

  /// Instead of begin(): continues from the state of another object for the same system.
  void resume(const Clocks& other);

  /// The next tick, after the last due().
  const std::optional<Time>& next() const { return next_; }
  /// Whether nothing is due before that.
  bool is_settled() const { return !is_stale_ && due_.empty(); }
  /// The components of which a clock ticks at `time`, in order.
  std::span<const std::size_t> due(Time time) {
    if (is_settled() && (!next_ || *next_ > time)) return {};
    return find_due(time);
  }
  /// Sets the clocks that are due, in the order of their descriptions; their units are in Event
  /// Mode. Returns the components, those of the last due().
  std::span<const std::size_t> tick(Time time);
  /// The clocks of the component that were set and not updated since.
  std::span<const ValueReference> ticking(std::size_t component) const;
  /// To be called after update_discrete_states() of the component: ends the ticks of its clocks and
  /// reads the intervals that may have changed.
  void update(std::size_t component, Time time);

 private:
  /// Instants at base + shift + k * interval.
  struct Rhythm {
    Time base{};
    Interval shift{};
    Interval interval{};

    std::optional<Time> instant(std::uint64_t k) const;
    /// The same ones from number k on.
    Rhythm from(std::uint64_t k) const;
    /// The one within a picosecond of this time.
    std::optional<std::uint64_t> number_at(Time time) const;
  };
  struct Schedule {
    VariableId id;
    ValueReference reference;
    const ClockAttributes* attributes;
    Rhythm rhythm{};
    std::uint64_t count = 0;  ///< the number of the next tick since then
    std::optional<Time> next{};

    /// Whether the rhythm is the same in the whole run.
    bool is_constant() const {
      return attributes->is_periodic() &&
             (attributes->interval || attributes->variability != IntervalVariability::Tunable);
    }
  };
  /// The time-based clocks of one component.
  struct ComponentClocks {
    std::size_t component;
    std::vector<Schedule> clocks;
    std::vector<ValueReference> ticking;
  };

  std::span<const std::size_t> find_due(Time time);
  ComponentClocks* clocks_of(std::size_t component);
  void start(Schedule& clock, Time start);
  static void persist(StateArchive& state, Schedule& clock, Time start, Time now);
  static void persist_rhythm(StateArchive& state, Schedule& clock, Time start, Time now);
  void update(Schedule& clock, Time time, bool ticked);
  void choose_next(Schedule& clock, Time now) const;
  Time merged(const Schedule& clock, Time tick) const;
  Rhythm exact_instant(const Schedule& clock, Time time, bool ticked) const;
  std::optional<Rhythm> constant_rhythm_at(Time time) const;
  /// The interval that the unit gives, checked.
  ClockInterval query_interval(const Schedule& clock, Time time);
  void check_interval(const Schedule& clock, Time time) const;
  [[noreturn]] void fail(const Schedule& clock, Time time, const std::string& message) const;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  std::vector<Grid> steps_;
  std::vector<ClockIntervals*> intervals_;  ///< by component; null = never known
  std::vector<ComponentClocks> clocked_;    ///< of the components that have such clocks
  std::vector<std::size_t> index_of_;       ///< by component; clocked_.size() = none
  std::vector<std::size_t> due_;
  std::vector<ValueBlock> ticks_;  ///< of one clock, of two, and as many as a unit can need at once
  std::optional<Time> next_;
  bool is_stale_ = false;  ///< next_ has to be computed again
};

}  // namespace stride::core

#endif
