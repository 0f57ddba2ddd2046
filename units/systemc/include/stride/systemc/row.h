// The rows of a ModuleUnit: each moves one value between a variable of FMI and a place in a module.
#ifndef STRIDE_SYSTEMC_ROW_H
#define STRIDE_SYSTEMC_ROW_H

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>

#include <stride/systemc/conversion.h>
#include <stride/systemc/kernel.h>
#include <stride/systemc/port.h>
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

  /// While the module is elaborated: binds its port. Returns the port that was bound, if any.
  virtual const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) = 0;
  /// From the variable to the module, and back.
  virtual void write() {}
  virtual void read() {}
  /// The signals that connect() has made.
  virtual void list_signals(SignalList& /*signals*/) const {}

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

/// A row that leads to a port or a signal of values T.
template <class T>
class PlaceRow : public Row {
 public:
  using Value = T;
  using Find = std::function<Place<T>(sc_core::sc_module&)>;
  using Signal = sc_core::sc_signal<T>;

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
  /// Makes a signal, and binds the port to it.
  void bind(Kernel& kernel, const T& value) {
    auto signal = std::make_unique<Signal>(sc_core::sc_gen_unique_name("signal"), value);
    own_ = signal.get();
    kernel.own(std::move(signal));
    if (place_.in != nullptr) return place_.in->bind(*own_);
    place_.out->bind(*own_);
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

  const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) override {
    this->find(module);
    writer_ = nullptr;
    const T start = converted();
    if (this->place().is_port()) {
      this->bind(kernel, start);
      return this->place().object;
    }
    if (as_writer(*this->place().signal) == nullptr) {
      throw std::invalid_argument(this->name() + ": this signal cannot be written from outside");
    }
    return nullptr;
  }
  void write() override {
    if (writer_ == nullptr) writer_ = as_writer(this->channel());
    writer_->write(converted());
  }

 private:
  static sc_core::sc_signal_inout_if<T>* as_writer(sc_core::sc_signal_in_if<T>& channel) {
    return dynamic_cast<sc_core::sc_signal_inout_if<T>*>(&channel);
  }
  T converted() const {
    return named(*this, [this]() -> T { return Conversion<T>::from_fmi(value); });
  }

  sc_core::sc_signal_inout_if<T>* writer_ = nullptr;
};

/// A port of the module itself is bound to a signal; one that a submodule has is bound by the
/// module, and read like a signal.
template <class T>
class OutputRow final : public PlaceRow<T> {
 public:
  using Fmi = typename Conversion<T>::Fmi;
  Fmi value{};

  using PlaceRow<T>::PlaceRow;

  const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) override {
    this->find(module);
    const bool is_output = this->place().out != nullptr;
    if (!is_output || this->place().object->get_parent_object() != &module) return nullptr;
    this->bind(kernel, T());
    return this->place().object;
  }
  void read() override {
    value = named(*this, [this]() -> Fmi { return Conversion<T>::to_fmi(this->channel().read()); });
  }
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

  const sc_core::sc_object* connect(Kernel& /*kernel*/, sc_core::sc_module& module) override {
    module_ = &module;
    return nullptr;
  }
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

  const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) override {
    this->find(module);
    if (!this->place().is_port()) throw std::invalid_argument("only a port is tied, not a signal");
    this->bind(kernel, value_);
    return this->place().object;
  }

 private:
  T value_;
};

/// A port that is driven by a clock of the unit's own, with rising edges from 0 s on.
class ClockRow final : public Row {
 public:
  using Find = std::function<Place<bool>(sc_core::sc_module&)>;

  ClockRow(Find find, std::function<Duration()> period)
      : Row("clock"), find_(std::move(find)), period_(std::move(period)) {}

  const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) override;
  void list_signals(SignalList& signals) const override;
  Duration period() const { return current_period_; }

 private:
  Find find_;
  std::function<Duration()> period_;
  Duration current_period_{};
  sc_core::sc_object* port_ = nullptr;
  sc_core::sc_clock* clock_ = nullptr;
};

/// A port that has a level from 0 s on for a time, and the other one ever after.
class ResetRow final : public Row {
 public:
  using Find = std::function<Place<bool>(sc_core::sc_module&)>;

  ResetRow(Find find, Duration length, bool level)
      : Row("reset"), find_(std::move(find)), length_(length), level_(level) {}

  const sc_core::sc_object* connect(Kernel& kernel, sc_core::sc_module& module) override;
  void list_signals(SignalList& signals) const override;

 private:
  Find find_;
  Duration length_;
  bool level_;
  sc_core::sc_object* port_ = nullptr;
  sc_core::sc_signal<bool>* signal_ = nullptr;
};

}  // namespace stride::systemc::detail

#endif
