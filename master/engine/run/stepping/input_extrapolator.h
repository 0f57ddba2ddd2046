// The units' continuous inputs during a communication step.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_INPUT_EXTRAPOLATOR_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_INPUT_EXTRAPOLATOR_H

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/context/run_context.h"
#include "master/engine/run/stepping/signal_history.h"

namespace stride::core {

class OwnProgress;
class StateArchive;

/// The largest error of an input's extrapolation.
struct ExtrapolationError {
  double ratio = 0;  ///< of the error and what is tolerated
  VariableId output{};
};

/// Sets the inputs of a unit before each step, from the polynomials through the values of the
/// connected outputs at the last communication points and, with Gauss-Seidel, at the end of the
/// step, for those units that have made it already.
///
/// FMI 3.0 Co-Simulation holds an input during a step, so the value set is the polynomial's mean
/// over the step: what a unit integrates is then right up to the next order. Inputs that may change
/// within a step have the polynomial's own value at its beginning and whenever the unit requests
/// it.
class InputExtrapolator {
 public:
  explicit InputExtrapolator(RunContext& context);
  /// Some components keep their own steps: their outputs have values at the ends of these only.
  void set_own_steps(const OwnProgress& own_steps) { own_steps_ = &own_steps; }

  /// Sets a unit's inputs to their values within the step for which before_step() was called last.
  void within_step(std::size_t component, Unit& unit, double seconds_into_step);

  /// At a communication point, after the outputs have been read: adds them to the histories. The
  /// history of a unit that had an event begins anew: nothing is extrapolated across a jump.
  void accept(Time time, std::span<const char> had_event);

  /// After accept() at `now`.
  void persist(StateArchive& state, Time start, Time now);

  /// Leaves the inputs in the exchange, to be written. Throws Error (Run) where, with
  /// Gauss-Seidel, the new value of an output that feeds one of them is NaN.
  void before_step(std::size_t component, const StepInterval& interval);
  /// The outputs of the component have been read.
  void after_step(std::size_t component, Time reached);
  /// The unit's step is undone.
  void undo_step(std::size_t component);

  /// After a step of all units but those that keep their own steps to `time`, with their outputs
  /// read: the largest difference
  /// between an output and its polynomial, as a multiple of absolute + relative * |value|.
  ExtrapolationError extrapolation_error(Time time, double absolute, double relative);

 private:
  /// The continuous outputs of one component that others are connected to.
  struct Source {
    std::vector<ValueSlice> signals;
    std::vector<VariableId> ids;
    SignalHistory history{0, 0};
    bool is_ahead = false;  ///< the newest sample belongs to a step that is not accepted yet
    bool is_nan = false;    ///< that sample contains NaN
  };
  struct FedInput {
    std::size_t signal;
    bool within_step;  ///< whether it may be set within a step
    ValueSlice target;
    LinearConversion conversion;
  };
  /// The inputs of one component that another one feeds.
  struct Feed {
    std::size_t source;
    std::vector<FedInput> inputs;
  };

  struct Step {
    Time from, to;
  };

  /// The index of each signal in its source.
  using SignalIndices = std::map<ValueSlice, std::size_t>;
  std::size_t signal_of(const ContinuousLink& link, SignalIndices& indices);
  void sample(Source& source, Time time);
  bool keeps_own_step(std::size_t component) const;
  bool is_behind(std::size_t component, Time time) const;
  /// Sets the targets that may change within a step, or the others.
  static void set_targets(const Feed& feed, const SignalHistory& history,
                          const SignalHistory::Weights& weights, bool within_step);

  Exchange& exchange_;
  const OwnProgress* own_steps_ = nullptr;
  bool sequential_;
  std::vector<Source> sources_;           ///< by component
  std::vector<Step> steps_;               ///< the current or last one, by target component
  std::vector<std::vector<Feed>> feeds_;  ///< by target component
};

}  // namespace stride::core

#endif
