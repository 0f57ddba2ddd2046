// A unit whose state can be written, and read in another process.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNALED_UNIT_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNALED_UNIT_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/base/state_archive.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/forwarding_unit.h"
#include "master/observe/checkpoint/journal.h"
#include "master/observe/checkpoint/kept_state.h"

namespace stride::checkpoint {

/// Notes what its unit is called with, from the first call on, and what persist() writes is:
///
/// - of a unit that serialises its state: the calls of its initialization, up to where it enters
///   Step Mode for the first time, its state, hashes of the outputs that it shows then, and the
///   calls since it was serialised if it cannot be at the present instant;
/// - of another: all calls.
///
/// Whether a unit serialises its state is tried once, at the end of its initialization. One that
/// fails then though it declares that it can is as one that cannot, and a warning says so. Where it
/// fails later, the calls since the last success are written. One that can do nothing more behind
/// such a failure fails with it.
///
/// A new unit is made what the other was by repeating the calls, with its log switched off. For
/// that a unit has to do the same again where it is given the same: a hash over all that it has
/// answered is compared, step by step.
///
/// Noted are the calls that may change what a unit does: all but idle_until(), get_derivatives(),
/// directional derivatives and descriptions of messages, which by their contracts do not. Steps
/// that were undone by restore_state() are not among them.
///
/// It keeps one state at a time for its callers. StateSerialization and Resetting are not among its
/// capabilities.
class JournaledUnit final : public core::ForwardingUnit,
                            public core::ConfigurationMode,
                            public core::StateSaving,
                            public core::IdlePromises,
                            public core::ClockIntervals,
                            public core::InputsWithinStep,
                            public core::ConcurrentSteps {
 public:
  struct Options {
    core::Context context{};  ///< the component and its position in the scenario, for errors
    /// What a unit that is read is given in place of the stop time that it had: that of a run which
    /// goes on for longer.
    std::optional<Time> stop{};
    std::function<void(const std::string&)> warn{};
  };

  /// No function of the unit was called yet. The description, with the sizes that structural
  /// parameters give to arrays, must outlive this object.
  JournaledUnit(std::unique_ptr<core::Unit> unit, const core::UnitDescription& description,
                Options options);

  /// At a communication point, in Step Mode. Writing: the unit goes on as if nothing had been but
  /// that outputs were read, also where this throws. Reading: of a unit of the same FMU, for which
  /// nothing was called yet but set_input_update(), makes what the other was; after a failure it
  /// can only be destroyed.
  ///
  /// Throws core::BadState for damaged bytes, before anything is called, and core::Error (Run) with
  /// the unit and the simulated time where the unit fails, or does not repeat what it did.
  void persist(core::StateArchive& state);
  /// What persist() has last written or read.
  const KeptState& kept() const { return kept_; }

  void enter_configuration_mode() override;
  void exit_configuration_mode() override;
  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  core::StepResult step(const core::StepInterval& interval) override;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  void begin_step(const core::StepInterval& interval, const core::StepValues& values,
                  const Extras& extras) override;
  core::StepResult finish_step() override;
  std::chrono::nanoseconds step_time() const override { return concurrent_->step_time(); }
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;

  void save_state() override;
  void restore_state() override;
  /// Throws std::logic_error: it has one.
  void select_state(std::size_t slot) override;

  void enable_idle_skipping(Duration max_skip) override;
  void set_idle_tolerances(std::span<const core::ValueReference> outputs,
                           std::span<const double> tolerances) override;
  Time idle_until() override { return idle_->idle_until(); }
  void get_derivatives(std::span<const core::ValueReference> outputs,
                       std::span<double> derivatives) override {
    idle_->get_derivatives(outputs, derivatives);
  }

  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;

  void set_input_update(core::InputUpdate update) override;

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  /// A state of the unit as bytes, and what the journal was then.
  struct SerializedState {
    Journal::Mark mark;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint64_t> outputs{};  ///< as shown_outputs()
  };

  void update_inputs(double seconds_into_step);
  void connect_input_update();
  void note_end_of_step(const core::StepResult& result, std::span<const core::BoundValues> outputs);
  void end_initialization();

  template <class Action>
  auto in_own_slot(Action&& action);
  SerializedState serialize();
  bool can_go_on();
  void try_serialization();
  void add_state();
  void drop_needless_states();

  void write(core::StateArchive& state);
  void read(core::StateArchive& state);
  void persist_content(core::StateArchive& state);
  void persist_serialized(core::StateArchive& state);
  void rebuild();
  void replay(Journal& journal, const Journal::Context& from);
  void restore_serialized();
  void require_outputs(const SerializedState& serialized);
  void note_kept(std::size_t bytes);
  core::Context context() const;

  core::ConfigurationMode* configuration_;  ///< of the unit; null if it has none
  core::StateSaving* state_;                ///< likewise, and so on
  core::StateSerialization* serialization_;
  core::IdlePromises* idle_;
  core::ClockIntervals* clocks_;
  core::InputsWithinStep* inputs_within_step_;
  core::ConcurrentSteps* concurrent_;
  core::UnitDiagnostics* diagnostics_;
  const core::UnitDescription& description_;
  const Options options_;

  /// All calls; of a unit that serialises its state those since the first of `states_`.
  Journal journal_;
  /// The calls before them.
  Journal initialization_;
  /// In the order of their instants; none for a unit that does not serialise its state. Of the
  /// first one no mark is behind the state that restore_state() would restore.
  std::vector<SerializedState> states_;
  std::optional<Journal::Mark> saved_;  ///< of save_state()
  Time start_{};
  bool is_initialized_ = false;
  bool is_in_step_ = false;                     ///< or failed in one
  std::span<const core::BoundValues> outputs_;  ///< of a step that was begun
  core::InputUpdate input_update_;
  KeptState kept_;
};

}  // namespace stride::checkpoint

#endif
