// Makes a unit do again what a journal has.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_REPLAY_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_REPLAY_H

#include <optional>
#include <vector>

#include "master/base/error.h"
#include "master/engine/port/capability.h"
#include "master/engine/port/unit.h"
#include "master/observe/checkpoint/journal.h"
#include "master/observe/checkpoint/record.h"

namespace stride::checkpoint {

/// Calls a unit as a journal says, and compares what it answers.
class Replay {
 public:
  struct Options {
    core::Context context{};     ///< for errors
    std::optional<Time> stop{};  ///< in place of the one that the unit had
  };

  /// All must outlive this object; nothing is added to the journal meanwhile.
  Replay(core::Unit& unit, const core::UnitDescription& description, Journal& journal,
         const Options& options);

  /// From the beginning of the journal, where it was `from`, to its end. If the unit asks for its
  /// inputs within a step, its input update is one of this object, and is to be set again
  /// afterwards. Throws core::BadState, and core::Error (Run) with the unit and the simulated time
  /// where the unit fails or answers something else.
  void run(const Journal::Context& from);

 private:
  using Context = Journal::Context;

  void repeat_next();
  void repeat(Call call);
  void initialize();
  void set();
  void get();
  void step();
  core::StepInterval take_interval();
  core::StepValues take_step_values();
  void compare_end(const core::StepInterval& interval, const core::StepResult& result,
                   const core::StepValues& values);
  void answer_inputs(double seconds_into_step);
  void update_discrete_states();
  void set_idle_tolerances();
  void answer_input_requests(bool answers);
  const core::Variable& take_clock();
  template <core::CapabilityInterface C>
  C& capability();
  void compare_check();
  [[noreturn]] void fail_other(const std::string& what) const;

  core::Unit& unit_;
  const core::UnitDescription& description_;
  Journal& journal_;
  const Options& options_;
  RecordReader records_;
  Context context_;
  bool is_in_step_ = false;
  std::vector<core::BoundValues> inputs_, outputs_;  ///< of the present step
};

}  // namespace stride::checkpoint

#endif
