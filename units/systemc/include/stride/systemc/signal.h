// The signals that a ModuleUnit binds ports to.
#ifndef STRIDE_SYSTEMC_SIGNAL_H
#define STRIDE_SYSTEMC_SIGNAL_H

#include <cstring>
#include <memory>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>

#include <stride/systemc/conversion.h>
#include <stride/systemc/kernel.h>
#include <stride/systemc/port.h>

namespace stride::systemc::detail {

/// By SystemC's name of it: "sc_out", "sc_out_resolved", "sc_out_rv".
inline bool is_of_kind(const sc_core::sc_object& port, const char* kind) {
  return std::strncmp(port.kind(), kind, std::strlen(kind)) == 0;
}
/// The module drives it, and nothing else does.
inline bool is_output_only(const sc_core::sc_object& port) { return is_of_kind(port, "sc_out"); }

/// The signal that SystemC demands for a resolved port; none for types without one.
template <class T>
struct Resolved {
  using Signal = void;
};
template <>
struct Resolved<sc_dt::sc_logic> {
  using Signal = sc_core::sc_signal_resolved;
  using In = sc_core::sc_in_resolved;
  using Inout = sc_core::sc_inout_resolved;
};
template <int W>
struct Resolved<sc_dt::sc_lv<W>> {
  using Signal = sc_core::sc_signal_rv<W>;
  using In = sc_core::sc_in_rv<W>;
  using Inout = sc_core::sc_inout_rv<W>;
};
template <class T>
inline constexpr bool kCanBeResolved = !std::is_void_v<typename Resolved<T>::Signal>;

inline Logic undriven(const sc_dt::sc_logic&) { return Logic::Z; }
template <int W>
std::string undriven(const sc_dt::sc_lv<W>&) {
  return std::string(W, 'Z');
}

template <class T>
bool is_resolved(const sc_core::sc_object& port) {
  if constexpr (kCanBeResolved<T>) {
    return dynamic_cast<const typename Resolved<T>::In*>(&port) != nullptr ||
           dynamic_cast<const typename Resolved<T>::Inout*>(&port) != nullptr;
  }
  return false;
}

/// What a signal holds that nothing has written yet.
template <class T>
T value_at_rest() {
  // a signal keeps the width of its first value: that which a variable can hold
  if constexpr (std::is_same_v<T, sc_dt::sc_signed> || std::is_same_v<T, sc_dt::sc_unsigned>) {
    return T(64);
  } else {
    return T();
  }
}

/// Of an input: 0, or, for a port that SystemC calls resolved, as if nothing drove it.
template <class Target, class Module>
typename Conversion<typename ValueAt<Target, Module>::Type>::Fmi start_of() {
  using T = typename ValueAt<Target, Module>::Type;
  if constexpr (kCanBeResolved<T> && std::is_invocable_v<const Target&, Module&>) {
    using Port = std::decay_t<Reached<Target, Module>>;
    using In = typename Resolved<T>::In;
    using Inout = typename Resolved<T>::Inout;
    if constexpr (std::is_base_of_v<In, Port> || std::is_base_of_v<Inout, Port>)
      return undriven(T());
  }
  return {};
}

/// A signal such as the port demands: resolved, of several writers for an sc_inout, or plain. The
/// kernel keeps it.
template <class T>
sc_core::sc_signal_inout_if<T>& make_signal(Kernel& kernel, const sc_core::sc_object& port,
                                            const T& value) {
  const auto keep = [&kernel](auto signal) -> sc_core::sc_signal_inout_if<T>& {
    auto& kept = *signal;
    kernel.own(std::move(signal));
    return kept;
  };
  const char* const name = sc_core::sc_gen_unique_name("signal");
  if constexpr (kCanBeResolved<T>) {
    using Signal = typename Resolved<T>::Signal;
    if (is_resolved<T>(port)) return keep(std::make_unique<Signal>(name, value));
  }
  using OfOne = sc_core::sc_signal<T>;
  using OfMany = sc_core::sc_signal<T, sc_core::SC_MANY_WRITERS>;
  if (is_of_kind(port, "sc_inout")) return keep(std::make_unique<OfMany>(name, value));
  return keep(std::make_unique<OfOne>(name, value));
}

}  // namespace stride::systemc::detail

#endif
