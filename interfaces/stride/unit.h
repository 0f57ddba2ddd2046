// The unit kit: derive from stride::Unit, list your variables, write step(), and you have an
// FMI 3.0 Co-Simulation FMU.
//
//   class Tank : public stride::Unit {
//    public:
//     Tank() {
//       input("inflow", inflow_).unit("m3/s");
//       output("volume", volume_).unit("m3").exact().depends_on({});
//       state();
//     }
//     void step(stride::Step& step) override {
//       volume_ += inflow_ * stride::to_seconds(step.size());
//     }
//    private:
//     double inflow_ = 0, volume_ = 1;
//   };
//   STRIDE_UNIT(Tank)
#ifndef STRIDE_UNIT_H
#define STRIDE_UNIT_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <stride/tangent.h>
#include <stride/time.h>
#include <stride/unit/clock.h>
#include <stride/unit/state.h>
#include <stride/unit/step.h>
#include <stride/unit/unit_of_measure_definition.h>
#include <stride/unit/variable.h>

namespace stride {

namespace kit {
class IdleSettings;
}

/// What a unit may ask for in its constructor, by a parameter `const stride::Setup&`.
struct Setup {
  std::filesystem::path resources;  ///< the FMU's resources folder; empty if it has none
  std::string instance_name;
  /// The folder for files that this unit writes, absolute; empty if the importer names none
  /// (<stride/results.h>), so `results / "trace.vcd"` is in the working folder then.
  std::filesystem::path results{};
};

enum class Severity { Info, Warning };

/// Properties of a unit as a whole, for its model description.
struct UnitInfo {
  std::string description;
  std::string version = "1.0";
  bool early_return = false;     ///< it may return early from a step
  bool may_reject = false;       ///< it may reject a step
  bool single_instance = false;  ///< no second instance in the same process
  /// A copy of its process (fork) has all of its state; false for a unit that talks to another
  /// process, or has threads.
  bool allows_snapshots = true;
  /// While its inputs are held, steps of any sizes between two instants lead to the same values,
  /// but for rounding.
  bool split_invariant = false;
  bool promises_idle = false;          ///< idle_until() may promise something (<stride/idle.h>)
  std::optional<Duration> fixed_step;  ///< its internal step size, where that is fixed
  /// No communication step may be longer; without a value, or above kMaxSeconds, as Duration::max()
  /// is, it may be of any size.
  std::optional<Duration> maximum_step;
  std::optional<Duration>
      default_step;                   ///< the communication step it prefers, where none is chosen
  std::optional<Time> default_start;  ///< where a run of it begins, likewise
  std::optional<Time> default_stop;   ///< where it ends
};

/// A unit. The kit calls the virtual functions in this order and never at the same time:
///
///   constructor, initialize (again, from scratch, each time inputs or parameters changed before
///   the start), event, then steps and events in turn, terminate, destructor.
///
/// Inputs and parameters are in their members before each call; outputs are read from theirs after
/// it. A reset is a new object. An exception that leaves any of them becomes fmi3Error with its
/// text as the message; none crosses the C ABI.
class Unit {
 public:
  virtual ~Unit() = default;
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  /// Computes the initial values of the outputs from parameters and inputs. May be called more than
  /// once; each call starts from scratch.
  virtual void initialize(Time /*start*/) {}
  /// Advances from step.from() to step.to().
  virtual void step(Step& step) = 0;
  /// Handles the clocks that ticked and the discrete changes of inputs; may tick output clocks.
  virtual void event(Event& /*event*/) {}
  /// Recomputes the outputs that depend directly on inputs; called in Event Mode before outputs are
  /// read, where inputs or clocks were set, so what a tick puts out at once is computed here.
  virtual void update_outputs() {}
  virtual void terminate() {}

  /// Until when the unit promises to be idle, as <stride/idle.h> has it, for the inputs that are in
  /// its members; an instant that is not after `now` is not a promise, Time::max() one without an
  /// end. Called where a step or Event Mode has ended, and only where the importer has enabled
  /// skipping; it changes nothing. The kit cuts the promise off at max_skip(), at the event that
  /// the unit has announced, and at its maximum_step. Needs UnitInfo::promises_idle.
  virtual Time idle_until(Time now) const { return now; }

  /// A value of this Binary variable in words, as <stride/describe.h> has it: a line as
  /// short as can be, in UTF-8; empty if there is no text. Called with any bytes, also of a
  /// size that the unit never sends. Control characters become blanks; what is thrown is logged as
  /// a warning, and the run goes on without the text.
  virtual std::string describe_message(const Variable& /*variable*/,
                                       const Binary& /*value*/) const {
    return {};
  }

  /// What state() cannot list; called after the listed members, in both directions, in any mode. A
  /// change of what is written needs another UnitInfo::version, so that states from before it are
  /// refused. What load_state() throws refuses the state: one that was serialised leaves the
  /// instance as it was.
  virtual void save_state(StateWriter& /*writer*/) const {}
  virtual void load_state(StateReader& /*reader*/) {}

  const UnitInfo& info() const { return info_; }
  const std::deque<Variable>& variables() const { return variables_; }
  const std::vector<UnitOfMeasureDefinition>& units_of_measure() const { return units_of_measure_; }
  bool lists_state() const { return lists_state_; }
  const std::vector<StateItem>& state_items() const { return state_items_; }

  using Logger = std::function<void(Severity, const std::string&)>;
  void set_logger(Logger logger) { logger_ = std::move(logger); }
  void set_results(std::filesystem::path folder) { results_ = std::move(folder); }

 protected:
  Unit() = default;

  /// Bind a member to a variable. T: double, float, any integer type, bool, std::string,
  /// stride::Binary, stride::Clock, an enum class with the underlying type std::int64_t, or a
  /// std::array or std::vector of one of these, which must not be resized afterwards
  /// (std::vector<std::uint8_t> is a Binary scalar; use std::array for UInt8 arrays).
  template <class T>
  VariableBuilder input(std::string name, T& member) {
    return add(std::move(name), Causality::Input, Initial::Exact, member);
  }
  /// Its initial value is computed by initialize(), unless exact() is called.
  template <class T>
  VariableBuilder output(std::string name, T& member) {
    return add(std::move(name), Causality::Output, Initial::Calculated, member);
  }
  /// Of an array whose size is known at run time only: so many elements from this one on, which
  /// must stay there.
  template <class T>
  VariableBuilder output(std::string name, T* elements, std::size_t size) {
    return add_row(std::move(name), Causality::Output, Initial::Calculated, detail::type_of<T>(),
                   elements, size, {size});
  }
  template <class T>
  VariableBuilder input(std::string name, T* elements, std::size_t size) {
    return add_row(std::move(name), Causality::Input, Initial::Exact, detail::type_of<T>(),
                   elements, size, {size});
  }
  /// Fixed, unless tunable() is called.
  template <class T>
  VariableBuilder parameter(std::string name, T& member) {
    return add(std::move(name), Causality::Parameter, Initial::Exact, member);
  }
  template <class T>
  VariableBuilder parameter(std::string name, T* elements, std::size_t size) {
    return add_row(std::move(name), Causality::Parameter, Initial::Exact, detail::type_of<T>(),
                   elements, size, {size});
  }
  template <class T>
  VariableBuilder local(std::string name, T& member) {
    return add(std::move(name), Causality::Local, Initial::Calculated, member);
  }

  /// Defines a unit of measure for .unit(), which the kit does not know
  /// (<stride/unit_of_measure.h>) or knows as something else: a value of it is factor * value +
  /// offset in the unit `in`.
  ///
  ///   unit_of_measure("furlong", 201.168, "m");
  void unit_of_measure(std::string name, double factor, std::string in, double offset = 0) {
    units_of_measure_.push_back({std::move(name), factor, std::move(in), offset});
  }

  /// Declares that the variables and the members listed here are the whole state, so that the unit
  /// can be saved, rolled back and serialised. May be called several times; state() alone declares
  /// that the variables are all.
  ///
  /// The whole state is all that a later call reads and an earlier one may have changed, the
  /// members that .derivative() names among it; the kit keeps the time, the mode, clocks, announced
  /// events and idle settings itself. What follows from parameters and resources is made again in
  /// load_state(): a serialised state may be restored in an instance that was never initialised.
  /// Its bytes are the same in each build of the same source. They name the unit, its version and
  /// its variables, so those of another unit or version are refused.
  template <class... Members>
  void state(Members&... members) {
    lists_state_ = true;
    (state_items_.push_back(StateItem::of(members)), ...);
  }

  /// How long the unit may skip its own idle time and promise to be idle, at most, as the importer
  /// has enabled it: > 0, Duration::max() for ever. Empty where idle time is to be simulated like
  /// any other, and in the constructor.
  std::optional<Duration> max_skip() const { return max_skip_; }
  /// The tolerance in force of an output that has a tolerance(), or of an element of such an array;
  /// throws std::logic_error for any other member.
  double tolerance_of(const double& output) const;

  /// Setup::results, for units that do not keep it; empty in the constructor.
  const std::filesystem::path& results() const { return results_; }

  UnitInfo& describe(std::string text) { return info_.description = std::move(text), info_; }

  void log(Severity severity, const std::string& message) const {
    if (logger_) logger_(severity, message);
  }

 private:
  template <class T>
  VariableBuilder add(std::string name, Causality causality, Initial initial, T& member) {
    return add_row(std::move(name), causality, initial, detail::type_of<T>(), &member, 1, {});
  }
  template <class T, std::size_t N>
  VariableBuilder add(std::string name, Causality causality, Initial initial,
                      std::array<T, N>& member) {
    return add_row(std::move(name), causality, initial, detail::type_of<T>(), member.data(), N,
                   {N});
  }
  VariableBuilder add(std::string name, Causality causality, Initial initial, Binary& member) {
    return add_row(std::move(name), causality, initial, Type::Binary, &member, 1, {});
  }
  template <class T>
  VariableBuilder add(std::string name, Causality causality, Initial initial,
                      std::vector<T>& member) {
    static_assert(!std::is_same_v<T, bool>, "use std::array<bool, N>");
    const std::size_t size = member.size();
    return add_row(std::move(name), causality, initial, detail::type_of<T>(), member.data(), size,
                   {size});
  }
  VariableBuilder add_row(std::string name, Causality causality, Initial initial, Type type,
                          void* data, std::size_t size, std::vector<std::size_t> dimensions);

  UnitInfo info_;
  std::deque<Variable> variables_;
  std::vector<UnitOfMeasureDefinition> units_of_measure_;
  bool lists_state_ = false;
  std::vector<StateItem> state_items_;
  Logger logger_;
  std::filesystem::path results_;

  friend class kit::IdleSettings;
  /// The tolerance of the elements of one output.
  struct Tolerance {
    const double* first;
    const double* last;
    double value;
  };
  std::optional<Duration> max_skip_;
  std::vector<Tolerance> tolerances_;  ///< in the order of the table; set by the kit
};

/// Supplied by STRIDE_UNIT in the unit's library.
struct UnitFactory {
  const char* name;
  std::unique_ptr<Unit> (*make)(const Setup& setup);
};
UnitFactory unit_factory();

template <class T>
std::unique_ptr<Unit> make_unit(const Setup& setup) {
  if constexpr (std::is_constructible_v<T, const Setup&>) {
    return std::make_unique<T>(setup);
  } else {
    return std::make_unique<T>();
  }
}

}  // namespace stride

/// Makes a class the unit of this library, which stride_add_unit(NAME ...) built under
/// STRIDE_UNIT_NAME.
#define STRIDE_UNIT(Class)                                \
  stride::UnitFactory stride::unit_factory() {            \
    return {STRIDE_UNIT_NAME, &stride::make_unit<Class>}; \
  }

#endif
