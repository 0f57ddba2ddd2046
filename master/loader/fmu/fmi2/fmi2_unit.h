// An instance of an FMI 2.0 Co-Simulation unit in this process.
#ifndef STRIDE_MASTER_LOADER_FMU_FMI2_FMI2_UNIT_H
#define STRIDE_MASTER_LOADER_FMU_FMI2_FMI2_UNIT_H

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <stride/fmi2.h>

#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/loader/fmu/description/fmi2_attributes.h"
#include "master/loader/fmu/fmi2/asynchronous_step.h"
#include "master/loader/fmu/fmi2/input_derivatives.h"
#include "master/loader/fmu/instance/saved_states.h"
#include "master/loader/fmu/instance/scalar_unit.h"
#include "master/loader/fmu/library/fmi2_library.h"

namespace stride::importer {

/// The types and names of FMI 2.0.
struct Fmi2Version {
  using Functions = Fmi2Functions;
  static constexpr const char* kName = "FMI 2.0";
  STRIDE_SCALAR_VERSION(fmi2, "fmi2")
};

/// See core::Unit for the order of calls, FmuInstance for failures, and ScalarUnit for values;
/// terminate() does nothing after a failure. Such a unit has neither Event Mode nor clocks.
///
/// Start values
/// are kept until fmi2SetupExperiment has been called, where some units reset them, and those of
/// inputs until Initialization Mode, since FMI 2.0 allows them no earlier.
///
/// fmi2Discard means that the unit completed a part of the step (docs/stepping.md):
///
/// - if the unit requests the end of the simulation (fmi2Terminated), the partial step is accepted;
/// - if its state can be saved (canGetAndSetFMUstate), the state before the step is restored and
/// the
///   step is rejected; StepResult::reached is the time that the unit had reached;
/// - otherwise the partial step is accepted like an early return, with one warning. An unknown
/// time,
///   or one at the beginning of the step, is a core::Error of the kind Run.
///
/// After fmi2Pending step() waits until the unit reports its end, by stepFinished or
/// fmi2GetStatus. There is no time-out; one message is logged if it takes long.
///
/// With an input update, inputs that a unit interpolates (canInterpolateInputs) are given with
/// their first and second derivatives at the beginning of each step.
///
/// After the first exchange, get(), set() and step() do not allocate, except where a string
/// outgrows the longest before it.
class Fmi2Unit final
    : public ScalarUnit<Fmi2Version>,
      public core::Capabilities<core::StateSaving, core::StateSerialization, core::Resetting,
                                core::DirectionalDerivatives, core::InputsWithinStep> {
 public:
  /// Throws core::Error of the kind Run, with the unit's messages, if it cannot be instantiated.
  Fmi2Unit(std::string name, std::shared_ptr<const Fmi2Library> library,
           std::shared_ptr<const Fmi2Attributes> attributes, UnitParts parts,
           InstanceOptions options = {});
  ~Fmi2Unit() override;

  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  using ScalarUnit::get;
  void set(References references, const core::ValueBlock& values) override;
  void get_directional_derivative(References unknowns, References knowns,
                                  std::span<const double> seed,
                                  std::span<double> sensitivity) override;
  using FmuInstance::step;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  void save_state() override;
  core::StepResult save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                  const core::StepValues& values) override;
  void restore_state() override;
  void select_state(std::size_t slot) override;
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void set_input_update(core::InputUpdate update) override { input_update_ = std::move(update); }
  void terminate() override;
  void free() override;

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  /// What the unit was at some time.
  struct SavedState {
    fmi2FMUstate state = nullptr;  ///< null, too, for a unit that has none
    bool is_present = false;
    std::optional<Time> time;
    bool is_instantiated_only = false;
  };

  static void on_log(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                     fmi2String category, fmi2String message, ...);
  static void on_step_finished(fmi2ComponentEnvironment environment, fmi2Status status);

  void get(CallSequence& calls, const core::BoundValues& values);
  void set(CallSequence& calls, const core::BoundValues& values);
  void keep(References references, const core::ValueBlock& values);

  void set_input_derivatives(double size);
  bool save(SavedState& saved);
  void restore(const SavedState& saved);
  void free_state(SavedState& saved);

  core::StepResult make_step(CallSequence& calls, const core::StepInterval& interval,
                             std::span<const core::BoundValues> outputs);
  Status do_step(CallSequence& calls, const core::StepInterval& interval, double size);
  Status wait_for_step();
  [[noreturn]] void cancel_step();
  Status poll_step();
  std::string pending_text();
  core::StepResult handle_discard(const core::StepInterval& interval);
  core::StepResult accept_termination(const core::StepInterval& interval,
                                      std::optional<Time> reached);
  core::StepResult accept_partial_step(const core::StepInterval& interval, Time reached);
  [[noreturn]] void fail_partial_step(const core::StepInterval& interval,
                                      std::optional<double> seconds) const;
  template <class Function, class Value>
  bool query_status(const char* name, Function* function, fmi2StatusKind kind, Value* value);
  std::optional<double> last_successful_time();
  bool requests_termination();

  bool saves_each_step_;
  bool is_as_saved_ = false;  ///< the unit is what the chosen state holds
  core::InputUpdate input_update_;
  InputDerivatives* sampled_inputs_ = nullptr;  ///< receives the inputs instead of the unit
  SavedState before_step_;
  SavedStates<SavedState> states_;
  bool has_discard_warning_ = false;
  std::shared_ptr<const Fmi2Library> library_;
  std::shared_ptr<const Fmi2Attributes> attributes_;

  fmi2CallbackFunctions callbacks_{};  ///< units keep the pointer
  AsynchronousStep asynchronous_;
  bool has_slow_step_warning_ = false;
  InputDerivatives input_derivatives_;

  bool is_instantiated_only_ = true;
  using KeptValues = std::vector<std::pair<std::vector<core::ValueReference>, core::ValueBlock>>;
  KeptValues kept_parameters_, kept_inputs_;  ///< until fmi2SetupExperiment, Initialization Mode

  std::vector<fmi2ValueReference> own_knowns_;
};

}  // namespace stride::importer

#endif
