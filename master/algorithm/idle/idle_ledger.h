// Idle units: who is left alone, and what that costs when somebody needs them again.
#ifndef STRIDE_MASTER_ALGORITHM_IDLE_IDLE_LEDGER_H
#define STRIDE_MASTER_ALGORITHM_IDLE_IDLE_LEDGER_H

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/activities.h"
#include "master/algorithm/capabilities/idle_promises.h"
#include "master/algorithm/exchange/exchange.h"
#include "master/algorithm/run_options.h"
#include "master/algorithm/statistics.h"
#include "master/algorithm/unit.h"
#include "master/model/system.h"

namespace stride::core {

/// A unit that promises to be idle (org.stride.idle) rests: it is not called. Meanwhile its outputs
/// go along their tangents, and its debt, the time since it was called last, grows. The debt is
/// paid, by one step over all of it with the inputs that the unit has had, before it is given other
/// inputs, handles an event, or goes past its promise or its max_skip.
///
/// Each function for one component concerns nothing of another, so different threads may call them
/// for different components.
class IdleLedger {
 public:
  /// `units` in the order of system.components(). `activities`: who hears of rests. All must
  /// outlive this object.
  IdleLedger(const System& system, std::span<const std::unique_ptr<Unit>> units, Exchange& exchange,
             std::vector<UnitStatistics>& statistics, const Activities& activities,
             const IdleOptions& options);

  /// Whether no unit of the system is ever to rest.
  bool is_trivial() const { return candidates_.empty(); }

  /// Before the units enter Initialization Mode: lets them skip and promise.
  void enable();

  bool may_rest(std::size_t component) const { return accounts_[component].is_candidate; }
  bool rests(std::size_t component) const { return accounts_[component].rests; }
  /// Whether the unit, which rests, can do so up to this instant.
  bool covers(std::size_t component, Time time) const { return time <= accounts_[component].end; }
  /// How far the run may go without calling anybody; nothing where a unit does not rest.
  std::optional<Time> all_rest_until() const;

  /// The simulated time of all rests up to `time`, where the run stands, those that last included.
  Duration rested(Time time) const;

  /// The unit, which rests, is brought to `time`, and its outputs are fetched. Throws Error (Run)
  /// that names unit, time and promise where the unit does not keep it. Returns whether it has an
  /// event there, as it may where its promise ends.
  bool wake(std::size_t component, Time time);
  /// On the thread of the simulation, some time after wake(): tells of the rest that ended.
  void tell_rest(std::size_t component);
  /// Both at once, on that thread.
  bool wake_and_tell(std::size_t component, Time time);

  /// All units stand at or owe up to `time`: the outputs of those that rest are what their tangents
  /// say, and those whose rests end here are woken. Returns those of them that have an event.
  std::span<const std::size_t> come_to(Time time);
  /// After the exchange: wakes those of which an input has left its deadband. Returns whether
  /// outputs have changed by that.
  bool wake_disturbed(Time time);
  /// Between instants, where all inputs that are to be delivered have been: asks those that do not
  /// rest for promises.
  void rest(Time time);
  /// The run ends: all debts are paid.
  void settle(Time time);
  /// Tells of the rests that have not been told: a failure has ended them at `time`.
  void tell_unfinished_rests(Time time);

 private:
  struct WatchedInput {
    RealElement element;
    double deadband = 0;
    double held = 0;  ///< what the unit was given when it promised
  };
  struct Tangent {
    RealElement element;
    double value = 0;
    double slope = 0;
  };
  struct Account {
    bool is_candidate = false;
    IdlePromises* promises = nullptr;  ///< of a candidate
    bool rests = false;
    Time since{};               ///< where the unit stands
    Time until{};               ///< its promise
    Time end{};                 ///< of the rest, at most
    std::optional<Time> ended;  ///< where it did, if that is still to be told
    Duration max_skip{};
    std::vector<WatchedInput> inputs;
    std::vector<Tangent> tangents;
    std::vector<ValueReference> references;  ///< of the outputs with tangents
    std::vector<double> slopes;              ///< of their elements
  };

  void open(std::size_t component, Duration max_skip);
  void begin_rest(std::size_t component, Time time, Time until, Time end);
  bool is_disturbed(const Account& account) const;
  void check_promise(std::size_t component, Time time, const StepResult& result) const;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  std::vector<UnitStatistics>& statistics_;
  const Activities& activities_;
  IdleOptions options_;
  std::vector<Account> accounts_;  ///< by component
  std::vector<std::size_t> candidates_;
  std::vector<std::size_t> events_;
};

}  // namespace stride::core

#endif
