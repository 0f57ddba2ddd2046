// A value of a module that a variable is bound to: a port, a signal, or what a function gives.
#ifndef STRIDE_SYSTEMC_PORT_H
#define STRIDE_SYSTEMC_PORT_H

#include <functional>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>

#include <stride/systemc/conversion.h>

namespace stride::systemc {

/// Names a port or a signal of a module by its SystemC name below the module, with the type of its
/// value. For what C++ does not let you reach, because it is private.
template <class T>
struct Inner {
  std::string name;
};
template <class T>
Inner<T> inner(std::string name) {
  return {std::move(name)};
}

namespace detail {

/// Where a value is held. One of the three is set.
template <class T>
struct Place {
  sc_core::sc_object* object = nullptr;  ///< none for a channel that is not an object
  sc_core::sc_port_b<sc_core::sc_signal_in_if<T>>* in = nullptr;
  sc_core::sc_port_b<sc_core::sc_signal_inout_if<T>>* out = nullptr;
  sc_core::sc_signal_in_if<T>* signal = nullptr;

  bool is_port() const { return signal == nullptr; }

  /// The channel, once ports are bound; throws std::logic_error for a port without one.
  sc_core::sc_signal_in_if<T>& channel() const {
    if (signal != nullptr) return *signal;
    if (in != nullptr) return *in->operator->();
    return *out->operator->();
  }
};

template <class T>
Place<T> place_of(sc_core::sc_port_b<sc_core::sc_signal_in_if<T>>& port) {
  return {&port, &port, nullptr, nullptr};
}
template <class T>
Place<T> place_of(sc_core::sc_port_b<sc_core::sc_signal_inout_if<T>>& port) {
  return {&port, nullptr, &port, nullptr};
}
template <class T>
Place<T> place_of(sc_core::sc_signal_in_if<T>& signal) {
  return {dynamic_cast<sc_core::sc_object*>(&signal), nullptr, nullptr, &signal};
}
/// What the module itself has bound it to.
template <class T>
Place<T> place_of(sc_core::sc_export<sc_core::sc_signal_in_if<T>>& port) {
  return {&port, nullptr, nullptr, port.operator->()};
}
template <class T>
Place<T> place_of(sc_core::sc_export<sc_core::sc_signal_inout_if<T>>& port) {
  return {&port, nullptr, nullptr, port.operator->()};
}

template <class T>
T value_type(const Place<T>&);

/// What a target leads to in a module: std::invoke does for a pointer to a member, for one to a
/// member function, and for a function of the module.
template <class Target, class Module>
using Reached = std::invoke_result_t<const Target&, Module&>;

template <class Target, class Module, class = void>
struct LeadsToPlace : std::false_type {};
template <class Target, class Module>
struct LeadsToPlace<Target, Module,
                    std::void_t<decltype(place_of(std::declval<Reached<Target, Module>>()))>>
    : std::true_type {};
template <class T, class Module>
struct LeadsToPlace<Inner<T>, Module> : std::true_type {};

template <class Target, class Module, bool = LeadsToPlace<Target, Module>::value>
struct ValueAt {
  static_assert(kNever<Target>,
                "this needs a port or a signal: an sc_in, sc_out, sc_inout, sc_signal or sc_export "
                "of one, or inner<T>(\"name\"). An sc_fifo_in takes a message_input(), an "
                "sc_fifo_out a message_output(), a TLM socket a row of TlmUnit, a port of another "
                "interface bind(&Module::port, adapter)");
  using Type = double;
};
template <class Target, class Module>
struct ValueAt<Target, Module, true> {
  using Type = decltype(value_type(place_of(std::declval<Reached<Target, Module>>())));
};
template <class T, class Module>
struct ValueAt<Inner<T>, Module, true> {
  using Type = T;
};

template <class T>
std::true_type is_out(const sc_core::sc_out<T>*);
template <int Width>
std::true_type is_out(const sc_core::sc_out_rv<Width>*);
std::true_type is_out(const sc_core::sc_out_resolved*);
std::false_type is_out(const void*);

/// Whether a target leads to a port that only the module drives, as far as its type tells.
template <class Target, class Module, class = void>
struct LeadsToOut : std::false_type {};
template <class Target, class Module>
struct LeadsToOut<Target, Module, std::void_t<Reached<Target, Module>>>
    : decltype(is_out(std::declval<std::remove_reference_t<Reached<Target, Module>>*>())) {};

/// The object of this name below the module. Throws std::invalid_argument, with the names that
/// there are, if there is none.
sc_core::sc_object& find_below(const sc_core::sc_object& module, const std::string& name);
/// Throws std::invalid_argument: the object has not the type that was asked for.
[[noreturn]] void fail_type(const sc_core::sc_object& object, const char* type);

template <class Target, class Module>
auto find_place(const Target& target, Module& module) {
  return place_of(std::invoke(target, module));
}
template <class T, class Module>
Place<T> find_place(const Inner<T>& inner, Module& module) {
  using InPort = sc_core::sc_port_b<sc_core::sc_signal_in_if<T>>;
  using OutPort = sc_core::sc_port_b<sc_core::sc_signal_inout_if<T>>;
  sc_core::sc_object& object = find_below(module, inner.name);
  if (auto* port = dynamic_cast<InPort*>(&object)) return place_of(*port);
  if (auto* port = dynamic_cast<OutPort*>(&object)) return place_of(*port);
  if (auto* signal = dynamic_cast<sc_core::sc_signal_in_if<T>*>(&object)) return place_of(*signal);
  fail_type(object, typeid(T).name());
}

}  // namespace detail
}  // namespace stride::systemc

#endif
