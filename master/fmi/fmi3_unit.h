// An instance of an FMI 3.0 Co-Simulation unit in this process.
#ifndef STRIDE_MASTER_FMI_FMI3_UNIT_H
#define STRIDE_MASTER_FMI_FMI3_UNIT_H

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <stride/fmi3.h>

#include "master/core/error.h"
#include "master/core/unit.h"
#include "master/fmi/library.h"

namespace stride::fmi {

/// Receives what units log. It may be called from any thread that a unit has.
using LogSink = std::function<void(const std::string& unit, fmi3Status status,
                                   const std::string& category, const std::string& message)>;

struct InstanceOptions {
  bool early_return_allowed = false;
  /// Whether the unit may ask for its inputs within a step, where it can (set_input_update()).
  bool intermediate_update = false;
  /// Whether states from before the present communication point may be restored; else the unit may
  /// forget what it would need for that.
  bool may_go_back = false;
  bool debug_logging = false;  ///< everything that the unit can log, not only warnings and errors
  LogSink log{};
  core::Location where{};  ///< the component's place in the scenario, for errors
};

/// What an instance is made of.
struct UnitParts {
  std::shared_ptr<const Library> library;
  std::shared_ptr<const core::UnitDescription> description;
  std::string resource_path;        ///< as fmi::resource_path() gives it
  std::shared_ptr<const void> fmu;  ///< kept alive as long as the instance
};

/// See core::Unit for the order of calls. A status fmi3Error or fmi3Fatal, and fmi3Discard of any
/// function but fmi3DoStep, becomes a core::Error of the kind Run, with the name of the FMI
/// function, the simulated time and the unit's own messages. After it, terminate() does nothing,
/// and other calls throw. After fmi3Fatal that holds for all instances of the FMU, no function of
/// them is called any more, so they are not freed either, and the library stays loaded.
///
/// A step that succeeds without an early return ends at its end, also where the unit's own time
/// (lastSuccessfulTime) is another, as with a fixed internal step; the log says so once.
///
/// What an input update throws within a step is thrown by step(), which has ended then.
///
/// After the first exchange, get(), set(), step() and get_derivatives() do not allocate, except
/// where a string or binary value outgrows the longest before it; idle_until() never does.
class Fmi3Unit final : public core::Unit {
 public:
  /// Throws core::Error of the kind Run, with the unit's messages, if it cannot be instantiated.
  Fmi3Unit(std::string name, UnitParts parts, InstanceOptions options = {});
  ~Fmi3Unit() override;
  Fmi3Unit(const Fmi3Unit&) = delete;
  Fmi3Unit& operator=(const Fmi3Unit&) = delete;

  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override;
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override;
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override;
  core::StepResult step(const core::StepInterval& interval) override;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  std::string rejection_reason() const override { return rejection_reason_; }
  void save_state() override;
  void restore_state() override;
  void select_state(std::size_t slot) override;
  std::vector<std::uint8_t> serialize_state() override;
  void deserialize_state(std::span<const std::uint8_t> bytes) override;
  void reset() override;
  void enter_event_mode() override;
  core::EventResult update_discrete_states() override;
  void enter_step_mode() override;
  core::ClockInterval clock_interval(const core::Variable& clock) override;
  core::Interval clock_shift(const core::Variable& clock) override;
  void set_input_update(core::InputUpdate update) override { input_update_ = std::move(update); }
  void enable_idle_skipping(Duration max_skip) override;
  void set_idle_tolerances(std::span<const core::ValueReference> outputs,
                           std::span<const double> tolerances) override;
  /// What was not enabled is not promised: Time::min().
  Time idle_until() override;
  void get_derivatives(std::span<const core::ValueReference> outputs,
                       std::span<double> derivatives) override;
  void terminate() override;
  std::uint64_t calls() const override { return calls_; }

 private:
  using References = std::span<const core::ValueReference>;

  static void on_intermediate_update(fmi3InstanceEnvironment environment, fmi3Float64 time,
                                     fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                     fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                     fmi3Boolean* early_return_requested,
                                     fmi3Float64* early_return_time);
  void update_inputs(double time) noexcept;
  void rethrow_update_failure();

  static void on_log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                     fmi3String message);
  void receive(fmi3Status status, const std::string& category, const std::string& message);
  std::string take_messages(const std::string& function);

  /// call() for the function that may answer fmi3Discard.
  template <class Function, class... Arguments>
  fmi3Status call_discardable(const char* name, Function* function, Arguments... arguments);
  template <class Function, class... Arguments>
  void call(const char* name, Function* function, Arguments... arguments);
  void check_callable(const char* name) const {
    if (failed_in_ != nullptr || is_condemned_.load(std::memory_order_relaxed)) [[unlikely]]
      fail_not_callable(name);
  }
  fmi3Status look_into(const char* name, fmi3Status status);
  [[noreturn]] void fail_not_callable(const char* name) const;
  [[noreturn]] void fail_call(const char* function, fmi3Status status);
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;

  void get(const core::BoundValues& values);
  void set(const core::BoundValues& values);
  void get_strings(References references, std::span<std::string> values);
  void set_strings(References references, std::span<const std::string> values);
  void get_binaries(References references, std::span<core::Binary> values);
  void set_binaries(References references, std::span<const core::Binary> values);

  void free_state(fmi3FMUState& state);
  template <class Function>
  void require(const char* name, Function* function) const;

  template <class Function, class... Arguments>
  void call_clock(const char* name, Function* function, const core::Variable& clock,
                  Arguments... arguments);
  template <class Make>
  core::Interval checked_interval(const char* function, const core::Variable& clock,
                                  Make&& make) const;

  /// An output with a tolerance.
  struct TangentOutput {
    core::ValueReference reference;
    std::size_t size;
    bool has_derivative;
  };
  static std::vector<TangentOutput> tangent_outputs(const core::UnitDescription& description);
  void require_idle_functions() const;
  const TangentOutput& tangent_output(core::ValueReference reference) const;

  Time checked_time(double seconds, const char* what) const;
  Time reached_early(const core::StepInterval& interval, double last_successful) const;
  void compare_times(const core::StepInterval& interval, double last_successful);

  // What each call and each step need comes first, and close together.
  const Functions& fmi_;
  const std::atomic<bool>& is_condemned_;  ///< the library
  fmi3Instance instance_ = nullptr;
  const char* failed_in_ = nullptr;  ///< the FMI function after whose status nothing goes on
  std::uint64_t calls_ = 0;
  std::optional<Time> time_;
  double step_point_ = 0;  ///< where the present step began, as the unit knows it
  std::exception_ptr update_failure_;
  std::atomic<bool> has_messages_ = false;
  bool has_time_warning_ = false;

  std::string name_;
  UnitParts parts_;
  InstanceOptions options_;
  std::string rejection_reason_;

  core::InputUpdate input_update_;

  fmi3FMUState state_ = nullptr;
  std::optional<Time> state_time_;  ///< time_ when the state was saved

  struct KeptState {
    fmi3FMUState state = nullptr;
    std::optional<Time> time;
  };
  std::vector<KeptState> kept_states_;  ///< by slot; that of the chosen one is state_
  std::size_t state_slot_ = 0;

  bool may_skip_ = false;
  std::vector<TangentOutput> tangent_outputs_;  ///< in the order of their references
  std::vector<core::ValueReference> derived_;   ///< of one call of get_derivatives()
  std::vector<fmi3Int32> orders_;
  std::vector<double> slopes_;

  std::vector<fmi3String> texts_;
  std::vector<fmi3Binary> bytes_;
  std::vector<std::size_t> sizes_;

  std::mutex messages_mutex_;
  std::vector<std::string> messages_;  ///< those of the present call that report a failure
};

template <class Function, class... Arguments>
[[gnu::always_inline]] inline fmi3Status Fmi3Unit::call_discardable(const char* name,
                                                                    Function* function,
                                                                    Arguments... arguments) {
  check_callable(name);
  ++calls_;
  const fmi3Status status = function(instance_, arguments...);
  const bool is_quiet = !has_messages_.load(std::memory_order_relaxed);
  if (status == fmi3OK && is_quiet) [[likely]]
    return status;
  return look_into(name, status);
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline void Fmi3Unit::call(const char* name, Function* function,
                                                  Arguments... arguments) {
  const fmi3Status status = call_discardable(name, function, arguments...);
  if (status == fmi3Discard) [[unlikely]]
    fail_call(name, status);
}

}  // namespace stride::fmi

#endif
