// What the instances of FMI 2.0 and of FMI 3.0 units have in common.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_FMU_INSTANCE_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_FMU_INSTANCE_H

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "master/base/error.h"
#include "master/base/process/fork_mark.h"
#include "master/base/process/process_state.h"
#include "master/base/process/processor_mode.h"
#include "master/base/text/listed.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/unit.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/loader/fmu/instance/callback_receiver.h"
#include "master/loader/fmu/instance/instance_row.h"
#include "master/loader/fmu/instance/present_call.h"
#include "master/loader/fmu/instance/unit_call.h"
#include "master/loader/fmu/library/shared_library.h"
#include "master/loader/fmu/library/status.h"

namespace stride::importer {

struct InstanceOptions {
  bool early_return_allowed = false;
  /// Whether the unit may ask for its inputs within a step, where it can (InputsWithinStep).
  bool intermediate_update = false;
  /// Whether states from before the present communication point may be restored; else the unit may
  /// drop what it would need for that.
  bool may_go_back = false;
  bool debug_logging = false;  ///< everything that the unit can log, not only warnings and errors
  /// The size of the regular steps, if it is known.
  std::optional<core::Interval> step{};
  /// What is set to another value than 0 to end the wait for an asynchronous step; null = nothing.
  const volatile std::sig_atomic_t* interrupted = nullptr;
  /// A warning is logged when an asynchronous step (FMI 2.0, fmi2Pending) takes longer.
  std::chrono::milliseconds warn_after = std::chrono::seconds(10);
  LogSink log{};
  core::Location where{};  ///< the component's position in the scenario, for errors
  /// The folder for files that the unit writes, absolute: $STRIDE_RESULTS while it is instantiated.
  /// Empty: the variable stays what it is.
  std::filesystem::path results{};
  /// With the array sizes that its structural parameters give; nothing = as in the FMU.
  std::shared_ptr<const core::UnitDescription> description{};
  /// What is put back after the instantiation and after the calls that change the mode, until the
  /// end of the initialization; null = nothing. The mode of the processor is put back after each
  /// call of any function. Only the first instances of an FMU are watched so.
  std::shared_ptr<const core::ProcessState> process{};
  /// Where each function is noted while it is called; null = nowhere. Must outlive the instance.
  CallNote* call_note = nullptr;
};

/// What an instance is made of, beside its library.
struct UnitParts {
  std::shared_ptr<const core::UnitDescription> description;
  std::string resources;            ///< where they are, in the form that the unit's version wants
  std::shared_ptr<const void> fmu;  ///< kept alive as long as the instance
};

/// Whether the description promises the capability; of MessageText only the library knows.
bool declares(const core::UnitDescription& unit, core::CapabilityId id);

/// Calls functions of a unit, and turns what they answer into results and errors. A status Error or
/// Fatal, and Discard of any function but those that may answer it, becomes a core::Error of the
/// kind Run, with the name of the function, the simulated time and the unit's own messages; so does
/// an exception that leaves the unit, which counts as Fatal. (Of a state that cannot be saved, see
/// save_by(), and of one that cannot be serialised call_for_state().) After it the instance is
/// freed, and no other function of it is called; after Fatal none of any instance of the FMU, so
/// they are not freed either, and the library stays loaded.
///
/// What a function has changed of the mode of the processor is put back when it returns, and, until
/// the end of the initialization, what it has changed of the process. A warning names the unit and
/// the function.
///
/// Where a function calls fork() and both processes return, the new one ends there.
class FmuInstance : public core::Unit, public core::UnitDiagnostics, public CallbackReceiver {
 public:
  friend bool is_any_call_unfinished() noexcept;
  friend std::vector<UnitCall> unfinished_calls(const char* thread);
  friend std::optional<UnitCall> last_call_of_this_thread();

  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;

  using core::Unit::step;
  core::StepResult step(const core::StepInterval& interval) final {
    return step(interval, core::StepValues{});
  }
  std::string rejection_reason() const override { return rejection_reason_; }
  std::uint64_t calls() const override {
    return calls_ + (row_ != nullptr ? row_->steps() * calls_in_row_ : 0);
  }
  void set_repeating(bool repeating) override { is_repeating_ = repeating; }

  bool is_in_call() const final { return present_.function() != nullptr; }
  bool is_called_by_this_thread() const final { return present_.is_by_this_thread(); }

 protected:
  using References = std::span<const core::ValueReference>;

  /// `prefix` of what has a name in the unit's version: "fmi", "fmi2", "fmi3".
  FmuInstance(const char* prefix, std::shared_ptr<const SharedLibrary> library, std::string name,
              UnitParts parts, InstanceOptions options);
  ~FmuInstance() override;

  /// The same of its own description.
  bool declares(core::CapabilityId id) const { return importer::declares(*parts_.description, id); }
  core::Capability* diagnostics() { return static_cast<core::UnitDiagnostics*>(this); }

  /// Calls function(instance, arguments...).
  template <class Function, class... Arguments>
  void call(const char* name, Function* function, Arguments... arguments);
  /// Likewise; what it and some calls after it change of the process is put back after each.
  template <class Function, class... Arguments>
  void call_and_watch(const char* name, Function* function, Arguments... arguments);
  /// Likewise for this call, but for none after it: of the one that ends the initialization.
  template <class Function, class... Arguments>
  void call_and_end_watch(const char* name, Function* function, Arguments... arguments);
  /// As call(), one that may answer Discard, or Pending.
  template <class Function, class... Arguments>
  Status call_discardable(const char* name, Function* function, Arguments... arguments);

  /// What call() returns, which calls this function; an exception is a failure of it.
  template <class Call>
  auto guarded(const char* name, Call&& call);

  /// Makes the instance by the unit's function, which `make` calls. Throws core::Error of the kind
  /// Run with the unit's messages if there is none.
  template <class Make>
  void instantiate_by(const char* name, Make&& make);

  /// To be called before each call, and end_call() after it has returned. What it throws leaves
  /// the note as it is: where the exception comes from.
  [[gnu::always_inline]] void note_call(const char* name) {
    ++calls_;
    write_note(name);
  }
  /// For a call that does not count, or goes on.
  [[gnu::always_inline]] void write_note(const char* name) {
    settle_row();
    core::ForkMark::set();
    present_.begin(name, time_);
  }
  [[gnu::always_inline]] void end_call() {
    if (is_copy_of_process()) [[unlikely]]
      leave_fork(present_.function());
    if (!present_.is_in_sequence()) check_mode(present_.function());
    present_.end();
  }
  /// Calls of one unit that nothing else runs between: what is the same for all of them is noted at
  /// the beginning, and at the end it is looked whether the processor is in the mode that all units
  /// depend on. Other calls of the unit meanwhile belong to the sequence.
  class CallSequence {
   public:
    /// From this time on. `function` is named if the mode is another one.
    /// Throws if no function can be called.
    CallSequence(FmuInstance& unit, const char* function, Time time);
    ~CallSequence();
    CallSequence(const CallSequence&) = delete;
    CallSequence& operator=(const CallSequence&) = delete;

    /// As those of FmuInstance.
    template <class Function, class... Arguments>
    void call(const char* name, Function* function, Arguments... arguments);
    template <class Function, class... Arguments>
    Status call_discardable(const char* name, Function* function, Arguments... arguments);

    /// The simulated time of the next calls.
    void set_time(Time time) {
      *unit_.time_ = time;
      unit_.present_.set_time(time);
    }

   private:
    template <class Function, class... Arguments>
    Status make_call(const char* name, Function* function, Arguments... arguments);

    FmuInstance& unit_;
    const char* function_;
  };
  /// From now on it may step in this row, with so many calls in a step; null: in none.
  void set_row(InstanceRow* row, std::uint64_t calls) {
    row_ = row;
    calls_in_row_ = calls;
    present_.set_row(row != nullptr ? &row->present() : nullptr);
  }
  /// To be called before anything is done with it by itself.
  [[gnu::always_inline]] void settle_row() {
    if (row_ != nullptr && row_->steps() != 0) [[unlikely]]
      row_->settle();
  }
  /// The simulated time that it has reached, for messages.
  std::optional<Time> time() const;
  /// Whether a call that has just returned left nothing but its status.
  [[gnu::always_inline]] bool is_quiet() const {
    return notices_.load(std::memory_order_relaxed) == 0 && core::ForkMark::is_set();
  }
  /// Likewise, where only instances of this process that have notices are looked at closely.
  [[gnu::always_inline]] static bool are_all_quiet() {
    return noticed_.load(std::memory_order_relaxed) == 0 && core::ForkMark::is_set();
  }
  /// Puts it back, and warns as the next function.
  void restore_mode(const char* function);
  /// Warns that a call of this function has left another mode behind, once.
  void warn_of_mode(const char* function, const core::ProcessorMode& left);
  /// After a call of this function: see InstanceOptions::process.
  void restore_process(const char* function);
  [[gnu::always_inline]] void check_callable(const char* name) const {
    if (failed_in_ != nullptr || is_unusable_.load(std::memory_order_relaxed)) [[unlikely]]
      fail_not_callable(name);
  }
  /// Whether no function can be called any longer.
  bool has_failed() const { return failed_in_ != nullptr || is_unusable_; }
  /// What a status other than OK, or a message of a failure, means for the call that has just
  /// ended.
  Status check_status(const char* name, Status status);
  /// Likewise, and of all else that it may have left; also of one that must not answer Discard.
  Status check_left(const char* name, Status status);
  void check_left_by_whole_call(const char* name, Status status);
  [[noreturn]] void fail_call(const char* function, Status status);
  /// Within a handler of what left the unit's function.
  [[noreturn]] void fail_thrown(const char* function);
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;
  /// Throws what a callback could not throw across the unit's C code.
  [[gnu::always_inline]] void rethrow_callback_failure() {
    if (callback_failure_) [[unlikely]]
      std::rethrow_exception(std::exchange(callback_failure_, nullptr));
  }
  void mark_unusable() const { library_->mark_unusable(); }

  /// For functions that a library exports only if the unit has the capability.
  template <class Function>
  void require(const char* name, Function* function, const char* capability) const {
    if (function == nullptr) [[unlikely]]
      fail_missing(name, capability);
  }

  /// Keeps the unit's state by its function. A unit that fails in it or does not have it, though it
  /// declares that it can, goes on without: one warning says so, and from then on this does
  /// nothing. Whether the state is kept; if not, it is null.
  template <class Function>
  bool save_by(const char* name, Function* function, void*& state);
  /// To be called before a state is restored. One that is null may be that of a unit without any,
  /// or of a function that does nothing: one warning says so.
  void check_state(const char* saved_by, const void* state) {
    if (state == nullptr) [[unlikely]]
      warn_of_null_state(saved_by);
  }
  /// Why there is no state to be restored.
  [[noreturn]] void fail_without_state() const;

  /// Calls the unit's function for it, also after a failure, and discards what is known of the run
  /// before it.
  template <class Function>
  void reset_by(const char* name, Function* function);
  /// Frees a kept state by the unit's function, if it has one; whether it has been called.
  template <class Function>
  bool free_by(const char* name, Function* function, void*& state);
  /// Frees the instance by the unit's function, unless the library is unusable.
  template <class Function>
  void free_instance_by(const char* name, Function* function);
  /// For a destructor, which can throw nothing: calls free(), and warns if it fails.
  template <class Free>
  void free_or_warn(Free&& free) noexcept;
  /// The unit's functions that write a kept state as bytes.
  template <class Answer, class Byte>
  struct Serialization {
    const char* size_name;
    Answer (*size_of)(void*, void*, std::size_t*);
    const char* write_name;
    Answer (*write)(void*, void*, Byte*, std::size_t);
    const char* capability;  ///< with which a library exports them
  };
  /// As many as the function wants.
  std::vector<std::uint8_t> bytes_for_state(const char* function, std::size_t size) const;
  /// As call(), of a function that makes bytes of a kept state or a state of bytes: the unit stays
  /// what it is, so one that fails with Error or Discard can still be called.
  template <class Function, class... Arguments>
  void call_for_state(const char* name, Function* function, Arguments... arguments);
  [[noreturn]] void fail_for_state(const char* function, Status status);
  /// A state that is null is none that a unit's function could look at.
  [[noreturn]] void fail_null_state(const char* function) const;
  /// The bytes of a kept state.
  template <class Answer, class Byte>
  std::vector<std::uint8_t> serialized(void* state, const Serialization<Answer, Byte>& functions);

  /// Copies the values that a function has given, which are in memory of the unit. What is wrong
  /// with one, or a crash, is an error with the function and the variable. No text (NULL), which
  /// FMI forbids, is an empty one, with a warning; of a text that is not UTF-8 there is one warning
  /// for each variable.
  void copy_texts(const char* function, References references, std::span<const char* const> given,
                  std::span<std::string> values);
  void copy_binaries(const char* function, References references,
                     std::span<const std::uint8_t* const> given, std::span<const std::size_t> sizes,
                     std::span<core::Binary> values);

  /// Of a message of the unit; may be called on any thread, throws nothing.
  void receive(Status status, const char* category, const char* message) noexcept;
  /// The failure messages of the call that has just ended, for one line of text.
  std::string take_messages(const std::string& function);
  /// Forgets them where the call is no failure, and logs those that were held back.
  void drop_messages();
  bool has_messages() const { return has(kMessages); }
  /// take_messages() of a rejected step; empty if the unit gave none.
  void take_rejection_reason(const char* function);
  /// What helps where the unit does not accept its present step since it is shorter than the
  /// others, or of another size than the one that the unit was made for; empty if it is not. A unit
  /// that takes steps of any size, and has made one, has another reason.
  std::string step_hint() const;
  /// Logs a warning of the importer itself.
  void warn(const std::string& message) const;

  Time checked_time(double seconds, const char* what) const;
  /// To be called before the initialization, with the end of the run, if it is known. Returns the
  /// stop time as the unit gets it, or else 0. It is not before the sum of the last regular step,
  /// which may be rounded to a time above it: some units refuse a step beyond their stop time, and
  /// some one of another size.
  double set_stop(Time start, std::optional<Time> stop);
  /// The size of a step as the unit gets it. One whose sum with the beginning is rounded to a time
  /// above the stop time of the unit is the difference of the ends.
  double size_of(const core::StepInterval& interval) {
    present_step_ = {interval.from, interval.to};
    const double sum = interval.begin_seconds + interval.size_seconds;
    const bool is_beyond = sum > stop_seconds_ && interval.end_seconds <= stop_seconds_;
    return is_beyond ? interval.end_seconds - interval.begin_seconds : interval.size_seconds;
  }
  /// How far the unit's idea of where a step ended may be from ours.
  [[gnu::always_inline]] static double time_tolerance(const core::StepInterval& interval) {
    constexpr double kPicosecond = 1e-12;
    constexpr double kShareOfStep = 1e-6;
    const double end = interval.end_seconds;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(end);
    return kPicosecond + rounding + kShareOfStep * (end - interval.begin_seconds);
  }
  /// Whether a time that the unit names is one of the step, the rounding of doubles aside, and what
  /// a unit that adds up its own internal steps may have drifted.
  static bool is_within(const core::StepInterval& interval, double seconds);
  [[gnu::always_inline]] static bool is_end(const core::StepInterval& interval, double seconds,
                                            double tolerance) {
    return std::abs(seconds - interval.end_seconds) <= tolerance;
  }
  static bool is_end(const core::StepInterval& interval, double seconds) {
    return is_end(interval, seconds, time_tolerance(interval));
  }
  /// The instant of the step that the unit names; nothing if it is not in the step, or not known.
  std::optional<Time> instant_within(const core::StepInterval& interval,
                                     std::optional<double> seconds, const char* what) const;
  /// What the unit says of how far it came in a step that it discarded: "reports that …". `what` is
  /// the name of that time.
  static std::string how_far(const core::StepInterval& interval, std::optional<double> seconds,
                             const char* what);
  /// Of a step that the unit discarded, and that cannot be made again: what its function returned,
  /// how_far(), and why not. `hint` is for where step_hint() has none.
  [[noreturn]] void fail_discarded(const core::StepInterval& interval, const char* returned,
                                   const std::string& how_far, const char* why,
                                   const char* hint) const;

  /// So many calls of an instance are compared more closely than can be afforded for all.
  static constexpr std::uint64_t kCloselyWatched = 100;
  /// For restore_process(), which takes tens of microseconds, after each phase of the start.
  static constexpr int kMostWatched = 100;

  // What each call and each step need comes first, and close together.
  void* instance_ = nullptr;         ///< as the unit calls it
  const char* failed_in_ = nullptr;  ///< the function after whose status nothing goes on
  std::uint64_t calls_ = 0;
  PresentCall present_;
  std::atomic<std::uint8_t> notices_{0};  ///< of Notice
  bool was_restored_ = false;             ///< from a kept state, and no step has ended since
  bool is_repeating_ = false;             ///< what it logs has been logged before
  int watched_calls_ = 0;  ///< so many of the next ones are followed by restore_process()
  const core::ProcessorMode mode_ = core::ProcessorMode::present();
  InstanceRow* row_ = nullptr;
  std::uint64_t calls_in_row_ = 0;
  std::optional<Time> time_;
  double stop_seconds_ = std::numeric_limits<double>::infinity();
  struct {
    Time from{}, to{};
  } present_step_;
  const std::atomic<bool>& is_unusable_;  ///< the library
  std::exception_ptr callback_failure_;

  std::string name_;
  UnitParts parts_;
  InstanceOptions options_;
  std::string rejection_reason_;

 private:
  [[noreturn]] void fail_not_callable(const char* name) const;
  [[noreturn]] void fail_missing(const char* name, const char* capability) const;
  /// What a call may leave to be looked at when it has returned.
  enum Notice : std::uint8_t {
    kMessages = 1,  ///< messages_ or held_ has some
    kFork = 2,      ///< the present function has made this process, by fork()
  };
  bool has(Notice notice) const { return (notices_.load(std::memory_order_relaxed) & notice) != 0; }
  void add(Notice notice) {
    if (notices_.fetch_or(notice) == 0) ++noticed_;
  }
  void remove(Notice notice) {
    const auto others = static_cast<std::uint8_t>(~notice);
    const std::uint8_t before = notices_.fetch_and(others);
    if (before != 0 && (before & others) == 0) --noticed_;
  }
  [[gnu::always_inline]] bool is_copy_of_process() const {
    return has(kFork) || !core::ForkMark::is_set();
  }
  static void note_fork() noexcept;
  [[noreturn]] void leave_fork(const char* function) const;
  std::string short_step_hint() const;
  [[gnu::always_inline]] void check_mode(const char* function) {
    if (!mode_.is_present()) [[unlikely]]
      restore_mode(function);
    if (calls_ < kCloselyWatched) [[unlikely]]
      check_registers(function);
    core::ProcessorMode::empty_registers();
  }
  /// Warns, once.
  void check_registers(const char* function);
  std::string status_name(Status status) const;
  std::string failure_of(const char* function, Status status);
  bool is_known(Status status) const;
  template <class Copy>
  void copy_each(const char* function, References references, std::size_t count, Copy&& copy);
  std::string variable_name(core::ValueReference reference) const;
  void warn_of_encoding(core::ValueReference variable, std::string_view text);
  [[noreturn]] void fail_value(core::ValueReference variable, const std::string& message,
                               const std::string& hint = "") const;
  char major_version() const { return prefix_[3] != '\0' ? prefix_[3] : '1'; }
  bool may_be_pending() const { return major_version() != '3'; }
  bool is_reason_of_call(Status status, std::string_view message) const;
  void log_held();

  std::string hint_for(const char* function, Status status) const;
  void give_up_saving(std::string failure);
  void warn_of_null_state(const char* saved_by);

  static inline std::atomic<std::uint32_t> noticed_{0};  ///< so many instances have notices

  const char* prefix_;
  std::optional<Time> start_, stop_;
  std::string save_failure_;  ///< why the state cannot be saved
  std::shared_ptr<const SharedLibrary> library_;
  std::mutex messages_mutex_;
  std::vector<std::string> messages_;  ///< those of the present call that report a failure
  struct HeldMessage {
    std::string category, text;
  };
  std::vector<HeldMessage> held_;  ///< those of them that are not logged if the call fails
  bool has_mode_warning_ = false;
  bool has_register_warning_ = false;
  bool has_text_warning_ = false;
  std::set<core::ValueReference> has_encoding_warning_;
  bool has_null_state_warning_ = false;
  core::Listed<FmuInstance> listed_{*this};
};

}  // namespace stride::importer

#endif
