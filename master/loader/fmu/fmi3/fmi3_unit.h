// An instance of an FMI 3.0 Co-Simulation unit in this process.
#ifndef STRIDE_MASTER_LOADER_FMU_FMI3_FMI3_UNIT_H
#define STRIDE_MASTER_LOADER_FMU_FMI3_FMI3_UNIT_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <stride/fmi3.h>

#include "master/base/error.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "master/loader/fmu/instance/fmu_instance_calls.h"
#include "master/loader/fmu/instance/saved_states.h"
#include "master/loader/fmu/library/fmi3_library.h"

namespace stride::importer {

/// See core::Unit for the order of calls, and FmuInstance for failures; terminate() does nothing
/// after one.
///
/// A step that succeeds without an early return ends at its end, also where the unit's own time
/// (lastSuccessfulTime) is another, as with a fixed internal step; the log contains it once.
///
/// What an input update throws within a step is thrown by step(), which has ended then.
///
/// After the first exchange, get(), set(), step() and get_derivatives() do not allocate, except
/// where a string or binary value outgrows the longest before it; idle_until() never does.
class Fmi3Unit final
    : public FmuInstance,
      public core::Capabilities<core::ConfigurationMode, core::StateSaving,
                                core::StateSerialization, core::Resetting, core::IdlePromises,
                                core::DirectionalDerivatives, core::ClockIntervals,
                                core::InputsWithinStep, core::MessageText, core::StepsInARow> {
 public:
  /// Throws core::Error of the kind Run, with the unit's messages, if it cannot be instantiated.
  Fmi3Unit(std::string name, std::shared_ptr<const Fmi3Library> library, UnitParts parts,
           InstanceOptions options = {});
  ~Fmi3Unit() override;

  void enter_configuration_mode() override;
  void exit_configuration_mode() override;
  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  void get_directional_derivative(References unknowns, References knowns,
                                  std::span<const double> seed,
                                  std::span<double> sensitivity) override;
  using FmuInstance::step;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  /// Of units in this process that exchange one block of inputs and one of outputs at most, of the
  /// type Float64.
  std::unique_ptr<core::UnitRow> make_row(std::span<const Member> members) override;
  void save_state() override;
  core::StepResult save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                  const core::StepValues& values) override;
  void restore_state() override;
  void select_state(std::size_t slot) override;
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;
  void set_input_update(core::InputUpdate update) override { input_update_ = std::move(update); }
  void enable_idle_skipping(Duration max_skip) override;
  void set_idle_tolerances(std::span<const core::ValueReference> outputs,
                           std::span<const double> tolerances) override;
  /// What was not enabled is not promised: Time::min().
  Time idle_until() override;
  void get_derivatives(std::span<const core::ValueReference> outputs,
                       std::span<double> derivatives) override;
  /// Of kLongestDescription bytes at most.
  std::string describe_message(core::ValueReference variable, const core::Binary& value) override;
  void terminate() override;
  void free() override;

  static constexpr std::size_t kLongestDescription = 1024;

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  static void on_intermediate_update(fmi3InstanceEnvironment environment, fmi3Float64 time,
                                     fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                     fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                     fmi3Boolean* early_return_requested,
                                     fmi3Float64* early_return_time);
  void update_inputs(double time) noexcept;

  static void on_log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                     fmi3String message);

  class Row;
  bool can_be_in_row(const Member& member) const;

  void get_reals(CallSequence& calls, const core::BoundValues& values);
  void set_reals(CallSequence& calls, const core::BoundValues& values);
  void set(CallSequence& calls, const core::StepValues& all);
  /// What fmi3DoStep returns beside its status.
  struct StepAnswer {
    bool needs_event = false, terminate = false, early = false;
    double last_successful;
  };
  core::StepResult step_behind_inputs(CallSequence& calls, const core::StepInterval& interval,
                                      const core::StepValues& all);
  bool do_step(CallSequence& calls, const core::StepInterval& interval, double size,
               double tolerance, core::StepResult& result);
  /// Whether a step has just reached its end.
  [[gnu::always_inline]] bool is_plain_end(const core::StepInterval& interval, Status status,
                                           const StepAnswer& answer, double tolerance) const {
    return !(answer.needs_event | answer.terminate | answer.early) && status != Status::Discard &&
           callback_failure_ == nullptr && is_end(interval, answer.last_successful, tolerance);
  }
  core::StepResult evaluate(const core::StepInterval& interval, Status status,
                            const StepAnswer& answer);

  void get_strings(References references, std::span<std::string> values);
  void set_strings(References references, std::span<const std::string> values);
  void get_binaries(References references, std::span<core::Binary> values);
  void set_binaries(References references, std::span<const core::Binary> values);

  /// What the unit was at some time.
  struct SavedState {
    fmi3FMUState state = nullptr;  ///< null, too, for a unit that has none
    bool is_present = false;
    std::optional<Time> time;
  };
  void free_state(SavedState& saved);

  template <class Function, class... Arguments>
  void call_clock(const char* name, Function* function, const core::Variable& clock,
                  Arguments... arguments);
  template <class Make>
  core::Interval checked_interval(const char* function, const core::Variable& clock,
                                  Make&& make) const;

  /// An output with a tolerance.
  struct TangentOutput {
    core::ValueReference reference;
    std::size_t size;
    bool has_derivative;
  };
  static std::vector<TangentOutput> tangent_outputs(const core::UnitDescription& description);
  const TangentOutput& tangent_output(core::ValueReference reference) const;

  Time reached_early(const core::StepInterval& interval, double last_successful) const;
  void compare_times(const core::StepInterval& interval, double last_successful);

  const Fmi3Functions& fmi_;
  double step_point_ = 0;  ///< where the present step began, as the unit knows it
  bool has_time_warning_ = false;
  std::shared_ptr<const Fmi3Library> library_;

  core::InputUpdate input_update_;

  SavedStates<SavedState> states_;

  bool may_skip_ = false;
  std::vector<TangentOutput> tangent_outputs_;  ///< in the order of their references
  std::vector<core::ValueReference> derived_;   ///< of one call of get_derivatives()
  std::vector<fmi3Int32> orders_;
  std::vector<double> slopes_;

  std::vector<fmi3String> texts_;
  std::vector<fmi3Binary> bytes_;
  std::vector<std::size_t> sizes_;
};

}  // namespace stride::importer

#endif
