// The exchange of values at communication points: planned once, then only copies.
#ifndef STRIDE_MASTER_ENGINE_RUN_EXCHANGE_EXCHANGE_H
#define STRIDE_MASTER_ENGINE_RUN_EXCHANGE_EXCHANGE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/observer.h"
#include "master/engine/port/unit.h"
#include "master/engine/run/exchange/item_check.h"

namespace stride::core {

class StateArchive;

/// When variables are written.
enum class WriteTime {
  Point,           ///< at each communication point
  PointAndWithin,  ///< and at times within a step, if the unit requests it
  Change,          ///< where they changed: discrete variables
  Initialization,  ///< once, before the first step: a fixed parameter
};

/// A connection between continuous variables, for one element.
struct ContinuousLink {
  VariableId from, to;
  ValueSlice source, target;
  LinearConversion conversion;
};

/// For each unit and type one contiguous block of outputs and one of inputs, and a list of copies
/// between them. Values of time-based clocks are read and written at their ticks, and hold between
/// them. Messages are not part of it: see messages.h. Nothing here allocates after construction,
/// except where a String or a Binary grows.
class Exchange {
 public:
  /// `observed`: variables that are read even where they are not connected.
  Exchange(const System& system, std::span<const VariableId> observed)
      : Exchange(system, observed, FirstValues(system, Time::min())) {}
  Exchange(const System& system, std::span<const VariableId> observed, FirstValues first_values);
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  const FirstValues& first_values() const { return first_values_; }

  /// Reads a unit's outputs and observed variables.
  void read_outputs(std::size_t component, Unit& unit);
  /// Copies the outputs of all units to the inputs of all units. Throws Error (Run) where a
  /// connected output is NaN, or an Enumeration has a value that is not an item.
  void route(const Time& time);
  /// Throws as route() does, which has nothing to copy.
  void check_values(Time time) const;
  /// Of connected outputs only; throws for what is beyond the range of their inputs, too.
  void check_nan(Time time) const;
  /// Whether a discrete input of the unit has changed since it was written; FMI requires Event
  /// Mode then.
  bool has_discrete_change(std::size_t component) const {
    return ports_[component].has_discrete_inputs && any_discrete_change(component);
  }
  bool has_discrete_inputs(std::size_t component) const {
    return ports_[component].has_discrete_inputs;
  }
  /// Writes a unit's continuous inputs, and the discrete ones if they changed.
  void write_inputs(std::size_t component, Unit& unit);
  /// Whether no unit's inputs were written by themselves since something was routed.
  bool has_all_to_write() const { return written_alone_ != route_; }
  /// What with_step_values() passes on then, if it is all that belongs to a step of the unit.
  const StepValues* fixed_step_values(std::size_t component) const {
    return ports_[component].has_discrete_inputs ? nullptr : &ports_[component].values;
  }
  /// A step with these has been made.
  void mark_written(std::size_t component) { ports_[component].written_route = route_; }
  /// Likewise, if something was routed since the unit's inputs were written.
  void write_routed_inputs(std::size_t component, Unit& unit) {
    if (ports_[component].written_route != route_) write_inputs(component, unit);
  }
  /// Calls step(values) with the inputs to go with a step of the unit, as write_routed_inputs()
  /// writes them, and with its outputs. Inputs that cannot go with it are written before.
  template <class Step>
  std::invoke_result_t<Step, const StepValues&> with_step_values(std::size_t component, Unit& unit,
                                                                 Step&& step) {
    Port& port = ports_[component];
    if (port.written_route == route_) return step(StepValues{{}, port.values.outputs});
    if (port.has_discrete_inputs) write_discrete_inputs(component, unit);
    port.written_route = route_;
    return step(port.values);
  }
  /// A step of the unit with them.
  StepResult step(std::size_t component, Unit& unit, const StepInterval& interval) {
    return with_step_values(component, unit,
                            [&](const StepValues& values) { return unit.step(interval, values); });
  }
  /// A step of the unit with the inputs that it has.
  StepResult step_with_held_inputs(std::size_t component, Unit& unit,
                                   const StepInterval& interval) const {
    return unit.step(interval, StepValues{{}, ports_[component].values.outputs});
  }
  void begin_step_with_held_inputs(std::size_t component, ConcurrentSteps& steps,
                                   const StepInterval& interval,
                                   const ConcurrentSteps::Extras& extras) const {
    steps.begin_step(interval, StepValues{{}, ports_[component].values.outputs}, extras);
  }
  /// Begins step() of a unit that makes it elsewhere. Its outputs are there when it is done.
  void begin_step(std::size_t component, Unit& unit, ConcurrentSteps& steps,
                  const StepInterval& interval, const ConcurrentSteps::Extras& extras) {
    with_step_values(component, unit,
                     [&](const StepValues& values) { steps.begin_step(interval, values, extras); });
  }
  /// A connected input has this value, whatever is routed to it, until release().
  void force(VariableId input, const ValueBlock& value);
  /// To be followed by route().
  void release(VariableId input);
  bool is_forced(VariableId input) const {
    return std::ranges::any_of(forced_,
                               [&](const Forced& forced) { return forced.input == input; });
  }
  /// After inputs were changed in their blocks by other means than route(): those that are forced
  /// have their values again. May be called for different components at the same time.
  void keep_forced(std::size_t component) {
    for (const Forced& forced : forced_) {
      if (forced.input.component == component) keep(forced);
    }
  }
  /// What a connected or observed variable has now.
  ValueBlock value(VariableId id);
  /// An input was changed in its block by other means than route().
  void mark_changed(std::size_t component) { ports_[component].written_route = 0; }

  /// All values, and what has been written of them. The state may be that of a run that observed
  /// other variables: outputs that it does not have are new, and to be read from their units; what
  /// is not observed any more is dropped.
  void persist(StateArchive& state);
  /// Those, sorted; they are not connected.
  std::span<const VariableId> new_outputs() const { return new_outputs_; }
  /// Reads them from the unit, in Step Mode; calls it only if it has some.
  void read_new_outputs(std::size_t component, Unit& unit);

  /// Writes those of a unit's continuous inputs that may change within a step.
  void write_inputs_within_step(std::size_t component, Unit& unit);

  /// All connections between continuous variables, sorted by target.
  std::vector<ContinuousLink> continuous_links() { return links_from(Variability::Continuous); }
  /// Those from discrete to continuous variables of floating-point types.
  std::vector<ContinuousLink> jumping_links() { return links_from(Variability::Discrete); }

  struct RealValue {
    VariableId id;
    ValueSlice element;
  };
  /// The elements of a component's connected inputs that are not discrete.
  std::vector<RealValue> continuous_inputs(std::size_t component);
  /// The elements of a component's Float64 outputs with a tolerance that are read at all.
  std::vector<RealValue> outputs_with_tolerance(std::size_t component);

  /// In Initialization Mode, when its inputs have been set: what belongs to the unit's time-based
  /// clocks is exchanged at their ticks from now on, and holds what it is until then.
  void begin_samples(std::size_t component, Unit& unit);
  /// read_outputs() and write_inputs() for what belongs to one of these clocks of the unit, which
  /// tick.
  void read_sampled_outputs(std::size_t component, Unit& unit,
                            std::span<const ValueReference> ticking);
  void write_sampled_inputs(std::size_t component, Unit& unit,
                            std::span<const ValueReference> ticking);
  /// Whether write_sampled_inputs() has something new to write.
  bool has_sampled_change(std::size_t component, std::span<const ValueReference> ticking) const;
  /// Those inputs, for an error message.
  std::vector<VariableId> sampled_changes(std::size_t component,
                                          std::span<const ValueReference> ticking) const;

  /// Whether the variable is connected or observed, so that its value is here.
  bool has(VariableId id) {
    return locate_input(id).transfer != nullptr || locate_output(id).transfer != nullptr;
  }
  /// The value of such a variable. That of a connected input is the routed one, that of an input of
  /// a time-based clock the one at its last tick.
  Signal signal(VariableId id);

  /// The value of a connected variable, for the evaluation of single variables: an output that was
  /// read is written there, and write_inputs() reads an input there. See OrderedExchange.
  ValueSlice slice(VariableId id);
  ValueSlice slice(const ElementRange& range);

 private:
  std::vector<ContinuousLink> links_from(Variability source_variability);
  /// Variables of one type of one unit, read or written by one call.
  struct Transfer {
    ValueBlock block;
    WriteTime write_time;
    ValueBlock written;                  ///< of a discrete one: what was written last
    bool is_new = true;                  ///< nothing was written yet
    std::vector<ValueReference> clocks;  ///< at whose ticks it is exchanged; empty: always
    std::vector<ValueReference> references;
    std::vector<VariableId> ids;      ///< sorted
    std::vector<std::size_t> firsts;  ///< where each variable begins in the block

    bool is_discrete() const {
      return is_written_on_change() || write_time == WriteTime::Initialization;
    }
    bool is_written_on_change() const { return write_time == WriteTime::Change; }
  };
  using Transfers = std::vector<std::vector<Transfer>>;  // by component; final once it is planned

  /// What a step of a unit needs.
  struct alignas(64) Port {
    StepValues values;  ///< the inputs are continuous ones
    bool has_discrete_inputs;
    std::uint64_t written_route = 0;  ///< since which the inputs are written
  };

  template <class T>
  struct Copy {
    T* to;
    const T* from;
  };
  template <class To, class From>
  struct ConvertedCopy {
    To* to;
    const From* from;
    double factor, offset;
  };
  /// Between Float64 and Float32.
  template <class To, class From>
  struct ChangedCopy : ConvertedCopy<To, From> {
    /// A result below it, other than 0, loses its digits; 0 where that was said or need not be.
    double least;

    bool is_lost(double result) const { return std::abs(result) < least && result != 0; }
  };
  template <class Real>
  struct Checked {
    const Real* value;
    VariableId id;
  };
  template <class Real, class Other>
  struct RealLists {
    std::vector<Copy<Real>> plain;
    std::vector<ConvertedCopy<Real, Real>> converted;
    /// To another type. What was said is not part of the state.
    mutable std::vector<ChangedCopy<Other, Real>> changed;
    std::vector<Checked<Real>> checked;  ///< the sources of all of them

    /// Returns whether a source is NaN, or its value beyond the range of its target, or lost there.
    bool route() const;
  };
  /// A whole number that is mapped or becomes one of another type.
  struct MappedCopy {
    void (*copy)(void* to, const void* from, const Conversion& conversion);
    void* to;
    const void* from;
    const Connection* connection;
    ValueSlice target;
  };

  /// An input that is forced.
  struct Forced {
    VariableId input;
    ValueSlice target;
    ValueBlock value;
  };
  std::vector<std::uint64_t> output_keys(std::size_t component) const;
  void persist_outputs(StateArchive& state, std::size_t component);
  void persist_output(StateArchive& state, VariableId id);
  void check_new_outputs(StateArchive& state) const;
  void read_new_outputs(const Transfer& transfer, Unit& unit);
  static void persist(StateArchive& state, Transfer& input);
  void persist_forced(StateArchive& state);
  static void keep(const Forced& forced) {
    copy_elements(*forced.target.block, forced.target.first, forced.value, 0, forced.value.size());
  }
  std::vector<RealValue> elements(std::vector<Transfer>& transfers,
                                  const std::function<bool(const Transfer&)>& is_wanted) const;
  static bool is_of(const Transfer& transfer, std::span<const ValueReference> ticking);
  static bool is_changed(const Transfer& transfer) {
    return transfer.is_new || !(transfer.block == transfer.written);
  }
  static void write(Transfer& transfer, Unit& unit);
  bool any_discrete_change(std::size_t component) const;
  void write_discrete_inputs(std::size_t component, Unit& unit);
  void make_ports();
  void route_further(bool is_odd, const Time& time);
  void route_other_types(Time time);
  void add_changes(const Transfer& transfer, const ValueBlock& before,
                   std::vector<VariableId>& changes) const;
  template <class Real, class Other>
  void check_nan(const RealLists<Real, Other>& lists, Time time) const;
  template <class Real, class Other>
  static VariableId source_of(const RealLists<Real, Other>& lists, const Real* from);
  Context output_context(VariableId id, Time time) const;
  template <class Real, class Other>
  void note_lost(const RealLists<Real, Other>& lists, Time time) const;
  void check_mapped(const MappedCopy& copy, Time time) const;
  void add_item_checks(Transfers& transfers);
  void add_copies(const Connection& connection);
  void add_copy(const Connection& connection, ValueBlock& target, std::size_t target_at,
                const ValueBlock& source, std::size_t source_at);
  template <class Real, class Other>
  void add_real(RealLists<Real, Other>& lists, const Connection& connection, ValueBlock& target,
                std::size_t target_at, const Real* from);
  void add_number(const Connection& connection, ValueBlock& target, std::size_t target_at,
                  const ValueBlock& source, std::size_t source_at);
  /// The transfer that holds a variable, null if there is none, and where it begins in the block.
  struct TransferSlot {
    Transfer* transfer = nullptr;
    std::size_t first = 0;
  };
  static TransferSlot locate(Transfers& transfers, VariableId id);
  TransferSlot locate_input(VariableId id);
  TransferSlot locate_output(VariableId id);

  const System& system_;
  Transfers outputs_;
  Transfers inputs_;
  Transfers sampled_outputs_;  ///< what belongs to time-based clocks
  Transfers sampled_inputs_;
  std::vector<Port> ports_;                ///< by component
  std::vector<BoundValues> bound_values_;  ///< of them
  std::uint64_t route_ = 1;                ///< counts the calls of route()
  std::uint64_t written_alone_ = 0;        ///< behind which of them write_inputs() was called last
  std::vector<Forced> forced_;
  std::vector<VariableId> new_outputs_;
  std::array<std::vector<Copy<std::byte>>, 4> numbers_;  // of 1, 2, 4 and 8 bytes
  std::vector<Copy<std::string>> strings_;
  std::vector<Copy<Binary>> binaries_;
  std::vector<MappedCopy> mapped_;
  const FirstValues first_values_;
  ItemCheck items_{system_, first_values_};  ///< of all outputs that are read
  RealLists<double, float> doubles_;
  RealLists<float, double> floats_;
  mutable std::set<VariableId> lost_;  ///< outputs whose loss of digits was said
  bool has_other_types_ = false;       ///< than Float64, to be copied or checked
};

}  // namespace stride::core

#endif
