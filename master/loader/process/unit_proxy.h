#ifndef STRIDE_MASTER_LOADER_PROCESS_UNIT_PROXY_H
#define STRIDE_MASTER_LOADER_PROCESS_UNIT_PROXY_H

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/loader/process/host_client.h"
#include "master/loader/process/hosted_unit_spec.h"
#include "master/loader/wire/codec.h"
#include "master/loader/wire/proxy_record.h"
#include "master/loader/wire/step_plan.h"

namespace stride::isolation {

/// Represents a unit in another process: each function is a request, and what the unit answers or
/// throws is answered and thrown here. Its capabilities are those of the unit, besides
/// HostDiagnostics and ConcurrentSteps, and StateSaving where states are snapshots of the process.
class UnitProxy final : public core::Unit, public ProxyCapabilities {
 public:
  using References = std::span<const core::ValueReference>;

  /// Throws what the unit's own constructor throws.
  explicit UnitProxy(HostedUnitSpec spec);
  ~UnitProxy() override;

  void enter_configuration_mode() override;
  void exit_configuration_mode() override;
  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(References references, core::ValueBlock& values) override;
  void set(References references, const core::ValueBlock& values) override;
  core::StepResult step(const core::StepInterval& interval) override;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  void begin_step(const core::StepInterval& interval, const core::StepValues& values,
                  const Extras& extras) override;
  core::StepResult finish_step() override;
  std::chrono::nanoseconds step_time() const override { return step_time_; }
  std::string rejection_reason() const override { return rejection_reason_; }
  void save_state() override;
  void restore_state() override;
  void select_state(std::size_t slot) override;
  void set_repeating(bool repeating) override { client_->set_repeating(repeating); }
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;
  void get_directional_derivative(References unknowns, References knowns,
                                  std::span<const double> seed,
                                  std::span<double> sensitivity) override;
  void set_input_update(core::InputUpdate update) override;
  void enable_idle_skipping(Duration max_skip) override;
  void set_idle_tolerances(References outputs, std::span<const double> tolerances) override;
  Time idle_until() override;
  void get_derivatives(References outputs, std::span<double> derivatives) override;
  std::string describe_message(core::ValueReference variable, const core::Binary& value) override;
  void terminate() override;
  void free() override;
  std::uint64_t calls() const override { return client_->calls(); }
  core::HostStatistics host_statistics() const override;

 private:
  using Clock = std::chrono::steady_clock;

  core::Capability* find_capability(core::CapabilityId id) override;

  struct PresentStep {
    core::StepInterval interval;
    core::StepValues values;
    std::optional<Clock::time_point> began{};  ///< of one that is timed
  };

  /// Sends put(PacketWriter&) and takes the answer with take(PacketReader&).
  template <class Put, class Take>
  void call(RequestCode request, Put&& put, Take&& take);
  /// The two halves of it.
  template <class Put>
  void send(RequestCode request, Put&& put);
  template <class Take>
  void receive(Take&& take);
  template <class Action>
  void guard(Action&& action);
  template <class Put>
  void call(RequestCode request, Put&& put);
  void call(RequestCode request);
  /// Serves what the unit asks for until it has replied.
  ReplyCode serve_input_requests(ReplyCode reply);
  void throw_reply(ReplyCode reply);
  std::uint32_t plan_number(const core::StepValues& values);
  core::StepResult take_result(PacketReader& from, const PresentStep& step);
  void drop_step() noexcept;

  HostedUnitSpec spec_;
  std::unique_ptr<HostClient> client_;
  Protections protections_;
  CapabilitySet capabilities_;
  ProxyTimes times_;
  KnownStepShapes plans_;
  ProxyInputUpdate input_update_;
  std::string rejection_reason_;
  std::optional<PresentStep> step_;  ///< that was begun
  std::chrono::nanoseconds step_time_{};
  bool is_freed_ = false;
};

}  // namespace stride::isolation

#endif
