// A unit on another machine.
#ifndef STRIDE_MASTER_LOADER_NETWORK_REMOTE_UNIT_H
#define STRIDE_MASTER_LOADER_NETWORK_REMOTE_UNIT_H

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/network/connection.h"
#include "master/loader/network/remote_spec.h"
#include "master/loader/process/host_options.h"
#include "master/loader/wire/codec.h"
#include "master/loader/wire/proxy_record.h"
#include "master/loader/wire/step_plan.h"

namespace stride::remote {

/// Each function is a request to a `stride serve`, and what the unit answers or throws there is
/// answered and thrown here. Its capabilities are those of a hosted unit. A step is one round trip,
/// with its inputs, the saving of the state before it, and its outputs. What has no result goes
/// with the next request that has one, which then throws what it would have thrown.
///
/// A failure of the link is a core::Error of the kind Run with the machine and its last words;
/// after it each call but terminate() and free() throws. Files that the unit has written there are
/// in `options.results` when it is freed.
class RemoteUnit final : public core::Unit, public isolation::ProxyCapabilities {
 public:
  using References = std::span<const core::ValueReference>;

  /// Starts to connect, and waits for nothing: several may do so at the same time. `fmu`: what
  /// describe() has given. To be called while this process has one thread.
  RemoteUnit(RemoteSpec spec, std::shared_ptr<importer::Fmu> fmu, std::string name,
             importer::InstanceOptions options, isolation::HostOptions host);
  ~RemoteUnit() override;

  /// Throws what the unit's own constructor throws. To be called once, before all others.
  void instantiate();

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
  core::StepResult save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                  const core::StepValues& values) override;
  void select_state(std::size_t slot) override;
  void set_repeating(bool repeating) override;
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
  std::uint64_t calls() const override { return calls_; }
  core::HostStatistics host_statistics() const override;

 private:
  using Clock = std::chrono::steady_clock;

  struct PresentStep {
    core::StepInterval interval;
    core::StepValues values;
  };

  core::Capability* find_capability(core::CapabilityId id) override;

  /// Sends what fill(wire::Request::Builder) fills, and gives the answer to take(Result::Reader).
  template <class Fill, class Take>
  void call(const char* name, Fill&& fill, Take&& take);
  template <class Fill>
  void call(const char* name, Fill&& fill);
  /// The two halves of it.
  template <class Fill>
  void send(const char* name, Fill&& fill);
  template <class Take>
  void receive(Take&& take);
  /// A request without a result, which goes with the next one that has one.
  template <class Fill>
  void defer(Fill&& fill);
  template <class Action>
  void guard(Action&& action);

  wire::Result::Reader await_result();
  wire::Result::Reader take_reply(wire::Reply::Reader reply, bool& is_result);
  void update_inputs(double seconds_into_step);
  void log_from_there(wire::LogMessage::Reader message) const;
  void log_from_there(importer::Status status, const std::string& category,
                      const std::string& text) const;
  void log(importer::Status status, const std::string& category, const std::string& text) const;
  void note_time(wire::Result::Reader result);
  isolation::CapabilitySet declared_capabilities() const;
  void fill(wire::Instantiate::Builder to) const;
  void send_file();
  std::uint32_t plan_number(const core::StepValues& values);
  void drop_step() noexcept;
  void fetch_statistics();
  void fetch_files();
  void close() noexcept;

  RemoteSpec spec_;
  std::shared_ptr<importer::Fmu> fmu_;
  std::string name_;
  importer::InstanceOptions options_;
  isolation::HostOptions host_;
  std::shared_ptr<const core::UnitDescription> description_;
  std::optional<Connection> connection_;
  isolation::CapabilitySet capabilities_;
  core::HostStatistics statistics_;
  std::uint64_t calls_ = 0;
  isolation::ProxyTimes times_;
  isolation::KnownStepShapes plans_;
  isolation::ProxyInputUpdate input_update_;
  std::string rejection_reason_;
  std::optional<PresentStep> step_;          ///< that was begun
  Clock::time_point sent_at_, waited_from_;  ///< the latest request, and the wait for its answer
  std::chrono::nanoseconds least_lost_ = std::chrono::nanoseconds::max();  ///< of a round trip
  std::chrono::nanoseconds step_time_{};
  bool has_unit_ = false;  ///< there
  bool is_freed_ = false;
};

template <class Fill, class Take>
void RemoteUnit::call(const char* name, Fill&& fill, Take&& take) {
  send(name, fill);
  receive(take);
}

template <class Fill>
void RemoteUnit::call(const char* name, Fill&& fill) {
  call(name, fill, [](wire::Result::Reader) {});
}

template <class Fill>
void RemoteUnit::send(const char* name, Fill&& fill) {
  guard([&] {
    connection_->set_time(times_.now);
    connection_->ask(name, fill);
  });
  sent_at_ = waited_from_ = Clock::now();
}

template <class Take>
void RemoteUnit::receive(Take&& take) {
  guard([&] { take(await_result()); });
}

template <class Fill>
void RemoteUnit::defer(Fill&& fill) {
  guard([&] {
    connection_->set_time(times_.now);
    connection_->put(fill);
  });
}

template <class Action>
void RemoteUnit::guard(Action&& action) {
  if (!connection_) {
    core::fail_run({.where = options_.where, .unit = name_, .time = times_.now},
                   "it cannot be called, because it was freed");
  }
  checked(*connection_, action);
}

}  // namespace stride::remote

#endif
