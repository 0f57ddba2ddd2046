// One communication step of all units, to a time that all of them reach.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_STEPPER_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_STEPPER_H

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/base/thread_pool.h"
#include "master/engine/model/time/grid.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/idle/idle_scheduler.h"
#include "master/engine/run/parallel/load_balancer.h"
#include "master/engine/run/stepping/coasting_unit.h"
#include "master/engine/run/stepping/input_extrapolator.h"
#include "master/engine/run/stepping/own_steps.h"
#include "master/engine/run/stepping/step_order.h"

namespace stride::core {

class StateArchive;

/// Steps the units, stage by stage as step_order() has them: inputs, step, outputs, a unit at a
/// time. All units of a stage step to the same target. If one stops early or rejects the step, the
/// target becomes the earliest time that such a unit reached or could have reached, or half the way
/// if that is not known; units that have gone further are rolled back and follow.
///
/// Units that compute elsewhere (ConcurrentSteps) step at the same time, and beside the others: all
/// of a stage, or with Gauss-Seidel all of a batch, begin before the first of them is waited for.
///
/// Units that can step in a row (StepsInARow) do so where nothing else is to be done for them.
///
/// The outcome of each unit's step is recorded in the step order, whichever thread made it, so
/// results, statistics and errors do not depend on the threads. Where several units of a stage
/// fail, the error of the first one is thrown, after all threads have finished. Concurrent steps of
/// units behind it may still go on then.
class Stepper {
 public:
  /// All must outlive this object. `order` is that of step_order(), `coasting`, by component, has
  /// the units whose states it saves. `inputs` sets the inputs before each step; null if they keep
  /// their values. `idle`, `own_steps`: optional.
  Stepper(RunContext& context, const std::vector<StepOrderEntry>& order,
          const std::vector<CoastingUnit*>& coasting, InputExtrapolator* inputs,
          IdleScheduler* idle, OwnSteps* own_steps);

  /// Takes all units from `from` to `target`, or to the earlier instant, returned, at which one of
  /// them stopped, and reads their outputs. Throws Error (Run) naming the unit: a step shorter
  /// than the minimum was rejected, or a unit stopped when another could not go back.
  Time advance(Time from, Time target);

  /// Whether advance_regularly() can be used now: all units step here, on one thread.
  bool may_be_regular() const {
    return !has_concurrent_ && !balancer_.is_deciding() && balancer_.threads() == 1;
  }
  /// As advance() to the end of an interval, of a step of the regular size that does not end at the
  /// stop time, and in which the clock does not measure. Returns whether all units have reached the
  /// end and request nothing; `reached` is set where not.
  bool advance_regularly(const StepInterval& interval, Time& reached);

  /// Takes all units back to `from`, where the last advance() began. Their states must have been
  /// saved, as they are with an error-controlled step.
  void undo(Time from);

  /// How the unit's last accepted step ended.
  const StepResult& result(std::size_t component) const {
    return unit_steps_[index_of_[component]].result;
  }
  /// Whether a unit may have requested an event or the end in the last communication step.
  bool has_requests() const { return has_requests_; }
  /// How many steps the unit has made, redone ones included.
  std::uint64_t steps(std::size_t component) const {
    const UnitStep& unit_step = unit_steps_[index_of_[component]];
    if (unit_step.keeps_own_step) return own_steps_->steps(component);
    return unit_step.steps + (unit_step.row != nullptr ? unit_step.row->whole_steps : 0);
  }

  /// Between two communication steps.
  void persist(StateArchive& state);

  /// Whether the last communication step was made on several threads.
  bool was_parallel() const { return was_parallel_; }

 private:
  struct Row;
  enum class Outcome : std::uint8_t { Idle, Pending, Stepped, Rejected, TooFar, Failed };

  /// The step of one unit in the present communication step. Written by the thread that steps the
  /// unit, and read after that has finished; it has a cache line of its own, so that threads do not
  /// share one.
  struct alignas(64) UnitStep {
    UnitStep(Unit& stepped, CoastingUnit* coasting, const StepOrderEntry& its_entry);

    // what a plain step needs fills the first cache line
    Unit* unit;
    CoastingUnit* state = nullptr;         ///< where saves_state
    StepResult result{};                   ///< the time that it has reached, and how
    std::uint64_t communication_step = 0;  ///< the last one that it has begun
    std::uint64_t steps = 0;
    std::uint32_t component;  ///< these three are the entry's
    bool saves_state;
    bool can_vary_step;
    bool is_plain = false;  ///< it needs nothing but the step itself
    bool begins_row = false;
    bool ends_stage = false;
    std::uint32_t rejections = 0;  ///< in the present communication step

    bool may_suspend = false;
    bool keeps_own_step = false;
    bool can_save_with_step = false;
    Outcome outcome = Outcome::Idle;  ///< of the present pass, as the flags behind it
    bool saves_with_step = false;
    bool rolled_back = false;
    Time possible{};  ///< that it could have reached in a rejected step
    Time undone{};    ///< the time that it had reached before
    const StepOrderEntry* entry;
    ConcurrentSteps* concurrent;  ///< null if it steps here
    Row* row = nullptr;           ///< in which it can step
  };
  /// Successive ones that can step in a row. What is noted of a unit is noted of the row where all
  /// of them have just reached the end of a step.
  struct Row {
    std::unique_ptr<UnitRow> units;
    std::span<UnitStep> steps;
    std::uint64_t whole_steps = 0;  ///< which each of them has made, beside its own
    std::uint64_t last = 0;         ///< in this communication step
    UnitRow::Progress progress{};   ///< of the last step
  };
  /// The last unit that cut the present communication step short.
  struct EarlyStop {
    const UnitStep* by = nullptr;
    Time at{};
    bool is_rejection = false;
  };
  struct Failure {
    std::exception_ptr cause;
    bool is_consequence = false;  ///< of another unit's failure
  };
  struct Stage {
    std::span<UnitStep> units;
    std::vector<ThreadShare> batches;  ///< where units step elsewhere; none if all step here
  };

  Time make_timed_passes(Time from, Time target);
  Time make_passes(Time from, Time target);
  Time make_further_passes(const StepInterval& first, Time reached);
  Time make_pass(const StepInterval& interval, bool is_first);
  Time step_one_by_one(const StepInterval& interval, bool is_first_pass,
                       UnitStep* stepped = nullptr);
  Time step_stage(const Stage& stage, std::span<const ThreadShare> shares,
                  const StepInterval& interval);
  void step_together(std::span<const ThreadShare> shares, std::span<const ThreadShare> batches,
                     const StepInterval& interval);
  bool step_share(const ThreadShare& share, const StepInterval& interval) noexcept;
  template <class Attempt>
  bool succeeds(UnitStep& unit_step, Attempt&& attempt) noexcept;
  StepResult save_and_step(UnitStep& unit_step, const StepInterval& interval);
  bool step_plainly(UnitStep& unit_step, const StepInterval& interval);
  void note_outcome(UnitStep& unit_step, const StepInterval& interval);
  void form_rows();
  std::vector<StepsInARow::Member> row_members(std::size_t first) const;
  static std::unique_ptr<UnitRow> coasting_row(std::unique_ptr<UnitRow> units,
                                               std::span<const UnitStep> steps,
                                               std::span<const StepsInARow::Member> members);
  bool step_rows(std::span<Row> rows, UnitStep*& last, const StepInterval& interval);
  Row* step_whole_rows(std::span<Row> rows, const StepInterval& interval);
  UnitStep& note_stop_in(Row& row, const StepInterval& interval);
  void note_plain_ones(Row& row, const StepInterval& interval);
  void note_step(UnitStep& unit_step, const StepResult& result);
  void note_whole_rows(Time reached);
  void count_whole_rows();
  Outcome attempt_timed(UnitStep& unit_step, const StepInterval& interval);
  Outcome attempt(UnitStep& unit_step, const StepInterval& interval);
  StepResult make_step(UnitStep& unit_step, const StepInterval& interval);
  Outcome begin_timed(UnitStep& unit_step, const StepInterval& interval);
  Outcome begin(UnitStep& unit_step, const StepInterval& interval);
  Outcome finish(UnitStep& unit_step, const StepInterval& interval);
  Outcome prepare(UnitStep& unit_step, const StepInterval& interval);
  Outcome conclude(UnitStep& unit_step, const StepResult& result);
  bool stays_suspended(UnitStep& unit_step, const StepInterval& interval);
  bool waits(UnitStep& unit_step, const StepInterval& interval);
  void save(UnitStep& unit_step, const StepInterval& interval);
  void roll_back(UnitStep& unit_step, const StepInterval& interval);
  void restore(UnitStep& unit_step, Time from);
  Time reached_by(UnitStep& unit_step, const StepInterval& interval, Time reached);
  Time record(UnitStep& unit_step, const StepInterval& interval);
  void report(const UnitStep& unit_step, Activity::Kind kind, Time from, Time until) const {
    activities_.report({unit_step.component, kind, from, until});
  }
  void record_time(const UnitStep& unit_step);
  std::size_t index(const UnitStep& unit_step) const {
    return static_cast<std::size_t>(&unit_step - unit_steps_.data());
  }
  const std::string& name(const UnitStep& unit_step) const;
  [[noreturn]] void rethrow_failure(const UnitStep& first) const;
  static Time retry_target(const UnitStep& unit_step, const StepInterval& interval);
  void check_minimum(const StepInterval& interval, Time reached) const;
  std::string reason(const EarlyStop& stop) const;
  [[noreturn]] void fail_size(const UnitStep& unit_step, const StepInterval& interval) const;
  std::string hint_for_final(const UnitStep& stopped) const;
  [[noreturn]] void fail_final(const UnitStep& ahead) const;
  void form_stages();
  StepInterval interval(Time from, double from_seconds, Time to) const {
    return {from, from_seconds, to, grid_.seconds(to), grid_.seconds(to - from)};
  }
  static std::vector<ThreadShare> batches(std::span<const UnitStep> units, std::size_t first);
  LoadBalancer::Plan plan(const RunOptions& options);
  ThreadPool& pool();

  const System& system_;
  std::size_t unit_count_;
  Exchange& exchange_;
  std::vector<UnitStatistics>& statistics_;
  const Activities& activities_;
  const WallClock& clock_;
  WallClock step_clock_;  ///< measures while the load balancer decides, too
  InputExtrapolator* inputs_;
  IdleScheduler* idle_;
  OwnSteps* own_steps_;
  bool has_grid_;     ///< whether regular steps end on a grid
  Grid grid_;         ///< that one, to which units are bound that take steps of one size only
  Time stop_;         ///< of the run
  Duration minimum_;  ///< no shorter step is tried after a rejection
  const std::vector<StepOrderEntry>& order_;
  std::vector<UnitStep> unit_steps_;  ///< in that order
  std::vector<Stage> stages_;         ///< of them
  std::vector<Row> rows_;             ///< likewise
  bool are_all_in_rows_ = false;
  bool has_concurrent_ = false;                  ///< whether units step elsewhere
  std::vector<std::size_t> index_of_;            ///< by component
  std::vector<std::chrono::nanoseconds> times_;  ///< by unit_step, of the present pass
  std::vector<Failure> failures_;                ///< likewise
  std::uint64_t communication_step_ = 0;
  Time last_end_{};  ///< of a pass, and the same as a double, since the next begins there
  double last_end_seconds_ = 0;
  EarlyStop early_stop_;
  bool has_requests_ = false;
  bool is_short_end_ =
      false;  ///< whether the present step is the last one, and shorter than others
  LoadBalancer balancer_;
  std::optional<ThreadPool> pool_;  ///< started when it is first needed
  bool was_parallel_ = false;
};

}  // namespace stride::core

#endif
