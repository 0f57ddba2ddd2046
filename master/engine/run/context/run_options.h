// The options of a run.
#ifndef STRIDE_MASTER_ENGINE_RUN_CONTEXT_RUN_OPTIONS_H
#define STRIDE_MASTER_ENGINE_RUN_CONTEXT_RUN_OPTIONS_H

#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/time/interval.h"
#include "master/engine/model/variable_id.h"
#include "master/engine/run/context/intervention.h"

namespace stride::core {

class StepPolicy;
class System;
struct RunOptions;
struct StepOptions;

/// Which output values the units use during a step.
enum class Coupling : std::uint8_t {
  Jacobi,       ///< all use those of the communication point
  GaussSeidel,  ///< units step in sequence, with the new outputs of those before
};

/// The degree of the polynomial that extrapolates an input during a step.
enum class Extrapolation : std::uint8_t { Hold, Linear, Quadratic };

inline constexpr std::array kCouplings{Coupling::Jacobi, Coupling::GaussSeidel};
inline constexpr std::array kExtrapolations{Extrapolation::Hold, Extrapolation::Linear,
                                            Extrapolation::Quadratic};

/// The name in scenarios and on the command line: "gauss-seidel".
const char* name(Coupling coupling);
const char* name(Extrapolation extrapolation);

/// The static properties of a step policy, and its factory. Each is defined in the file of its
/// class, in step_policies/.
struct StepPolicyType {
  const char* name;  ///< in scenarios and on the command line
  /// Whether communication points are on a grid of StepOptions::size.
  bool has_grid = false;
  /// Whether StepPolicy::accept() decides on each step by the error of the inputs, so that all
  /// units have to be able to undo a step.
  bool controls_error = false;
  std::unique_ptr<StepPolicy> (*create)(const System& system, const RunOptions& options);
  /// For people: "in steps of 0.01 s".
  std::string (*describe)(const StepOptions& options);
};

extern const StepPolicyType kFixedSteps;
extern const StepPolicyType kEventDrivenSteps;
extern const StepPolicyType kErrorControlledSteps;

/// The policies that scenarios and the command line accept, in the order in which they are listed.
inline constexpr std::array kStepPolicies{&kFixedSteps, &kEventDrivenSteps, &kErrorControlledSteps};

inline const char* name(const StepPolicyType* policy) { return policy->name; }

struct StepOptions {
  const StepPolicyType* policy = &kFixedSteps;
  Interval size{};  ///< of the grid; error-controlled: of the first step
  /// No step is longer. Nothing: as long as the units allow; error-controlled: a tenth of the run.
  std::optional<Interval> maximum{};
  /// No shorter one is tried after a rejection.
  Interval minimum = std::chrono::nanoseconds(1);
  /// Error-controlled: an input v may be off by absolute_tolerance + relative_tolerance * |v|, in
  /// the unit of the output that feeds it.
  double relative_tolerance = 1e-3;
  double absolute_tolerance = 1e-6;
};

/// On how many threads a run may step its units. Changes the speed of a run, never its results.
struct ThreadOptions {
  std::size_t count = 1;  ///< the thread that runs the simulation included
  /// Components, by index in System::components(), that step only on the thread that runs the
  /// simulation, one after another, wherever they compute: for units that must not run
  /// concurrently.
  std::vector<std::size_t> main_only{};
  /// For tests: use threads from the first step on, without measuring.
  bool always = false;
};

/// A number for one variable.
struct IdleSetting {
  VariableId id;
  double value = 0;
};

/// Which units may be suspended while they promise to be idle (org.stride.idle).
struct IdleOptions {
  /// For how long at most the component may be suspended; nothing: it never is, as one that keeps
  /// its own step.
  std::optional<Duration> longest_suspension(const System& system, std::size_t component) const;
  /// That of an output, if it has one, and of an input.
  std::optional<double> tolerance(const System& system, VariableId output) const;
  double deadband(const System& system, VariableId input) const;

  /// For how long at most, by component; nothing, or no entry: never.
  std::vector<std::optional<Duration>> max_skip{};
  std::vector<IdleSetting> deadbands{};   ///< of inputs, instead of those of the units
  std::vector<IdleSetting> tolerances{};  ///< of outputs, likewise
  Duration least{};                       ///< a unit is not suspended for less
};

/// How often the states are saved that a rollback needs. Changes the speed of a run, not its
/// results, if units repeat steps exactly.
struct StateSavingOptions {
  /// Components whose states are saved before each step.
  std::vector<std::size_t> each_step{};
  /// Of the others, between two saves.
  std::size_t most_steps = 256;
  /// For tests: always as many, without measuring what saves and steps cost.
  bool always = false;
};

struct RunOptions {
  /// Idle skipping requires that outputs are used at communication points only, which excludes
  /// extrapolated inputs and error control.
  bool may_skip_idle_time() const {
    return !sets_inputs_in_steps() && !step.policy->controls_error;
  }
  /// Whether inputs are set anew for each step. With Jacobi and held inputs they stay what they
  /// were at the communication point.
  bool sets_inputs_in_steps() const {
    return coupling != Coupling::Jacobi || extrapolation != Extrapolation::Hold;
  }

  Time start{};
  Time stop{};
  StepOptions step{};
  Coupling coupling = Coupling::Jacobi;
  Extrapolation extrapolation = Extrapolation::Hold;
  ThreadOptions threads{};  ///< not with Gauss-Seidel, where units step one after another
  StateSavingOptions state_saving{};
  std::vector<Intervention> interventions{};
  IdleOptions idle{};                  ///< as far as may_skip_idle_time()
  std::vector<VariableId> recorded{};  ///< the default signals of observers, in order
  std::vector<VariableId> watched{};   ///< further signals that observers may request
  bool steps_in_rows = true;           ///< for tests: else each unit steps by itself
  bool steps_in_stretches = true;  ///< for tests: else each communication step is made by itself
  bool measure_time = true;        ///< wall-clock time per unit and phase (TimeSampling)
  /// Takes what is odd and does not end the run; without it, it does.
  std::function<void(const std::string&)> warn{};
  /// The run ends at its next communication point after this is no longer 0.
  const volatile std::sig_atomic_t* interrupted = nullptr;
};

}  // namespace stride::core

#endif
