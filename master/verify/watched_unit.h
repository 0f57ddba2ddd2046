#ifndef STRIDE_MASTER_VERIFY_WATCHED_UNIT_H
#define STRIDE_MASTER_VERIFY_WATCHED_UNIT_H

#include <string>
#include <vector>

#include "master/algorithm/capabilities/clock_intervals.h"
#include "master/algorithm/capabilities/configuration_mode.h"
#include "master/algorithm/capabilities/message_text.h"
#include "master/algorithm/capabilities/resetting.h"
#include "master/algorithm/capabilities/state_saving.h"
#include "master/algorithm/capabilities/state_serialization.h"
#include "master/algorithm/forwarding_unit.h"
#include "master/isolation/process/shared_note.h"
#include "master/verify/tested_unit.h"

namespace stride::verify {

/// A unit that notes each function of its interface before it is called, so that the function is
/// known in which it crashed or hung. The functions of capabilities that no check uses (idle
/// promises, derivatives, inputs within steps) are called without a note.
class WatchedUnit final : public core::ForwardingUnit,
                          public core::ConfigurationMode,
                          public core::StateSaving,
                          public core::StateSerialization,
                          public core::Resetting,
                          public core::ClockIntervals,
                          public core::MessageText {
 public:
  /// Makes the unit itself, and notes that, too. `tested` and `note` must outlive this object.
  WatchedUnit(const TestedUnit& tested, isolation::SharedNote& note, const std::string& name,
              importer::InstanceOptions options);
  ~WatchedUnit() override;

  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  core::StepResult step(const core::StepInterval& interval) override;
  /// In its parts, each of which is noted.
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override {
    return Unit::step(interval, values);
  }
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  void terminate() override;

  void enter_configuration_mode() override;
  void exit_configuration_mode() override;
  void save_state() override;
  void restore_state() override;
  void select_state(std::size_t slot) override { state_->select_state(slot); }
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;
  std::string describe_message(core::ValueReference variable, const core::Binary& value) override;

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  /// Notes the function of the standard while `work` is done.
  template <class Work>
  decltype(auto) watched(const char* function, Work&& work);

  isolation::SharedNote& note_;
  bool is_fmi2_;
  Time now_{};
  // the unit's capabilities; null where it does not have them
  core::ConfigurationMode* configuration_;
  core::StateSaving* state_;
  core::StateSerialization* serialization_;
  core::Resetting* resetting_;
  core::ClockIntervals* intervals_;
  core::MessageText* text_;
};

}  // namespace stride::verify

#endif
