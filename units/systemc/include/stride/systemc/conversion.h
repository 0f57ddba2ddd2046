// How the values of a module's ports and signals are shown in FMI.
#ifndef STRIDE_SYSTEMC_CONVERSION_H
#define STRIDE_SYSTEMC_CONVERSION_H

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>

#include <stride/unit.h>

namespace stride::systemc {

/// sc_logic as an enumeration of FMI, with the values of sc_dt::sc_logic_value_t.
enum class Logic : std::int64_t { k0 = 0, k1 = 1, Z = 2, X = 3 };

namespace detail {

template <class>
inline constexpr bool kNever = false;

/// Throws std::out_of_range, which names the value, the type and its range.
[[noreturn]] void fail_range(const std::string& value, const std::string& type,
                             const std::string& range);

template <int Width, bool Signed>
using LeastInteger = std::conditional_t<
    (Width <= 8), std::conditional_t<Signed, std::int8_t, std::uint8_t>,
    std::conditional_t<
        (Width <= 16), std::conditional_t<Signed, std::int16_t, std::uint16_t>,
        std::conditional_t<(Width <= 32), std::conditional_t<Signed, std::int32_t, std::uint32_t>,
                           std::conditional_t<Signed, std::int64_t, std::uint64_t>>>>;

/// SystemC's integers and bit vectors: the least integer of FMI that holds Width bits. What does
/// not fit into them is an error, never cut off.
template <class T, int Width, bool Signed>
struct IntegerConversion {
  static_assert(Width <= 64,
                "an integer of FMI has 64 bits at most: output parts of this value by functions, "
                "or specialise stride::systemc::Conversion for the type");
  using Fmi = LeastInteger<Width, Signed>;
  static constexpr int kUnused = Width <= 64 ? 64 - Width : 0;
  static constexpr Fmi kMax = static_cast<Fmi>(
      Signed ? std::numeric_limits<std::int64_t>::max() >> kUnused
             : static_cast<std::int64_t>(std::numeric_limits<std::uint64_t>::max() >> kUnused));
  static constexpr Fmi kMin = static_cast<Fmi>(Signed ? -kMax - 1 : 0);

  static Fmi to_fmi(const T& value) {
    if constexpr (Signed) return static_cast<Fmi>(value.to_int64());
    return static_cast<Fmi>(value.to_uint64());
  }
  static T from_fmi(Fmi value) {
    if (value < kMin || value > kMax) {
      fail_range(std::to_string(value), std::to_string(Width) + " bits",
                 std::to_string(kMin) + " to " + std::to_string(kMax));
    }
    T result;
    result = static_cast<std::conditional_t<Signed, sc_dt::int64, sc_dt::uint64>>(value);
    return result;
  }
  // bounds beyond 2^53 are no doubles; those of the FMI type itself need no check
  static void describe(VariableBuilder& row) {
    constexpr bool kFillsType = Width == 8 * static_cast<int>(sizeof(Fmi));
    if (!kFillsType && Width <= 53) {
      row.range(static_cast<double>(kMin), static_cast<double>(kMax));
    }
  }
};

}  // namespace detail

/// The FMI type of a SystemC type, and the way there and back. To be specialised for types of your
/// own that travel through ports. from_fmi() throws for a value that T cannot hold.
template <class T, class = void>
struct Conversion {
  static_assert(detail::kNever<T>,
                "no variable of FMI can hold this type: output parts of it by functions, or "
                "specialise stride::systemc::Conversion for it");
  using Fmi = double;
  static Fmi to_fmi(const T&) { return 0; }
  static T from_fmi(Fmi) { return T(); }
  static void describe(VariableBuilder&) {}
};

/// bool, float, double and the integers of C++: as they are.
template <class T>
struct Conversion<T, std::enable_if_t<std::is_arithmetic_v<T>>> {
  using Fmi = T;
  static Fmi to_fmi(T value) { return value; }
  static T from_fmi(Fmi value) { return value; }
  static void describe(VariableBuilder&) {}
};

/// An enum, such as a machine's state: its integer, or, with the underlying type std::int64_t, an
/// Enumeration, whose row needs items().
template <class T>
struct Conversion<T, std::enable_if_t<std::is_enum_v<T>>> {
  using Integer = std::underlying_type_t<T>;
  using Fmi = std::conditional_t<std::is_same_v<Integer, std::int64_t>, T, Integer>;
  static Fmi to_fmi(T value) { return static_cast<Fmi>(value); }
  static T from_fmi(Fmi value) { return static_cast<T>(value); }
  static void describe(VariableBuilder&) {}
};

template <>
struct Conversion<std::string> {
  using Fmi = std::string;
  static const Fmi& to_fmi(const std::string& value) { return value; }
  static const std::string& from_fmi(const Fmi& value) { return value; }
  static void describe(VariableBuilder&) {}
};

template <int W>
struct Conversion<sc_dt::sc_uint<W>> : detail::IntegerConversion<sc_dt::sc_uint<W>, W, false> {};
template <int W>
struct Conversion<sc_dt::sc_int<W>> : detail::IntegerConversion<sc_dt::sc_int<W>, W, true> {};
template <int W>
struct Conversion<sc_dt::sc_biguint<W>>
    : detail::IntegerConversion<sc_dt::sc_biguint<W>, W, false> {};
template <int W>
struct Conversion<sc_dt::sc_bigint<W>> : detail::IntegerConversion<sc_dt::sc_bigint<W>, W, true> {};
/// The number that the bits are, the leftmost the most significant.
template <int W>
struct Conversion<sc_dt::sc_bv<W>> : detail::IntegerConversion<sc_dt::sc_bv<W>, W, false> {};

template <>
struct Conversion<sc_dt::sc_logic> {
  using Fmi = Logic;
  static Fmi to_fmi(const sc_dt::sc_logic& value) { return static_cast<Logic>(value.value()); }
  static sc_dt::sc_logic from_fmi(Fmi value) {
    return sc_dt::sc_logic(static_cast<sc_dt::sc_logic_value_t>(value));
  }
  static void describe(VariableBuilder& row) {
    row.items({{"0", 0}, {"1", 1}, {"Z", 2}, {"X", 3}});
  }
};

/// A String of the digits 0, 1, Z and X, the most significant first.
template <int W>
struct Conversion<sc_dt::sc_lv<W>> {
  using Fmi = std::string;
  static Fmi to_fmi(const sc_dt::sc_lv<W>& value) { return value.to_string(); }
  static sc_dt::sc_lv<W> from_fmi(const Fmi& value) {
    if (value.empty()) return {};  // all X, as a signal that was never written
    if (value.size() != W || value.find_first_not_of("01ZXzx") != std::string::npos) {
      detail::fail_range('"' + value + '"', "sc_lv<" + std::to_string(W) + ">",
                         std::to_string(W) + " digits of 0, 1, Z and X");
    }
    return sc_dt::sc_lv<W>(value.c_str());
  }
  static void describe(VariableBuilder&) {}
};

/// In seconds.
template <>
struct Conversion<sc_core::sc_time> {
  using Fmi = double;
  static Fmi to_fmi(const sc_core::sc_time& value) { return value.to_seconds(); }
  static sc_core::sc_time from_fmi(Fmi seconds) {
    if (!(seconds >= 0)) detail::fail_range(std::to_string(seconds), "sc_time", "0 s and more");
    return {seconds, sc_core::SC_SEC};
  }
  static void describe(VariableBuilder& row) { row.unit("s"); }
};

#ifdef SC_INCLUDE_FX
namespace detail {
template <class T, int Width>
struct FixedPointConversion {
  static_assert(Width <= 53, "a Float64 has 53 bits: this fixed-point type has more");
  using Fmi = double;
  static Fmi to_fmi(const T& value) { return value.to_double(); }
  static T from_fmi(Fmi value) { return T(value); }  // rounded and saturated as the type defines
  static void describe(VariableBuilder&) {}
};
}  // namespace detail
template <int W, int I, sc_dt::sc_q_mode Q, sc_dt::sc_o_mode O, int N>
struct Conversion<sc_dt::sc_fixed<W, I, Q, O, N>>
    : detail::FixedPointConversion<sc_dt::sc_fixed<W, I, Q, O, N>, W> {};
template <int W, int I, sc_dt::sc_q_mode Q, sc_dt::sc_o_mode O, int N>
struct Conversion<sc_dt::sc_ufixed<W, I, Q, O, N>>
    : detail::FixedPointConversion<sc_dt::sc_ufixed<W, I, Q, O, N>, W> {};
#endif

}  // namespace stride::systemc

#endif
