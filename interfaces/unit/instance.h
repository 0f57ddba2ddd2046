// One FMI instance: a unit, its table, and the state machine of FMI 3.0 around them. Knows nothing
// of the C entry points.
#ifndef STRIDE_INTERFACES_UNIT_INSTANCE_H
#define STRIDE_INTERFACES_UNIT_INSTANCE_H

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
#include "interfaces/unit/table.h"

namespace stride::kit {

/// The importer used the instance wrongly; nothing has changed.
struct Misuse : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A time that the importer gives [s]; throws Misuse for what is not an instant.
Time checked_time(double seconds);
/// A length of time that it gives, to the nearest picosecond; throws Misuse likewise.
Duration duration_of_seconds(double seconds);
Duration duration_of_fraction(std::uint64_t counter, std::uint64_t resolution);

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
    std::optional<std::string> rejection;  ///< why; then only `reached` has a meaning
    bool event_needed, terminate, early;
    Time reached;
    bool whole;  ///< it reached the end of the step
  };
  StepOutcome do_step(double point, double size);

  struct UpdateOutcome {
    bool iterate, terminate;
    std::optional<Time> next_event;
  };
  UpdateOutcome update_discrete_states();

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
  /// Throws if the bytes are not a state that save() of this unit wrote.
  void check_saved(const std::uint8_t* bytes, std::size_t size) const;
  void restore(const SavedState& state);

 private:
  void build();
  Time end_of_step(double point, double size) const;
  void check_step(double point, double size, Time from, Time to) const;
  Step step_to(Time to, bool may_return_early);
  StepOutcome step_through_events(Time to);
  StepOutcome undo(const std::string& rejection, const std::optional<SavedState>& before);
  void begin_own_events();
  bool event_is_due() const;
  bool handle_own_events();
  void note_discrete_change(const fmi3ValueReference references[], std::size_t count);
  void warn_of_clocks(Causality causality, bool& warned, const std::string& consequence);
  void check_outcome(const Step& step) const;
  void check_intermediate_variables() const;
  bool is_intermediate(fmi3ValueReference reference) const;
  void update_inputs(double seconds_into_step) override;
  void refresh();
  const Variable& time_based_clock(fmi3ValueReference reference) const;
  const Variable& periodic_clock(fmi3ValueReference reference) const;
  const Variable& adjustable_clock(fmi3ValueReference reference) const;
  static Clock& clock_of(const Variable& row);
  void forget_intervals();
  void activate(fmi3ValueReference reference);
  void require_unit() const;
  void require_idle_promises() const;
  void require_state() const;
  bool any_clock_ticked() const;
  void check_writable(const fmi3ValueReference references[], std::size_t count, Type type,
                      std::size_t size) const;
  const Slot& slot(fmi3ValueReference reference, Type type) const;

  Importer importer_;
  std::string token_;
  std::unique_ptr<Unit> unit_;
  std::unique_ptr<Table> table_;
  std::optional<IdleSettings> idle_;  ///< of a unit that promises to be idle
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
};

/// fmi3Boolean is bool and an Enumeration travels as Int64, so the element of a slot has the type
/// T.
template <Type kType, class T>
void Instance::get(const fmi3ValueReference references[], std::size_t count, T values[],
                   std::size_t size) {
  refresh();
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& from = slot(references[i], kType);
    if (at + from.size > size) throw Misuse("nValues is too small");
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
  if (at != size) throw Misuse("nValues is too large");
}

template <Type kType, class T>
void Instance::set(const fmi3ValueReference references[], std::size_t count, const T values[],
                   std::size_t size) {
  check_writable(references, count, kType, size);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& to = table_->slot(references[i]);
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
  inputs_changed_ = true;
  note_discrete_change(references, count);
}

}  // namespace stride::kit

#endif
