#ifndef STRIDE_MASTER_LOADER_WIRE_UNIT_PROXY_H
#define STRIDE_MASTER_LOADER_WIRE_UNIT_PROXY_H

#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/loader/wire/calls.h"
#include "master/loader/wire/codec.h"
#include "master/loader/wire/packet.h"
#include "master/loader/wire/step_plan.h"
#include "master/loader/wire/unit_times.h"

namespace stride::isolation {

/// The answer to a request. Its packet can be read until the next request is written.
struct Reply {
  ReplyCode code = ReplyCode::Done;
  PacketReader packet{};
};

/// What any unit may be capable of; which of it this one is, is known when it is there.
using ProxyCapabilities =
    core::Capabilities<core::ConfigurationMode, core::StateSaving, core::StateSerialization,
                       core::Resetting, core::IdlePromises, core::DirectionalDerivatives,
                       core::ClockIntervals, core::InputsWithinStep, core::MessageText,
                       core::UnitDiagnostics, core::HostDiagnostics, core::ConcurrentSteps>;

/// Represents a unit elsewhere: each function is a request, and what the unit answers or throws
/// there is answered and thrown here. A carrier, which takes requests there and brings replies, is
/// a class derived from it.
class UnitProxy : public core::Unit, public ProxyCapabilities {
 public:
  using References = std::span<const core::ValueReference>;

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
  core::StepResult save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                  const core::StepValues& values) override;
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void set_repeating(bool repeating) override;
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

 protected:
  using Clock = std::chrono::steady_clock;
  using Patience = std::optional<std::chrono::milliseconds>;

  /// `where` is the component's place, `patience` how long a step is waited for whose outcome
  /// nobody wants any longer.
  UnitProxy(core::Location where, std::string name, std::chrono::milliseconds patience)
      : where_(std::move(where)), name_(std::move(name)), patience_(patience) {}

  // What a carrier does.

  /// For a request, which replaces the one before.
  virtual PacketWriter write() = 0;
  /// Sends it.
  virtual void post(RequestCode request, const PacketWriter& packet) = 0;
  /// Sends it without waiting for an answer, if the carrier can do so.
  virtual bool defer(RequestCode /*request*/, const PacketWriter& /*packet*/) { return false; }
  /// Awaits the answer to what was posted, no longer than the patience, if there is one.
  virtual Reply await(Patience patience) = 0;
  /// Nothing can be sent any longer.
  virtual bool has_failed() const = 0;
  [[noreturn]] virtual void fail_bad_packet(const BadPacket& mistake) = 0;
  /// Adds what is known here to an error from there.
  virtual void supplement(SentError& /*error*/) const {}
  virtual void warn(const std::string& text) const noexcept = 0;

  // What it is made with.

  /// Those that the unit has, beside those that each unit elsewhere has.
  void set_capabilities(const CapabilitySet& capabilities);
  core::Context context() const { return {.where = where_, .unit = name_, .time = times_.now}; }
  std::optional<Time> now() const { return times_.now; }
  bool is_stepping() const { return step_.has_value(); }
  /// Of the last step.
  void set_step_time(std::chrono::nanoseconds time) { step_time_ = time; }
  void forget_plans() { plans_.forget(); }
  bool is_freed() const { return is_freed_; }
  /// After a failure of another unit, whose error ends the run.
  void drop_step() noexcept;

  /// Sends what put(PacketWriter&) puts.
  template <class Put>
  void send(RequestCode request, Put&& put);
  /// The same; true if the carrier defers it, so that no answer is to be awaited.
  template <class Put>
  bool send_or_defer(RequestCode request, Put&& put);
  /// Awaits the answer, and returns what take(PacketReader&) takes of it.
  template <class Take>
  auto receive(Take&& take);
  /// Makes a failure of the wire one of the unit.
  template <class Action>
  auto guard(Action&& action);
  /// Those that the host of the unit there has.
  core::HostStatistics fetch_statistics();

 private:
  struct PresentStep {
    core::StepInterval interval;
    core::StepValues values;
    std::optional<Clock::time_point> began{};  ///< of one that is timed
  };

  core::Capability* find_capability(core::CapabilityId id) override;
  /// A call of the table.
  template <auto function, class... Arguments>
  auto call(Arguments&... arguments);
  Reply await_done();
  bool update_inputs(double seconds_into_step);
  [[noreturn]] void throw_failure(Reply& reply);
  std::uint32_t plan_number(const core::StepValues& values);
  core::StepResult take_result(PacketReader& from, const PresentStep& step);

  core::Location where_;
  std::string name_;
  std::chrono::milliseconds patience_;
  CapabilitySet capabilities_;
  UnitTimes times_;
  KnownStepShapes plans_;
  core::InputUpdate input_update_;
  std::exception_ptr input_failure_;  ///< of that function: it waits for the answer of the unit
  std::string rejection_reason_;
  std::optional<PresentStep> step_;  ///< that was begun
  std::chrono::nanoseconds step_time_{};
  bool is_freed_ = false;
};

template <class Put>
void UnitProxy::send(RequestCode request, Put&& put) {
  guard([&] {
    PacketWriter packet = write();
    put(packet);
    post(request, packet);
  });
}

template <class Put>
bool UnitProxy::send_or_defer(RequestCode request, Put&& put) {
  return guard([&] {
    PacketWriter packet = write();
    put(packet);
    if (defer(request, packet)) return true;
    post(request, packet);
    return false;
  });
}

template <class Take>
auto UnitProxy::receive(Take&& take) {
  return guard([&] {
    Reply reply = await_done();
    if constexpr (std::is_void_v<decltype(take(reply.packet))>) {
      take(reply.packet);
      reply.packet.require_end();
    } else {
      auto result = take(reply.packet);
      reply.packet.require_end();
      return result;
    }
  });
}

template <class Action>
auto UnitProxy::guard(Action&& action) {
  try {
    return action();
  } catch (const BadPacket& mistake) {
    fail_bad_packet(mistake);
    throw;  // it does not return
  } catch (const std::system_error& failure) {
    core::fail_run(context(), failure.what());
  }
}

}  // namespace stride::isolation

#endif
