// One FMI instance: a unit, its table, and the state machine of FMI 3.0 around them. Knows nothing
// of the C entry points.
#ifndef STRIDE_INTERFACES_UNIT_INSTANCE_H
#define STRIDE_INTERFACES_UNIT_INSTANCE_H

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <stride/fmi3.h>
#include <stride/unit.h>

#include "interfaces/unit/idle_settings.h"
#include "interfaces/unit/legal_calls.h"
#include "interfaces/unit/log_categories.h"
#include "interfaces/unit/misuse.h"
#include "interfaces/unit/serialized_state.h"
#include "interfaces/unit/table.h"

namespace stride::kit {

/// A length of time that the importer gives [s], to the nearest picosecond; throws Misuse for what
/// is none.
inline Duration duration_of_seconds(double seconds) {
  try {
    return duration_from_seconds(seconds);
  } catch (const std::out_of_range& error) {
    throw Misuse(error.what());
  }
}
/// An instant that it gives [s], likewise.
inline Time checked_time(double seconds) { return Time(duration_of_seconds(seconds)); }
Duration duration_of_fraction(std::uint64_t counter, std::uint64_t resolution);

/// Throws a Misuse with the text that compose() makes. It is apart from what is checked, so that a
/// check costs no more than its comparison.
template <class Compose>
[[noreturn, gnu::noinline]] void refuse(Compose compose) {
  throw Misuse(compose());
}

/// Throws a Misuse: nValues is not the number of elements of the variables.
[[noreturn]] void refuse_count(std::size_t needed, std::size_t given);

/// What the importer gave when it made the instance.
struct Importer {
  std::string instance_name;
  std::filesystem::path resources;
  std::filesystem::path results;            ///< as Setup has it
  std::uint8_t log_categories = LogErrors;  ///< those that are enabled
  bool event_mode_used = false;
  bool early_return_allowed = false;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log = nullptr;
  /// The inputs that it sets within steps, sorted, and the function that gives it occasion to.
  std::vector<fmi3ValueReference> intermediate_variables;
  fmi3IntermediateUpdateCallback intermediate_update = nullptr;

  void message(fmi3Status status, LogCategory category, const std::string& text) const;
};

/// A saved state (fmi3FMUState).
struct SavedState {
  std::vector<std::uint8_t> bytes;
  bool was_serialized = false;  ///< it may be of another instance, with other resources
};

/// The functions have the meaning of the FMI functions of the same name; a misuse or a failure of
/// the unit is an exception, whose text is the message for the importer.
class Instance final : private InputUpdater {
 public:
  /// Throws if the token is not the one of this library with these resources.
  Instance(Importer importer, const std::string& token);

  Mode mode() const { return mode_; }
  const Importer& importer() const { return importer_; }
  /// The unit itself failed: by the standard nothing but a reset, a restored state or the end can
  /// follow.
  void fail() { mode_ = Terminated; }
  /// Turns the named log categories on or off, all of them if none is named.
  void set_logging(bool on, const fmi3String names[], std::size_t count);

  void enter_initialization_mode(Time start, std::optional<Time> stop);
  void exit_initialization_mode();
  void enter_event_mode() {
    mode_ = EventMode;
    event_pending_ = false;
  }
  void enter_step_mode() { mode_ = StepMode; }
  void terminate();
  void reset();

  struct StepOutcome {
    /// Why the unit rejected the step; then only `reached` has a meaning. Null if it did not. Holds
    /// until the next step.
    const std::string* rejection;
    bool event_needed, terminate, early;
    double reached;  ///< [s]
  };
  StepOutcome do_step(double point, double size);

  struct UpdateOutcome {
    bool iterate, terminate;
    std::optional<Time> next_event;
  };
  UpdateOutcome update_discrete_states();

  /// Most calls are for one number in Step Mode, which is copied and no more. These return false
  /// for any other call, and for one to be refused, without doing it.
  template <Type kType, class T>
  bool get_number(const fmi3ValueReference references[], std::size_t count, T values[],
                  std::size_t size) const;
  template <Type kType, class T>
  bool set_number(const fmi3ValueReference references[], std::size_t count, const T values[],
                  std::size_t size);

  template <Type kType, class T>
  void get(const fmi3ValueReference references[], std::size_t count, T values[], std::size_t size);
  template <Type kType, class T>
  void set(const fmi3ValueReference references[], std::size_t count, const T values[],
           std::size_t size);
  void get_binary(const fmi3ValueReference references[], std::size_t count, std::size_t sizes[],
                  fmi3Binary values[], std::size_t size);
  void set_binary(const fmi3ValueReference references[], std::size_t count,
                  const std::size_t sizes[], const fmi3Binary values[], std::size_t size);
  void get_output_derivatives(const fmi3ValueReference references[], std::size_t count,
                              const fmi3Int32 orders[], double values[], std::size_t size);

  // The functions of <stride/idle.h>.
  void enable_idle_skipping(double max_skip);
  void set_idle_tolerances(const fmi3ValueReference outputs[], std::size_t count,
                           const double tolerances[], std::size_t size);
  /// An instant that is not after the present one is not a promise, Time::max() one without an end.
  Time idle_until() const;

  /// A value of a Binary variable in words (<stride/describe.h>), in whole characters, `capacity`
  /// bytes at most; empty if the unit has none.
  std::string describe_message(fmi3ValueReference reference, const fmi3Byte value[],
                               std::size_t size, std::size_t capacity) const;

  struct ClockInterval {
    Duration interval;
    fmi3IntervalQualifier qualifier;
  };
  ClockInterval clock_interval(fmi3ValueReference reference);
  Duration clock_shift(fmi3ValueReference reference);
  void check_has_interval(fmi3ValueReference reference) const { time_based_clock(reference); }
  /// To be called, for all clocks of a call, before set_clock_interval() and set_clock_shift().
  void check_clock_interval(fmi3ValueReference reference, Duration interval) const;
  void check_clock_shift(fmi3ValueReference reference, Duration shift) const;
  void set_clock_interval(fmi3ValueReference reference, Duration interval);
  void set_clock_shift(fmi3ValueReference reference, Duration shift);

  void save(SavedState& state) const;
  /// Throws a Misuse, with the instance as it was, if the unit refuses a state that was serialised.
  void restore(const SavedState& state);
  std::size_t serialized_size(const SavedState& state) const;
  /// Into so many bytes.
  void serialize(const SavedState& state, std::uint8_t* bytes) const;
  /// Throws a Misuse, with the state as it was, if the bytes are not what serialize() of this unit
  /// wrote.
  void deserialize(const std::uint8_t* bytes, std::size_t size, SavedState& state) const;

 private:
  void build();
  Time meant_end(double end, Time to) const;
  Time end_of_step(double point, double size) const;
  bool is_here(double point) const;
  void check_step(double point, double size, Time to) const;
  bool is_one_step(Time to) const;
  StepOutcome step_once(Time to);
  StepOutcome rejected(const std::string& reason);
  Step step_to(Time to, bool may_return_early);
  StepOutcome step_through_events(Time to);
  void undo(const std::string& rejection, const std::optional<SavedState>& before);
  void begin_own_events();
  bool event_is_due() const;
  bool handle_own_events();
  void note_change(bool is_discrete);
  void warn_of_clocks(Causality causality, bool& warned, const std::string& consequence);
  void check_outcome(const Step& step) const;
  void check_intermediate_variables() const;
  void check_intermediate(const fmi3ValueReference references[], std::size_t count) const;
  bool is_intermediate(fmi3ValueReference reference) const;
  void update_inputs(double seconds_into_step) override;
  void refresh();
  void recompute_outputs();
  void set_time(Time time) {
    time_ = time;
    time_seconds_ = to_seconds(time);
  }
  const Variable& time_based_clock(fmi3ValueReference reference) const;
  const Variable& periodic_clock(fmi3ValueReference reference) const;
  const Variable& adjustable_clock(fmi3ValueReference reference) const;
  static Clock& clock_of(const Variable& row);
  void forget_intervals();
  void activate(fmi3ValueReference reference);
  void require_unit() const;
  void require_idle_promises() const;
  void require_state() const;
  void load(const SavedState& state);
  bool any_clock_ticked() const;
  void check_writable(const fmi3ValueReference references[], std::size_t count, Type type,
                      std::size_t size) const;
  const Slot& slot(fmi3ValueReference reference, Type type) const;
  const Slot* number_in_step_mode(const fmi3ValueReference references[], std::size_t count,
                                  Type type, std::size_t size) const;
  [[noreturn]] void refuse_access(fmi3ValueReference reference, Type type) const;
  [[noreturn]] void refuse_to_set(fmi3ValueReference reference) const;

  std::string token_;
  std::optional<SerializedState> serialized_;  ///< of a unit that has a state
  std::string rejection_;                      ///< of the last step that the unit rejected
  std::optional<IdleSettings> idle_;           ///< of a unit that promises to be idle

  // What each step needs is side by side, so that it is in few lines of the cache.
  Importer importer_;
  double time_seconds_ = 0;
  Time time_{};
  Time start_{};
  std::optional<Time> stop_;
  std::optional<Time> next_event_;  ///< as the unit announced it
  Mode mode_ = Instantiated;
  bool inputs_changed_ = true;
  bool event_pending_ = false;  ///< the last step asked for Event Mode, which was not entered; or,
                                ///< without Event Mode, a discrete input has been set
  bool warned_of_inputs_ = false;  ///< that their clocks do not tick without Event Mode
  bool warned_of_outputs_ = false;
  double step_point_ = 0;  ///< the present step as the importer gave it
  double step_size_ = 0;
  std::unique_ptr<Unit> unit_;
  std::optional<Table> table_;
};

inline const Slot& Instance::slot(fmi3ValueReference reference, Type type) const {
  const Slot* const found = table_ ? table_->find_slot(reference, type) : nullptr;
  if (found == nullptr) refuse_access(reference, type);
  return *found;
}

/// Brings the outputs up to date where an importer may read them directly after it has set inputs.
inline void Instance::refresh() {
  if (inputs_changed_ && (mode_ & (InitializationMode | EventMode)) != 0) recompute_outputs();
}

inline bool Instance::any_clock_ticked() const {
  for (const Clock* clock : table_->output_clocks()) {
    if (clock->ticked()) return true;
  }
  return false;
}

inline bool Instance::event_is_due() const {
  return event_pending_ || (next_event_ && *next_event_ <= time_);
}

/// Without Event Mode discrete inputs are set between steps; that is an event.
inline void Instance::note_change(bool is_discrete) {
  inputs_changed_ = true;
  if (is_discrete && mode_ == StepMode && !importer_.event_mode_used) event_pending_ = true;
}

/// Checks a whole set call before any of it is done, so that a refused one changes nothing.
inline void Instance::check_writable(const fmi3ValueReference references[], std::size_t count,
                                     Type type, std::size_t size) const {
  std::size_t total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& found = slot(references[i], type);
    total += found.size;
    if ((found.settable & mode_) == 0) refuse_to_set(references[i]);
  }
  if (total != size) refuse_count(total, size);
  if (mode_ == IntermediateUpdateMode) check_intermediate(references, count);
}

inline const Slot* Instance::number_in_step_mode(const fmi3ValueReference references[],
                                                 std::size_t count, Type type,
                                                 std::size_t size) const {
  if (mode_ != StepMode || count != 1 || size != 1 || type == Type::String) return nullptr;
  const Slot* const found = table_->find_slot(references[0], type);
  return found != nullptr && found->size == 1 ? found : nullptr;
}

template <Type kType, class T>
bool Instance::get_number(const fmi3ValueReference references[], std::size_t count, T values[],
                          std::size_t size) const {
  const Slot* const from = number_in_step_mode(references, count, kType, size);
  if (from == nullptr) return false;
  values[0] = *static_cast<const T*>(from->data);
  return true;
}

template <Type kType, class T>
bool Instance::set_number(const fmi3ValueReference references[], std::size_t count,
                          const T values[], std::size_t size) {
  const Slot* const to = number_in_step_mode(references, count, kType, size);
  if (to == nullptr || (to->settable & StepMode) == 0) return false;
  *static_cast<T*>(to->data) = values[0];
  note_change(to->is_discrete);
  return true;
}

/// fmi3Boolean is bool and an Enumeration travels as Int64, so the element of a slot has the type
/// T.
template <Type kType, class T>
void Instance::get(const fmi3ValueReference references[], std::size_t count, T values[],
                   std::size_t size) {
  refresh();
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& from = slot(references[i], kType);
    if (at + from.size > size) refuse_count(at + from.size, size);
    if constexpr (kType == Type::String) {
      const auto* texts = static_cast<const std::string*>(from.data);
      for (std::size_t k = 0; k < from.size; ++k) values[at + k] = texts[k].c_str();
    } else if constexpr (kType == Type::Clock) {
      values[at] = static_cast<const Clock*>(from.data)->ticked();
    } else {
      const auto* elements = static_cast<const T*>(from.data);
      for (std::size_t k = 0; k < from.size; ++k) values[at + k] = elements[k];
    }
    at += from.size;
  }
  if (at != size) refuse_count(at, size);
}

template <Type kType, class T>
void Instance::set(const fmi3ValueReference references[], std::size_t count, const T values[],
                   std::size_t size) {
  check_writable(references, count, kType, size);
  std::size_t at = 0;
  bool is_discrete = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& to = table_->slot(references[i]);
    is_discrete |= to.is_discrete;
    if constexpr (kType == Type::Clock) {
      values[at] ? activate(references[i]) : static_cast<Clock*>(to.data)->clear();
    } else if constexpr (kType == Type::String) {
      auto* texts = static_cast<std::string*>(to.data);
      for (std::size_t k = 0; k < to.size; ++k) texts[k] = values[at + k] ? values[at + k] : "";
    } else {
      auto* elements = static_cast<T*>(to.data);
      for (std::size_t k = 0; k < to.size; ++k) elements[k] = values[at + k];
    }
    at += to.size;
  }
  note_change(is_discrete);
}

}  // namespace stride::kit

#endif
