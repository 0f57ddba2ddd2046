// How the values of a module's ports and signals are shown in FMI.
#ifndef STRIDE_SYSTEMC_CONVERSION_H
#define STRIDE_SYSTEMC_CONVERSION_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

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

/// SystemC's integers and bit vectors of up to 64 bits: the least integer of FMI that holds Width
/// bits. What does not fit into them is an error, never cut off.
template <class T, int Width, bool Signed>
struct IntegerConversion {
  using Fmi = LeastInteger<Width, Signed>;
  static constexpr int kUnused = 64 - Width;
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

/// "0x" and the digits of so many bits, all of them, the most significant first. `digits` has none
/// but 0 and 1.
std::string hexadecimal(const std::string& digits);
/// The `width` binary digits of such a text, which may be without "0x" and leading zeros; an empty
/// one is 0. Throws std::out_of_range for what is no such number, or too large.
std::string binary(const std::string& hexadecimal, int width, const std::string& type);

/// More than 64 bits: a String, in hexadecimal, of a signed number in two's complement.
template <class T, int Width>
struct WideConversion {
  using Fmi = std::string;
  using Bits = sc_dt::sc_bv<Width>;
  static Fmi to_fmi(const T& value) { return hexadecimal(Bits(value).to_string()); }
  static T from_fmi(const Fmi& value) {
    T result;
    result = Bits(binary(value, Width, std::to_string(Width) + " bits").c_str());
    return result;
  }
  static void describe(VariableBuilder&) {}
};

template <class T, int Width, bool Signed>
using BitsConversion =
    std::conditional_t<(Width <= 64), IntegerConversion<T, std::min(Width, 64), Signed>,
                       WideConversion<T, Width>>;

/// Numbers whose width is known when the model runs only: of 64 bits, or it is an error.
template <class T, class Integer>
struct AnyWidthConversion {
  using Fmi = Integer;
  static Fmi to_fmi(const T& value) {
    const auto number =
        static_cast<Integer>(std::is_signed_v<Integer> ? value.to_int64() : value.to_uint64());
    if (!(value == T(from_fmi(number)))) {
      fail_range(value.to_string(), "64 bits", "what an integer of FMI can");
    }
    return number;
  }
  static T from_fmi(Fmi number) {
    T value(64);
    value = static_cast<std::conditional_t<std::is_signed_v<Integer>, sc_dt::int64, sc_dt::uint64>>(
        number);
    return value;
  }
  static void describe(VariableBuilder&) {}
};

}  // namespace detail

/// The FMI type of a SystemC type, and the way there and back. To be specialised for types of your
/// own that travel through ports. from_fmi() throws for a value that T cannot hold.
template <class T, class = void>
struct Conversion {
  static_assert(detail::kNever<T>,
                "no variable of FMI can hold this type: output parts of it by functions, or "
                "specialise stride::systemc::Conversion for it (docs/wrap-systemc.md has an "
                "example)");
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

/// To be specialised for an enum of yours, so that its variables are Enumerations with these names:
///
///   template <>
///   struct stride::systemc::Items<State> {
///     static constexpr std::pair<const char*, State> kItems[] = {{"idle", kIdle}, {"busy",
///     kBusy}};
///   };
template <class T, class = void>
struct Items {};

namespace detail {
template <class T, class = void>
inline constexpr bool kHasItems = false;
template <class T>
inline constexpr bool kHasItems<T, std::void_t<decltype(Items<T>::kItems)>> = true;

/// The value of an Enumeration of FMI, whatever the enum's integer is.
enum class Item : std::int64_t {};
}  // namespace detail

/// An enum, such as a machine's state: its integer; an Enumeration if it has Items, or if its
/// underlying type is std::int64_t, where its row needs items().
template <class T>
struct Conversion<T, std::enable_if_t<std::is_enum_v<T>>> {
  using Integer = std::underlying_type_t<T>;
  using Plain = std::conditional_t<std::is_same_v<Integer, std::int64_t>, T, Integer>;
  using Fmi = std::conditional_t<detail::kHasItems<T>, detail::Item, Plain>;
  static Fmi to_fmi(T value) { return static_cast<Fmi>(value); }
  static T from_fmi(Fmi value) { return static_cast<T>(value); }
  static void describe(VariableBuilder& row) {
    if constexpr (detail::kHasItems<T>) {
      std::vector<std::pair<std::string, std::int64_t>> items;
      for (const auto& [name, value] : Items<T>::kItems) {
        items.emplace_back(name, static_cast<std::int64_t>(value));
      }
      row.items(std::move(items));
    }
  }
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
struct Conversion<sc_dt::sc_biguint<W>> : detail::BitsConversion<sc_dt::sc_biguint<W>, W, false> {};
template <int W>
struct Conversion<sc_dt::sc_bigint<W>> : detail::BitsConversion<sc_dt::sc_bigint<W>, W, true> {};
/// The number that the bits are, the leftmost the most significant.
template <int W>
struct Conversion<sc_dt::sc_bv<W>> : detail::BitsConversion<sc_dt::sc_bv<W>, W, false> {};
template <>
struct Conversion<sc_dt::sc_unsigned>
    : detail::AnyWidthConversion<sc_dt::sc_unsigned, std::uint64_t> {};
template <>
struct Conversion<sc_dt::sc_signed> : detail::AnyWidthConversion<sc_dt::sc_signed, std::int64_t> {};

template <>
struct Conversion<sc_dt::sc_bit> {
  using Fmi = bool;
  static Fmi to_fmi(const sc_dt::sc_bit& value) { return value.to_bool(); }
  static sc_dt::sc_bit from_fmi(Fmi value) { return sc_dt::sc_bit(value); }
  static void describe(VariableBuilder&) {}
};

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
