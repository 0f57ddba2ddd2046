#ifndef STRIDE_MASTER_VERIFY_WATCHED_UNIT_H
#define STRIDE_MASTER_VERIFY_WATCHED_UNIT_H

#include <memory>
#include <string>
#include <vector>

#include "master/algorithm/unit.h"
#include "master/isolation/process/shared_note.h"
#include "master/verify/tested_unit.h"

namespace stride::verify {

/// A unit that notes each function of its interface before it is called, so that the function is
/// known in which it crashed or hung.
class WatchedUnit final : public core::Unit {
 public:
  /// Makes the unit itself, and notes that, too. All three must outlive this object.
  WatchedUnit(const TestedUnit& tested, process::SharedNote& note, const std::string& name,
              fmi::InstanceOptions options);
  ~WatchedUnit() override;

  void enter_configuration_mode() override;
  void exit_configuration_mode() override;
  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  using Unit::step;
  core::StepResult step(const core::StepInterval& interval) override;
  std::string rejection_reason() const override { return unit_->rejection_reason(); }
  void save_state() override;
  void restore_state() override;
  void select_state(std::size_t slot) override { unit_->select_state(slot); }
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;
  std::string describe_message(core::ValueReference variable, const core::Binary& value) override;
  void terminate() override;

 private:
  /// Notes the function of the standard while `work` is done.
  template <class Work>
  decltype(auto) watched(const char* function, Work&& work);
  /// Likewise one by its whole name.
  template <class Work>
  decltype(auto) noted(const char* name, Work&& work);

  const TestedUnit& tested_;
  process::SharedNote& note_;
  bool is_fmi2_;
  Time now_{};
  std::unique_ptr<core::Unit> unit_;
};

}  // namespace stride::verify

#endif
