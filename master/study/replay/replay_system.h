// The system file of a device that is alone with its stimuli.
#ifndef STRIDE_MASTER_STUDY_REPLAY_REPLAY_SYSTEM_H
#define STRIDE_MASTER_STUDY_REPLAY_REPLAY_SYSTEM_H

#include <cstddef>
#include <string>
#include <vector>

#include "master/study/replay/stimuli_summary.h"
#include "master/system/plan/run_plan.h"

namespace stride::replay {

/// What the device has to do again.
struct Expectation {
  enum class Kind {
    Final,  ///< the value of an output, or of an element of one, at the end
    Count,  ///< how many messages an output sends
  };
  Kind kind = Kind::Final;
  std::string output;       ///< "led", "torque[2]"
  std::string equals;       ///< as a check has it
  std::string tolerance{};  ///< of a real number; empty: 0
};

struct ReplayRequest {
  std::string name;  ///< of the system
  /// The scenario in which the stimuli were captured, with all settings of that run.
  const scenario::RunPlan& loaded;
  std::size_t component;  ///< whose stimuli they are
  const StimuliSummary& stimuli;
  std::string unit;    ///< the source of the component's FMU, as seen from the file
  std::string player;  ///< likewise of that which plays the stimuli
  std::vector<Expectation> expectations{};
};

/// What the component is called in its replay: the last part of a name of nested systems.
std::string device_name(const std::string& component);

/// Whether it is an output with a value at each time, which a replay records.
bool is_recorded(const core::UnitDescription& device, const core::Variable& variable);
/// Whether it is an output whose messages a replay reports; of a clock that carries any these are.
bool is_reported(const core::UnitDescription& device, const core::Variable& variable);

/// The text of a .ssd: the component with the parameters that it had, also those that were set in
/// the course of the run, the player, connected to all inputs that it has, the steps and the idle
/// skipping with which the component's bits are what they were (docs/stimuli.md), the recorded
/// outputs, the coverage of the component, and the expectations as checks.
std::string replay_system(const ReplayRequest& request);

}  // namespace stride::replay

#endif
