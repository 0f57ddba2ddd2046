#ifndef STRIDE_MASTER_OBSERVE_CAPTURE_CAPTURED_UNIT_H
#define STRIDE_MASTER_OBSERVE_CAPTURE_CAPTURED_UNIT_H

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "master/base/state_archive.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/forwarding_unit.h"
#include "master/engine/port/unit.h"
#include "master/observe/capture/stimuli_file.h"

namespace stride::capture {

/// The number of an event iteration within its instant, from the count of all of a run.
class SuperDenseIndex {
 public:
  /// The count, kept up to date by a simulation.
  void follow(const std::uint64_t& event_iterations) { count_ = &event_iterations; }
  void on_communication_point(Time time) {
    if (time != point_) first_ = next_first_;
    point_ = time;
    next_first_ = count();
  }
  /// Whether all units have reached this time.
  bool has_reached(Time time) const { return time <= point_; }
  void persist(core::StateArchive& state) {
    state.value(point_);
    state.value(first_);
    state.value(next_first_);
  }
  /// Of the iteration at `time` that goes on now.
  std::uint64_t at(Time time) const {
    return count() - 1 - (time == point_ ? first_ : next_first_);
  }

 private:
  std::uint64_t count() const { return count_ == nullptr ? 0 : *count_; }

  const std::uint64_t* count_ = nullptr;
  Time point_ = Time::min();      ///< the last communication point
  std::uint64_t first_ = 0;       ///< the count where its instant began
  std::uint64_t next_first_ = 0;  ///< likewise, of the next instant
};

/// A unit, with all that it receives written down as it arrives: what it is given in Step Mode and
/// in which event iteration, and the steps that it makes. What is undone by a restored state is
/// taken back; a rejected step has not been.
///
/// One state is kept at a time. A reset and states from elsewhere cannot be taken back from the
/// file, so StateSerialization and Resetting are not among the capabilities. Neither is
/// ConcurrentSteps: each step is written down when it ends. Inputs within steps are not written;
/// Capture refuses runs that have them.
class CapturedUnit final : public core::ForwardingUnit,
                           public core::StateSaving,
                           public core::IdlePromises {
 public:
  /// All but the unit must outlive this object.
  CapturedUnit(std::unique_ptr<core::Unit> unit, const core::UnitDescription& description,
               StimuliFile& file, const SuperDenseIndex& index);

  /// All units have reached a communication point: what was written is final.
  void commit() { file_.commit(time_); }
  /// At a communication point that all units have reached, with the file. Reading: the unit is what
  /// it was, and no function of this object was called. No state can be restored before another one
  /// was saved.
  void persist(core::StateArchive& state);

  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  core::StepResult step(const core::StepInterval& interval) override;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  void terminate() override;

  void save_state() override;
  void restore_state() override;
  /// Throws std::logic_error.
  void select_state(std::size_t slot) override;

  void enable_idle_skipping(Duration max_skip) override;
  void set_idle_tolerances(std::span<const core::ValueReference> outputs,
                           std::span<const double> tolerances) override;
  Time idle_until() override { return idle_->idle_until(); }
  void get_derivatives(std::span<const core::ValueReference> outputs,
                       std::span<double> derivatives) override {
    idle_->get_derivatives(outputs, derivatives);
  }

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  enum class Mode { Start, Initialization, Event, Step };

  /// An input, and what it was given last.
  struct Input {
    const core::Variable* variable;
    bool is_message;  ///< it exists at ticks only, so a value that it had before is new again
    std::optional<core::ValueBlock> latest{};
  };
  /// What was set in Event Mode, in an iteration whose number is known at its end only.
  struct Waiting {
    Input* input;
    core::ValueBlock values;
  };
  struct Saved {
    std::size_t mark = 0;
    Time time{};
    Mode mode = Mode::Start;
    std::vector<Input> inputs;
  };

  Input* find_input(core::ValueReference reference);
  void note(std::span<const core::ValueReference> references, const core::ValueBlock& values);
  void note(Input& input, const core::ValueBlock& values, std::size_t first);
  void note_step(const core::StepInterval& interval, const core::StepResult& result);
  void write(const Input& input, std::string_view event, const core::ValueBlock& values);
  void write_waiting(std::uint64_t index);

  core::StateSaving* state_;  ///< of the unit; null if it has none
  core::IdlePromises* idle_;  ///< likewise
  const core::UnitDescription& description_;
  StimuliFile& file_;
  const SuperDenseIndex& index_;
  Mode mode_ = Mode::Start;
  Time time_{};
  std::vector<Input> inputs_;  ///< in the order of their references
  std::vector<Waiting> waiting_;
  std::uint64_t next_index_ = 0;  ///< of the iteration behind the last one
  Saved saved_;
};

}  // namespace stride::capture

#endif
