// A unit that goes back to where its state was not saved.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_COASTING_UNIT_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_COASTING_UNIT_H

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/forwarding_unit.h"
#include "master/engine/run/context/statistics.h"
#include "master/engine/run/stepping/save_interval.h"
#include "master/engine/run/stepping/step_log.h"

namespace stride::core {

class CoastingRow;
class StateArchive;

/// Saves the state of its unit before some of the steps only, and notes in between what the unit is
/// given. restore_state() restores the last state that was saved, and makes the unit repeat the
/// steps up to the last save_state(): it coasts forward, as optimistic parallel simulation calls
/// it. For units that do the same again where they are given the same.
///
/// Events end a stretch, as do messages, inputs of the types String and Binary and those that the
/// unit requests within a step: the next save_state() then saves the state. So does the first one
/// behind a rollback, since it may be followed by others.
///
/// A unit that makes its steps elsewhere saves its state there, too, with the step's request, but
/// for saves that are measured.
///
/// If the unit does not repeat its outputs bit for bit, that is noted in the counts, and its state
/// is saved before each step from then on.
class CoastingUnit : public ForwardingUnit, public StateSaving, public ConcurrentSteps {
 public:
  struct Counts {
    std::uint64_t saves = 0;
    std::uint64_t repeated_steps = 0;
    std::optional<InexactRepetition> inexact_repetition{};  ///< the first one
  };

  /// The log of a unit has so many bytes at most.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 10;

  /// `unit` has the capability StateSaving. The description must outlive this object. `cache`: its
  /// share of the processor's caches, for what is noted [byte].
  CoastingUnit(std::unique_ptr<Unit> unit, const UnitDescription& description,
               SaveInterval interval, std::size_t cache);

  const Counts& counts() const { return counts_; }
  const SaveInterval& interval() const { return interval_; }
  std::size_t cache() const { return cache_; }
  /// The counts. What was saved is none of it: a run that is resumed begins a new stretch.
  void persist(StateArchive& state);

  /// The references must stay where they are until the next save of the state.
  void set(std::span<const ValueReference> references, const ValueBlock& values) override;
  StepResult step(const StepInterval& interval) override { return step(interval, StepValues{}); }
  /// `values.outputs` must stay what and where they are until the next save of the state.
  StepResult step(const StepInterval& interval, const StepValues& values) override;
  /// set() with the inputs, save_state() and step() in one; the inputs, too, must stay where they
  /// are. A state that is saved for this step alone has the inputs in it, so nothing is noted.
  StepResult save_and_step(const StepInterval& interval, const StepValues& values);
  void begin_step(const StepInterval& interval, const StepValues& values,
                  const Extras& extras) override;
  StepResult finish_step() override;
  std::chrono::nanoseconds step_time() const override { return concurrent_->step_time(); }
  void enter_event_mode() override;

  void save_state() override;
  void restore_state() override;
  /// Throws std::logic_error: it has one.
  void select_state(std::size_t slot) override;

  // ---- In a row of units ----

  /// What steps in the row.
  Unit& in_row() { return inner(); }
  /// From now on it steps in this row, which tells of it by the functions below; null: in none.
  /// What `values` refers to must outlive the row.
  void set_row(CoastingRow* row, std::size_t index, const StepValues& values);
  /// Whether its state is to be saved before the next step.
  bool is_save_due() const { return !is_continuous_ || steps() >= stretch_; }
  /// Before a step of the row: saves the state where that is due, for a stretch of so many steps.
  /// The row notes what it is given from here on.
  void join_row(std::size_t stretch);
  /// Makes this step, where it is made by itself.
  StepResult step_in_row(const StepInterval& interval, const StepValues& values);
  /// The position of the row's log at which its state is to be saved.
  std::uint64_t due_in_row() const { return row_.joined + stretch_ - log_.steps(); }
  /// Its step, the last one of the row's log, has ended so.
  void end_step_in_row(const StepResult& result);
  /// The last step in the row's log is none of this unit.
  void leave_before_step();
  /// Before anything is asked of the unit by itself: it takes over what the row notes of it.
  void leave_row() {
    if (row_.is_joined) [[unlikely]]
      leave_behind_step();
  }
  /// The row has forgotten all: the state is to be saved before the next step.
  void drop_row();

 private:
  /// Where what it is given is noted, beside its own log.
  struct InRow {
    CoastingRow* row = nullptr;
    std::size_t index = 0;
    StepValues values{};
    bool is_joined = false;
    std::uint64_t joined = 0;  ///< the position of the first step in the row's log behind its own
  };

  Capability* find_capability(CapabilityId id) override;

  /// Since its state was saved.
  std::size_t steps() const { return log_.steps() + (row_.is_joined ? steps_in_row() : 0); }
  std::size_t steps_in_row() const;
  void leave_before_save();
  void count_rollback();
  void leave_behind_step();
  void take_steps(std::uint64_t end);
  void take_last_step(Time reached);
  void take_inputs(std::uint64_t position);
  void take_step(std::uint64_t position, Time reached);
  void log_inputs(std::span<const BoundValues> inputs);
  StepInterval noted(const StepInterval& interval) const;
  StepResult make_step(const StepInterval& interval, const StepValues& values);
  void log_step(const StepInterval& interval, std::span<const BoundValues> outputs,
                const StepResult& result);
  bool save_behind_inputs(StepValues& values, bool may_save_elsewhere);
  void note_save();
  void choose_stretch();
  void begin_log();
  void begin_stretch();
  void save_measured();
  void bound_log();
  void repeat();
  void set_repeating(bool repeating);
  void keep_outputs(std::span<const BoundValues> outputs);
  void keep_outputs(std::span<const double> outputs);
  void compare_outputs();
  void note_difference(const BoundValues& output, std::size_t element, const ValueBlock& before);

  /// The outputs that were read at the end of a step.
  struct KeptOutputs {
    std::span<const BoundValues> read;
    std::vector<ValueBlock> values;
  };

  /// A step that was begun, and is logged when it is finished.
  struct PresentStep {
    StepInterval interval;
    std::span<const BoundValues> outputs;
    bool is_measured;
  };

  StateSaving& state_;
  ConcurrentSteps* concurrent_;   ///< of the unit; null if it steps here
  UnitDiagnostics* diagnostics_;  ///< likewise, if it has none
  const UnitDescription& description_;
  SaveInterval interval_;
  std::size_t cache_;
  Counts counts_;
  SaveInterval::Cost save_cost_{};
  std::size_t stretch_ = 0;     ///< its greatest number of steps
  bool is_continuous_ = false;  ///< whether the log has all that happened since the save
  bool is_measured_ = false;    ///< whether the next step is
  bool is_in_step_ = false;
  bool is_log_bounded_ = false;
  std::optional<PresentStep> step_;  ///< of a unit that steps elsewhere
  StepLog log_;
  StepLog::Mark mark_;  ///< of the last save_state()
  KeptOutputs latest_, at_mark_;
  InRow row_;
};

}  // namespace stride::core

#endif
