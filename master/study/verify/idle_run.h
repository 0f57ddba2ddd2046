// A run of a unit that is suspended while it promises to be idle.
#ifndef STRIDE_MASTER_STUDY_VERIFY_IDLE_RUN_H
#define STRIDE_MASTER_STUDY_VERIFY_IDLE_RUN_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/capabilities/idle_promises.h"
#include "master/study/verify/idle_stimulus.h"
#include "master/study/verify/recording.h"
#include "master/study/verify/test_instance.h"

namespace stride::verify {

/// The outputs that have no clock, by their places in the description: what a promise is about.
std::vector<std::size_t> promised_outputs(const core::UnitDescription& unit);

/// Simulates an instance over the grid. With skipping it is treated as a master does: where it
/// promises to be idle beyond the next point it is not called, and its outputs are on their
/// tangents, until the promise or the deadband of an input ends; then it catches up by one step.
class IdleRun {
 public:
  /// `instance` is new, and has this stimulus. Both must outlive this object.
  IdleRun(const TestedUnit& tested, TestInstance& instance, const Stimulus& stimulus,
          bool is_skipping);

  /// Each row of a point has the outputs, and last the number of promises that were used up to
  /// there. Throws Failure where a promise is broken: a step over it is rejected, returns early or
  /// has an event, or an output was not where it was promised to be.
  Recording run();

 private:
  struct Suspension {
    Time since, until;
    std::vector<core::ValueBlock> held;     ///< by input of the stimulus
    std::vector<core::ValueBlock> outputs;  ///< by promised output
    std::vector<double> slopes;             ///< of the elements of outputs with a tolerance
  };

  const core::Variable& output(std::size_t i) const {
    return tested_.description().variables[outputs_[i]];
  }
  bool is_disturbed(std::size_t k) const;
  void suspend_if_idle(std::size_t k);
  std::vector<double> slopes();
  std::vector<core::ValueBlock> predicted(Time time) const;
  void catch_up(std::size_t k);
  void check_step(bool was_made, const Recording& before) const;
  void check_outputs(const std::vector<core::ValueBlock>& expected);
  std::vector<core::ValueBlock> read_outputs();
  void record(std::size_t k, const std::vector<core::ValueBlock>& outputs);
  [[noreturn]] void fail(const std::string& violation) const;

  const TestedUnit& tested_;
  TestInstance& instance_;
  const Stimulus& stimulus_;
  core::IdlePromises* promises_ = nullptr;  ///< null: no skipping
  std::vector<std::size_t> outputs_;
  std::optional<Suspension> suspension_;
  std::size_t used_promises_ = 0;
  Duration longest_promise_{}, longest_suspension_{};
  std::vector<Row> rows_;
};

}  // namespace stride::verify

#endif
