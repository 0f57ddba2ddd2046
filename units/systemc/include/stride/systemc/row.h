// The rows of a ModuleUnit: each moves one value between a variable of FMI and a place in a module.
#ifndef STRIDE_SYSTEMC_ROW_H
#define STRIDE_SYSTEMC_ROW_H

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>

#include <stride/systemc/conversion.h>
#include <stride/systemc/elaboration.h>
#include <stride/systemc/kernel.h>
#include <stride/systemc/port.h>
#include <stride/systemc/signal.h>
#include <stride/systemc/trace.h>

namespace stride::systemc::detail {

/// Belongs to the unit, and is connected to each module that the unit makes.
class Row {
 public:
  explicit Row(std::string name) : name_(std::move(name)) {}
  virtual ~Row() = default;
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  /// For messages.
  const std::string& name() const { return name_; }

  /// While the module is elaborated: binds its port, if it leads to one.
  virtual void connect(Elaboration& elaboration) = 0;
  /// From the variable to the module, where the variable has changed; returns whether it has.
  virtual bool write() { return false; }
  /// From the module to the variable.
  virtual void read() {}
  /// The signals that connect() has made.
  virtual void list_signals(SignalList& /*signals*/) const {}
  /// Of an output, before connect(): where its value changes, the device pauses and `has_changed`
  /// is set. Throws std::invalid_argument where no event tells of a change.
  virtual void stop_on_change(bool& /*has_changed*/) {
    throw std::invalid_argument(name_ + ": stop_on_change() needs a port or a signal");
  }

 private:
  std::string name_;
};

/// Calls f, and puts the row's name before what it throws.
template <class Function>
decltype(auto) named(const Row& row, Function&& f) {
  try {
    return f();
  } catch (const std::out_of_range& error) {
    throw std::out_of_range(row.name() + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(row.name() + ": " + error.what());
  }
}

/// While a module is elaborated: where the value of the port, or else of the channel, changes, the
/// device calls sc_pause and `has_changed` is set.
void pause_on_change(sc_core::sc_port_base* port, sc_core::sc_interface* channel,
                     bool& has_changed);

/// A row that leads to a port or a signal of values T.
template <class T>
class PlaceRow : public Row {
 public:
  using Value = T;
  using Find = std::function<Place<T>(sc_core::sc_module&)>;
  using Signal = sc_core::sc_signal_inout_if<T>;

  PlaceRow(std::string name, Find find) : Row(std::move(name)), find_(std::move(find)) {}

  void list_signals(SignalList& signals) const override {
    if (own_ != nullptr) signals.add_port(*place_.object, *own_);
  }

 protected:
  void find(sc_core::sc_module& module) {
    place_ = named(*this, [&] { return find_(module); });
    own_ = nullptr;
    channel_ = nullptr;
  }
  /// Binds the port to a signal, a new one or that of the row of the other direction.
  Signal& bind(Elaboration& elaboration, const T& value, Share share = Share::Whole) {
    const bool is_inout = place_.out != nullptr && !is_output_only(*place_.object);
    sc_core::sc_interface* const other =
        elaboration.take(*place_.object, name(), is_inout ? share : Share::Whole);
    if (other != nullptr) return dynamic_cast<Signal&>(*other);
    own_ = &make_signal(elaboration.kernel(), *place_.object, value);
    elaboration.bound(*place_.object, *own_);
    if (place_.in != nullptr) {
      place_.in->bind(*own_);
    } else {
      place_.out->bind(*own_);
    }
    return *own_;
  }
  const Place<T>& place() const { return place_; }
  /// After elaboration.
  sc_core::sc_signal_in_if<T>& channel() {
    if (channel_ == nullptr) channel_ = &place_.channel();
    return *channel_;
  }

 private:
  Find find_;
  Place<T> place_;
  Signal* own_ = nullptr;
  sc_core::sc_signal_in_if<T>* channel_ = nullptr;
};

/// The port is bound to a signal that the unit writes; a signal is written as it is.
template <class T>
class InputRow final : public PlaceRow<T> {
 public:
  using Fmi = typename Conversion<T>::Fmi;
  Fmi value{};

  using PlaceRow<T>::PlaceRow;

  void connect(Elaboration& elaboration) override {
    this->find(elaboration.module());
    writer_ = nullptr;
    written_.reset();
    if (this->place().is_port()) {
      require_input(*this->place().object);
      const T start = converted();
      this->bind(elaboration, start, Share::Input).write(start);
      written_ = value;
    } else if (as_writer(*this->place().signal) == nullptr) {
      throw std::invalid_argument(this->name() + ": this signal cannot be written from outside");
    }
  }
  // what the module has written since then stays
  bool write() override {
    if (written_ && *written_ == value) return false;
    if (writer_ == nullptr) writer_ = as_writer(this->channel());
    writer_->write(converted());
    written_ = value;
    return true;
  }

 private:
  static sc_core::sc_signal_inout_if<T>* as_writer(sc_core::sc_signal_in_if<T>& channel) {
    return dynamic_cast<sc_core::sc_signal_inout_if<T>*>(&channel);
  }
  void require_input(const sc_core::sc_object& port) const {
    if (!is_output_only(port)) return;
    throw std::invalid_argument(this->name() + ": " + port.name() + " is an " + port.kind() +
                                ", which the module drives; it takes an output()");
  }
  T converted() const {
    return named(*this, [this]() -> T { return Conversion<T>::from_fmi(value); });
  }

  sc_core::sc_signal_inout_if<T>* writer_ = nullptr;
  std::optional<Fmi> written_;
};

/// A port of the module itself is bound to a signal; one that a submodule has is bound by the
/// module, and read like a signal.
template <class T>
class OutputRow final : public PlaceRow<T> {
 public:
  using Fmi = typename Conversion<T>::Fmi;
  Fmi value{};

  using PlaceRow<T>::PlaceRow;

  void connect(Elaboration& elaboration) override {
    this->find(elaboration.module());
    const Place<T>& place = this->place();
    if (has_changed_ != nullptr) pause_on_change(port_of(place), place.signal, *has_changed_);
    const bool is_output = place.out != nullptr;
    if (!is_output || place.object->get_parent_object() != &elaboration.module()) return;
    this->bind(elaboration, value_at_rest<T>(), Share::Output);
  }
  void stop_on_change(bool& has_changed) override { has_changed_ = &has_changed; }
  void read() override {
    value = named(*this, [this]() -> Fmi { return Conversion<T>::to_fmi(this->channel().read()); });
  }

 private:
  static sc_core::sc_port_base* port_of(const Place<T>& place) {
    if (place.in != nullptr) return place.in;
    return place.out;
  }

  bool* has_changed_ = nullptr;  ///< where a change ends the step
};

/// What a function of the module gives, or a member of it that is not a signal.
template <class T>
class ValueRow final : public Row {
 public:
  using Value = T;
  using Fmi = typename Conversion<T>::Fmi;
  using Get = std::function<T(sc_core::sc_module&)>;
  Fmi value{};

  ValueRow(std::string name, Get get) : Row(std::move(name)), get_(std::move(get)) {}

  void connect(Elaboration& elaboration) override { module_ = &elaboration.module(); }
  void read() override { value = Conversion<T>::to_fmi(get_(*module_)); }

 private:
  Get get_;
  sc_core::sc_module* module_ = nullptr;
};

/// A port without a variable: an input has this value always, an output is not connected.
template <class T>
class TiedRow final : public PlaceRow<T> {
 public:
  TiedRow(std::string name, typename PlaceRow<T>::Find find, T value)
      : PlaceRow<T>(std::move(name), std::move(find)), value_(std::move(value)) {}

  void connect(Elaboration& elaboration) override {
    this->find(elaboration.module());
    if (!this->place().is_port()) throw std::invalid_argument("only a port is tied, not a signal");
    auto& signal = this->bind(elaboration, value_);
    if (!is_output_only(*this->place().object)) signal.write(value_);
  }

 private:
  T value_;
};

/// A port that is bound to what is no signal.
class BoundRow final : public Row {
 public:
  using Bind = std::function<void(Elaboration&)>;
  explicit BoundRow(Bind bind) : Row("bind()"), bind_(std::move(bind)) {}

  void connect(Elaboration& elaboration) override { bind_(elaboration); }

 private:
  Bind bind_;
};

/// A port that is driven by a clock of the unit's own, with rising edges from 0 s on.
class ClockRow : public Row {
 public:
  using Row::Row;
  Duration period() const { return current_period_; }

 protected:
  Duration current_period_{};
};

/// T: bool or sc_logic.
template <class T>
class ClockRowOf final : public ClockRow {
 public:
  using Find = std::function<Place<T>(sc_core::sc_module&)>;

  ClockRowOf(Find find, std::function<Duration()> period)
      : ClockRow("clock"), find_(std::move(find)), period_(std::move(period)) {}

  void connect(Elaboration& elaboration) override;
  void list_signals(SignalList& signals) const override { signals.add_port(*port_, *clock_); }

 private:
  Find find_;
  std::function<Duration()> period_;
  sc_core::sc_object* port_ = nullptr;
  sc_core::sc_signal_in_if<T>* clock_ = nullptr;
};

/// A port that has a level from 0 s on for a time, and the other one ever after. T: bool or
/// sc_logic.
template <class T>
class ResetRow final : public Row {
 public:
  using Find = std::function<Place<T>(sc_core::sc_module&)>;

  ResetRow(Find find, Duration length, bool level)
      : Row("reset"), find_(std::move(find)), length_(length), level_(level) {}

  void connect(Elaboration& elaboration) override;
  void list_signals(SignalList& signals) const override { signals.add_port(*port_, *signal_); }

 private:
  Find find_;
  Duration length_;
  bool level_;
  sc_core::sc_object* port_ = nullptr;
  sc_core::sc_signal_inout_if<T>* signal_ = nullptr;
};

extern template class ClockRowOf<bool>;
extern template class ClockRowOf<sc_dt::sc_logic>;
extern template class ResetRow<bool>;
extern template class ResetRow<sc_dt::sc_logic>;

}  // namespace stride::systemc::detail

#endif
