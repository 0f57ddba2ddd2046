// An sc_module with ordinary ports as a unit: a table of which variable belongs to which port.
//
//   class Thermometer : public stride::systemc::ModuleUnit<ThermometerModule> {
//    public:
//     Thermometer() : ModuleUnit("thermometer", "A thermometer with a serial interface") {
//       clock(&ThermometerModule::clk, 100ns);
//       reset(&ThermometerModule::rst_n, 1us, false);
//       input("temperature", &ThermometerModule::temperature).unit("degC");
//       output("ready", &ThermometerModule::ready);
//       output("adc.code", inner<sc_dt::sc_uint<12>>("adc.code"));
//     }
//   };
//   STRIDE_UNIT(Thermometer)
#ifndef STRIDE_SYSTEMC_MODULE_UNIT_H
#define STRIDE_SYSTEMC_MODULE_UNIT_H

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <stride/systemc/message.h>
#include <stride/systemc/row.h>
#include <stride/systemc/sampling.h>
#include <stride/systemc/unit.h>

namespace stride::systemc {

/// What else is to be said of an output().
class OutputBuilder : public VariableBuilder {
 public:
  OutputBuilder(VariableBuilder builder, detail::Row& row, bool& has_changed)
      : VariableBuilder(builder), row_(row), has_changed_(has_changed) {}

  /// A step ends where the value changes, so that other units see it at that instant: for an
  /// interrupt. Comes before what VariableBuilder says. A change is an early return, and is seen
  /// at the end of the step where the importer does not allow one. Throws std::invalid_argument for
  /// a function or a plain member, whose changes have no event.
  OutputBuilder& stop_on_change() { return row_.stop_on_change(has_changed_), *this; }

 private:
  detail::Row& row_;
  bool& has_changed_;
};

/// A DeviceUnit that is declared row by row, in the constructor. A row's target is where its value
/// is in the module:
///
///   &Module::port                            a port, a signal, or another member of the module
///   [](Module& m) -> auto& { return m.a.b; } the same of a submodule
///   inner<T>("adc.code")                     by its SystemC name, also if it is private
///   [](Module& m) { return m.current(); }    what a function gives; for outputs only
///
/// The variable's type follows from the value's, see Conversion. Each port of the module has one
/// row: of an input, an output, a message, a clock, a reset, or it is tied.
///
/// All functions of DeviceUnit can still be overridden; one that moves values calls the function
/// that it overrides, too.
template <class Module>
class ModuleUnit : public DeviceUnit<Module> {
  template <class Target>
  using ValueOf = typename detail::ValueAt<Target, Module>::Type;
  template <class Target>
  using FmiOf = typename Conversion<ValueOf<Target>>::Fmi;
  template <class Target>
  static constexpr bool kIsTarget =
      std::is_invocable_v<const Target&, Module&> || detail::LeadsToPlace<Target, Module>::value;

 protected:
  using typename DeviceUnit<Module>::Device;
  using typename DeviceUnit<Module>::Log;
  using DeviceUnit<Module>::input;
  using DeviceUnit<Module>::output;
  using DeviceUnit<Module>::local;

  /// `name`: of the module in SystemC, and so of the scope in traces.
  ModuleUnit(std::string name, std::string description)
      : DeviceUnit<Module>(std::move(description)), name_(std::move(name)) {}

  // The module.

  /// The arguments that follow the name in the module's constructor. They are looked at where the
  /// module is made, so parameters in members of the unit have their values by then.
  template <class... Arguments>
  void construct(Arguments&&... arguments) {
    static_assert(std::is_constructible_v<Module, const char*, const std::decay_t<Arguments>&...>,
                  "the module has no constructor that takes its name and these arguments");
    // members by reference, temporaries by value
    make_ = [values = std::tuple<Arguments...>(arguments...)](const char* name) {
      return std::apply(
          [name](const auto&... value) { return std::make_unique<Module>(name, value...); },
          values);
    };
  }
  /// Makes the module, where its constructor needs more than that.
  void construct_by(std::function<std::unique_ptr<Module>(const char* name)> make) {
    make_ = std::move(make);
  }

  // Values.

  /// A port that the unit writes, or a signal. It is written where the variable has changed, so
  /// what the module writes into an sc_inout or a signal itself stays until then.
  template <class Target, std::enable_if_t<kIsTarget<Target>, int> = 0>
  VariableBuilder input(std::string name, Target target) {
    return input(std::move(name), std::move(target), detail::start_of<Target, Module>());
  }
  /// With another start value than 0, or Z where the port is resolved.
  template <class Target, std::enable_if_t<kIsTarget<Target>, int> = 0>
  VariableBuilder input(std::string name, Target target, FmiOf<Target> start) {
    static_assert(detail::LeadsToPlace<Target, Module>::value,
                  "an input needs an sc_in, an sc_inout or an sc_signal");
    static_assert(!detail::LeadsToOut<Target, Module>::value,
                  "the module drives its sc_out: it takes an output() or tie()");
    auto row = std::make_unique<detail::InputRow<ValueOf<Target>>>(name, find(std::move(target)));
    row->value = std::move(start);
    return add(row, this->Unit::input(std::move(name), row->value));
  }
  /// A port, a signal, or the value of a member or a function. An sc_inout may have an input and an
  /// output, of two names: the output is what the signal holds, whichever of both wrote last.
  template <class Target, std::enable_if_t<kIsTarget<Target>, int> = 0>
  OutputBuilder output(std::string name, Target target) {
    auto row = make_output(name, std::move(target));
    detail::Row& kept = *row;
    return {add(row, this->Unit::output(std::move(name), row->value)), kept, has_stopped_};
  }
  /// The same, for what no other unit is concerned with.
  template <class Target, std::enable_if_t<kIsTarget<Target>, int> = 0>
  VariableBuilder local(std::string name, Target target) {
    auto row = make_output(name, std::move(target));
    return add(row, this->Unit::local(std::move(name), row->value));
  }
  /// An sc_vector of so many ports or signals: the variables NAME[0], NAME[1], …
  template <class Target>
  std::vector<VariableBuilder> inputs(const std::string& name, Target target, std::size_t size) {
    return each_of(name, size, [&](std::string one, std::size_t i) {
      return input(std::move(one), element(target, i));
    });
  }
  template <class Target>
  std::vector<VariableBuilder> outputs(const std::string& name, Target target, std::size_t size) {
    return each_of(name, size, [&](std::string one, std::size_t i) {
      return output(std::move(one), element(target, i));
    });
  }
  /// A port without a variable: an input that always has this value, an output that leads nowhere.
  template <class Target>
  void tie(Target target) {
    tie(std::move(target), detail::value_at_rest<ValueOf<Target>>());
  }
  template <class Target>
  void tie(Target target, ValueOf<Target> value) {
    add_row(std::make_unique<detail::TiedRow<ValueOf<Target>>>("tie()", find(std::move(target)),
                                                               std::move(value)));
  }

  // Other ports.

  /// A port of any interface (sc_port<IF>, an sc_export that the module leaves open) is
  /// bound to the adapter: a channel that is made anew with each module, by a function that returns
  /// a unique_ptr or shared_ptr to it, or a member of the unit that is no sc_object, and has the
  /// interface.
  template <class Target, class Adapter>
  void bind(Target target, Adapter&& adapter) {
    auto find = [target](sc_core::sc_module & module) -> auto& {
      return std::invoke(target, static_cast<Module&>(module));
    };
    if constexpr (std::is_invocable_v<Adapter&>) {
      add_row(std::make_unique<detail::BoundRow>(
          [find, make = std::forward<Adapter>(adapter)](detail::Elaboration& elaboration) {
            auto made = make();
            auto& port = find(elaboration.module());
            elaboration.take(port, "bind()");
            port.bind(*made);
            elaboration.kernel().own(std::move(made));
          }));
    } else {
      static_assert(std::is_lvalue_reference_v<Adapter>,
                    "bind() keeps no copy: pass a member of the unit, or a function that makes it");
      add_row(
          std::make_unique<detail::BoundRow>([find, &adapter](detail::Elaboration& elaboration) {
            auto& port = find(elaboration.module());
            elaboration.take(port, "bind()");
            port.bind(adapter);
          }));
    }
  }

  // Clocks and resets.

  /// The unit drives the port, an sc_in<bool> or sc_in<sc_logic>: rising edges at 0 s and after
  /// each period, falling ones in the middle. Without idle_when() the unit prefers communication
  /// steps of one period, of the shortest of several clocks: its inputs can then change from cycle
  /// to cycle.
  template <class Target>
  void clock(Target target, Duration period) {
    add_clock(std::move(target), [period] { return period; });
    prefer_step(period);
  }
  /// With the frequency that this member, a parameter, has at the start [Hz].
  template <class Target>
  void clock(Target target, double& frequency) {
    add_clock(std::move(target), [&frequency] {
      if (frequency > 0) return duration_from_seconds(1 / frequency);
      throw std::invalid_argument("a clock's frequency is " + std::to_string(frequency) +
                                  " Hz; it must be more than 0");
    });
    if (frequency > 0) prefer_step(duration_from_seconds(1 / frequency));
  }
  /// The port, an sc_in<bool> or sc_in<sc_logic>, has this level for the first `length` of the run,
  /// and the other one ever after.
  template <class Target>
  void reset(Target target, Duration length, bool level) {
    add_row(std::make_unique<detail::ResetRow<ValueOf<Target>>>(find_level(std::move(target)),
                                                                length, level));
  }

  // Messages: a Binary variable NAME, and its clock, which has `clock` in the place of what stands
  // behind the last dot of the name.

  /// The target is an sc_fifo_in<T>, which gets the elements of the message (see Message); elements
  /// that find it full are lost, which is logged. Or a function (Module&, const Binary&), which
  /// is called outside of all processes, so that it must not wait.
  template <class Target>
  VariableBuilder message_input(std::string name, Target target, int depth = 16) {
    std::unique_ptr<detail::MessageRow> row;
    if constexpr (std::is_invocable_v<const Target&, Module&, const Binary&>) {
      row = std::make_unique<detail::FunctionInputRow>(
          name, [target](sc_core::sc_module& module, const Binary& message) {
            std::invoke(target, static_cast<Module&>(module), message);
          });
    } else {
      row = fifo_input(name, std::move(target), depth);
    }
    this->Unit::input(row->clock_name(), row->clock);
    VariableBuilder builder = this->Unit::input(std::move(name), row->value);
    return add_message(std::move(row), builder);
  }
  /// The target is an sc_fifo_out<T>, of which each element is a message (see Message). Or a
  /// function (Module&, Sender), which is called once when the module has been made, and gives it
  /// the Sender to call.
  template <class Target>
  VariableBuilder message_output(std::string name, Target target) {
    auto row = std::make_unique<detail::MessageOutputRow>(name, sender_to(name, std::move(target)));
    this->Unit::output(row->clock_name(), row->clock);
    VariableBuilder builder = this->Unit::output(std::move(name), row->value);
    return add_message(std::move(row), builder);
  }

  // Idle time.

  /// The condition for idle(); calls may_idle(). `edges` is what the module makes of the edges of
  /// its clock that are skipped: counts_nothing(), repeats_every(period) where it divides the
  /// clock, or a function (Module&, const Skipped&) that lets its counters catch up. Without such a
  /// function nothing is skipped or promised unless the module has stayed what it was for a period.
  ///
  /// While the module is idle its ports and signals stay what they are, so the unit promises that
  /// it need not be called. Where outputs are functions or plain members, which may move, it
  /// promises nothing, unless tangents_hold_for() is overridden.
  template <class Edges>
  void idle_when(std::function<bool(const Module&)> idle, Edges edges) {
    this->may_idle();
    this->describe(this->info().description).default_step.reset();
    idle_ = std::move(idle);
    repetition_ = {};
    catch_up_ = nullptr;
    if constexpr (std::is_same_v<Edges, RepeatsEvery>) {
      repetition_ = edges.period;
    } else if constexpr (!std::is_same_v<Edges, CountsNothing>) {
      static_assert(std::is_invocable_v<const Edges&, Module&, const Skipped&>,
                    "the second argument of idle_when() is counts_nothing(), repeats_every(period) "
                    "or a function (Module&, const Skipped&)");
      catch_up_ = std::move(edges);
    }
  }
  template <class Idle>
  void idle_when(Idle /*idle*/) {
    static_assert(detail::kNever<Idle>,
                  "idle_when() also takes what the module makes of the edges of its clock that are "
                  "skipped: counts_nothing(), repeats_every(period), or a function that gets their "
                  "number");
  }

  /// For rows of other kinds.
  void add_row(std::unique_ptr<detail::Row> row) { rows_.push_back(std::move(row)); }
  VariableBuilder add_message(std::unique_ptr<detail::MessageRow> row, VariableBuilder builder) {
    builder.clocked_by(row->clock).mime_type("application/octet-stream");
    messages_.push_back(std::move(row));
    return builder;
  }

  std::unique_ptr<Device> make_device(Log log) override {
    sampling_ = {};
    has_changed_ = false;
    try {
      return std::make_unique<Device>(std::move(log),
                                      [this](Kernel& kernel) { return make_module(kernel); });
    } catch (const DeviceError& error) {
      const std::string hint = detail::hint_of_binding(error.what());
      if (hint.empty()) throw;
      throw DeviceError(error.what() + hint);
    }
  }
  void write_inputs(Module& /*module*/) override {
    for (const auto& row : rows_) {
      if (row->write()) has_changed_ = true;
    }
  }
  void read_outputs(Module& /*module*/) override {
    for (const auto& row : rows_) row->read();
  }
  void receive(Module& /*module*/) override {
    for (const auto& row : messages_) {
      const std::size_t lost = row->receive();
      if (lost == 0) continue;
      this->log(Severity::Warning, row->name() + ": the FIFO is full, " + std::to_string(lost) +
                                       " elements of a message are lost");
    }
  }
  void publish() override {
    for (const auto& row : messages_) row->publish();
  }
  bool has_message() const override {
    for (const auto& row : messages_) {
      if (row->has_message()) return true;
    }
    return false;
  }
  bool wants_to_stop() const override { return has_stopped_ || has_message(); }
  void list_signals(const Module& module, SignalList& signals) const override {
    DeviceUnit<Module>::list_signals(module, signals);
    for (const auto& row : rows_) row->list_signals(signals);
  }
  void begin_step(const Step& step) override {
    has_stopped_ = false;
    sampling_.begin_step(step.size(), shortest_period(), std::exchange(has_changed_, false));
  }
  void end() override {
    const std::string warning = idle_ ? "" : sampling_.warning(shortest_period());
    if (!warning.empty()) this->log(Severity::Warning, warning);
  }
  bool idle(const Module& module) const override { return idle_ && idle_(module); }
  /// Of the unit's clocks, and of repeats_every(). A module with a clock of its own inside
  /// overrides it.
  Duration clock_period(const Module& /*module*/) const override {
    Duration period = repetition_;
    for (const detail::ClockRow* clock : clocks_) {
      const Duration other = clock->period();
      period = period == Duration{}
                   ? other
                   : other / common_divisor(period, other).count() * period.count();
    }
    return period;
  }
  void on_skip(Module& module, Duration skipped) override {
    if (!catch_up_) return;
    const Duration period = shortest_period();
    const Picoseconds cycles = period > Duration{} ? skipped / period : 0;
    catch_up_(module, Skipped{skipped, static_cast<std::int64_t>(cycles)});
  }
  bool is_watched() const override { return !catch_up_; }
  Duration tangents_hold_for(const Module& /*module*/) const override {
    return idle_ && !has_functions_ ? Duration::max() : Duration{};
  }

 private:
  template <class Target>
  auto find(Target target) {
    return [target = std::move(target)](sc_core::sc_module& module) {
      return detail::find_place(target, static_cast<Module&>(module));
    };
  }
  template <class Target>
  auto find_level(Target target) {
    using T = ValueOf<Target>;
    static_assert(std::is_same_v<T, bool> || std::is_same_v<T, sc_dt::sc_logic>,
                  "this needs an sc_in<bool> or an sc_in<sc_logic>");
    return find(std::move(target));
  }
  template <class Target>
  static auto element(Target target, std::size_t i) {
    return [ target, i ](Module & module) -> auto& { return std::invoke(target, module).at(i); };
  }
  template <class Add>
  static std::vector<VariableBuilder> each_of(const std::string& name, std::size_t size, Add add) {
    std::vector<VariableBuilder> rows;
    for (std::size_t i = 0; i < size; ++i)
      rows.push_back(add(name + '[' + std::to_string(i) + ']', i));
    return rows;
  }

  template <class Row>
  VariableBuilder add(std::unique_ptr<Row>& row, VariableBuilder builder) {
    using Value = typename Row::Value;
    Conversion<Value>::describe(builder);
    add_row(std::move(row));
    return builder;
  }
  template <class Target>
  auto make_output(const std::string& name, Target target) {
    if constexpr (detail::LeadsToPlace<Target, Module>::value) {
      return std::make_unique<detail::OutputRow<ValueOf<Target>>>(name, find(std::move(target)));
    } else {
      using T = std::decay_t<detail::Reached<Target, Module>>;
      static_assert(
          !std::is_base_of_v<sc_core::sc_object, T>,
          "an output needs a port or a signal of a value, or a function that returns a "
          "value. An sc_fifo_out takes a message_output(), a TLM socket a row of TlmUnit, a "
          "port of another interface bind(&Module::port, adapter)");
      has_functions_ = true;
      return std::make_unique<detail::ValueRow<T>>(
          name, [target = std::move(target)](sc_core::sc_module& module) -> T {
            return std::invoke(target, static_cast<Module&>(module));
          });
    }
  }
  template <class Target>
  void add_clock(Target target, std::function<Duration()> period) {
    auto row = std::make_unique<detail::ClockRowOf<ValueOf<Target>>>(find_level(std::move(target)),
                                                                     std::move(period));
    clocks_.push_back(row.get());
    add_row(std::move(row));
  }
  void prefer_step(Duration period) {
    std::optional<Duration>& step = this->describe(this->info().description).default_step;
    if (!idle_) step = std::min(step.value_or(period), period);
  }
  Duration shortest_period() const {
    Duration period{};
    for (const detail::ClockRow* clock : clocks_) {
      period = period == Duration{} ? clock->period() : std::min(period, clock->period());
    }
    return period;
  }

  template <class Target>
  std::unique_ptr<detail::MessageRow> fifo_input(std::string name, Target target, int depth) {
    using Fifo = detail::FifoAt<Target, Module>;
    static_assert(Fifo::kDirection == detail::Direction::In,
                  "a message input needs an sc_fifo_in, or a function (Module&, const Binary&)");
    using T = typename Fifo::Element;
    return std::make_unique<detail::FifoInputRow<T>>(
        std::move(name),
        [target](sc_core::sc_module& module) -> detail::FifoIn<T>& {
          return std::invoke(target, static_cast<Module&>(module));
        },
        depth);
  }
  template <class Target>
  detail::MessageOutputRow::Connect sender_to(const std::string& name, Target target) {
    if constexpr (std::is_invocable_v<const Target&, Module&, const Sender&>) {
      return [target](detail::Elaboration& elaboration, const Sender& send) {
        std::invoke(target, static_cast<Module&>(elaboration.module()), send);
      };
    } else {
      using Fifo = detail::FifoAt<Target, Module>;
      static_assert(Fifo::kDirection == detail::Direction::Out,
                    "a message output needs an sc_fifo_out, or a function (Module&, Sender)");
      using T = typename Fifo::Element;
      return [name, target](detail::Elaboration& elaboration, const Sender& send) {
        auto& port = std::invoke(target, static_cast<Module&>(elaboration.module()));
        elaboration.take(port, name);
        auto outlet = std::make_unique<detail::Outlet<T>>(send);
        port.bind(*outlet);
        elaboration.kernel().own(std::move(outlet));
      };
    }
  }
  std::unique_ptr<Module> make_module(Kernel& kernel) {
    if (!make_) {
      if constexpr (std::is_constructible_v<Module, const char*>) {
        make_ = [](const char* name) { return std::make_unique<Module>(name); };
      } else {
        throw std::logic_error(
            "the module's constructor takes more than its name: call construct()");
      }
    }
    auto module = make_(name_.c_str());
    detail::Elaboration elaboration(kernel, *module);
    for (const auto& row : rows_) row->connect(elaboration);
    for (const auto& row : messages_) row->connect(elaboration);
    return module;
  }

  std::string name_;
  std::function<std::unique_ptr<Module>(const char*)> make_;
  std::vector<std::unique_ptr<detail::Row>> rows_;
  std::vector<std::unique_ptr<detail::MessageRow>> messages_;
  std::vector<const detail::ClockRow*> clocks_;
  std::function<bool(const Module&)> idle_;
  Duration repetition_{};  ///< of repeats_every()
  std::function<void(Module&, const Skipped&)> catch_up_;
  bool has_functions_ = false;  ///< among the outputs
  bool has_changed_ = false;    ///< an input, since the last step began
  bool has_stopped_ = false;    ///< likewise, an output whose changes end steps
  detail::Sampling sampling_;
};

}  // namespace stride::systemc

#endif
