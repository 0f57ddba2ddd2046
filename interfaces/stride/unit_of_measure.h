// Units of measure: what a name such as "km/h" or "W/(m2.K)" stands for, in SI base units.
#ifndef STRIDE_UNIT_OF_MEASURE_H
#define STRIDE_UNIT_OF_MEASURE_H

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <stride/unit_of_measure_table.h>

namespace stride {

/// A name as FMI, Modelica, SSP and most tools write it, in Modelica's characters: [m] without its
/// brackets, "µ" as "u", "Ω" as "Ohm", "°C" as "degC", "²" as "^2", "·", "*" and a blank as ".".
std::string plain_unit_of_measure(std::string_view name);

/// What a unit of measure of this name is, by the table of known symbols, the prefixes of SI, and
/// the grammar of Modelica (3.6, chapter 19): factors with whole exponents, joined by "." and "/";
/// behind a "/" several factors are in parentheses. Nothing for other names. The offset of a
/// temperature counts only where it stands alone: "W/degC" is W/K.
std::optional<BaseUnitOfMeasure> find_unit_of_measure(std::string_view name);

/// Symbols that are defined apart from the table.
using OwnUnitsOfMeasure = std::map<std::string, BaseUnitOfMeasure, std::less<>>;
/// Likewise, where these may be used alone and as factors, and go before the table's; they take no
/// prefixes.
std::optional<BaseUnitOfMeasure> find_unit_of_measure(std::string_view name,
                                                      const OwnUnitsOfMeasure& own);

namespace detail {

inline BaseUnitOfMeasure power(const BaseUnitOfMeasure& base, int exponent) {
  BaseUnitOfMeasure result;
  for (std::size_t i = 0; i < base.exponents.size(); ++i) {
    result.exponents[i] = base.exponents[i] * exponent;
  }
  for (int i = 0; i < exponent; ++i) result.factor *= base.factor;
  for (int i = 0; i > exponent; --i) result.factor /= base.factor;
  if (exponent == 1) result.offset = base.offset;
  return result;
}

inline BaseUnitOfMeasure product(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b) {
  BaseUnitOfMeasure result;
  for (std::size_t i = 0; i < result.exponents.size(); ++i) {
    result.exponents[i] = a.exponents[i] + b.exponents[i];
  }
  result.factor = a.factor * b.factor;
  return result;
}

inline std::optional<BaseUnitOfMeasure> find_symbol(std::string_view symbol) {
  for (const UnitOfMeasureSymbol& known : kUnitOfMeasureSymbols) {
    if (known.symbol == symbol) return known.unit;
  }
  for (const UnitOfMeasurePrefix& prefix : kUnitOfMeasurePrefixes) {
    if (symbol.substr(0, prefix.symbol.size()) != prefix.symbol) continue;
    const std::string_view rest = symbol.substr(prefix.symbol.size());
    for (const UnitOfMeasureSymbol& known : kUnitOfMeasureSymbols) {
      if (known.symbol != rest || !known.takes_prefix) continue;
      BaseUnitOfMeasure unit = known.unit;
      unit.factor = prefix.is_fraction ? unit.factor / prefix.power : unit.factor * prefix.power;
      return unit;
    }
  }
  return std::nullopt;
}

/// Reads an expression of units of measure.
class UnitOfMeasureReader {
 public:
  UnitOfMeasureReader(std::string_view text, const OwnUnitsOfMeasure& own)
      : text_(text), own_(own) {}

  std::optional<BaseUnitOfMeasure> read() {
    const BaseUnitOfMeasure unit = expression();
    if (!is_valid_ || !text_.empty()) return std::nullopt;
    return unit;
  }

 private:
  static constexpr int kMostDepth = 16;
  static constexpr int kMostExponent = 30;

  bool take(char character) {
    if (text_.empty() || text_.front() != character) return false;
    text_.remove_prefix(1);
    return true;
  }
  BaseUnitOfMeasure fail() {
    is_valid_ = false;
    return {};
  }

  BaseUnitOfMeasure expression() {
    BaseUnitOfMeasure unit = factor();
    bool is_divided = false;
    while (is_valid_) {
      if (take('/')) {
        is_divided = true;
        unit = product(unit, power(factor(), -1));
      } else if (!is_divided && take('.')) {
        unit = product(unit, factor());
      } else {
        break;
      }
    }
    return unit;
  }

  BaseUnitOfMeasure factor() {
    if (take('(')) {
      if (++depth_ > kMostDepth) return fail();
      const BaseUnitOfMeasure inside = expression();
      --depth_;
      return take(')') ? raised(inside) : fail();
    }
    std::size_t digits = count(&is_digit);
    const long double number = value(take_front(digits));
    const std::string_view symbol = take_front(count(&is_letter));
    if (symbol.empty()) return digits == 0 || number != 1 ? fail() : BaseUnitOfMeasure{};
    const auto own = own_.find(symbol);
    const std::optional<BaseUnitOfMeasure> known =
        own != own_.end() ? std::optional(own->second) : find_symbol(symbol);
    if (!known || number == 0) return fail();
    BaseUnitOfMeasure unit = raised(*known);
    if (digits == 0) return unit;
    unit.factor *= number;
    unit.offset = 0;
    return unit;
  }

  BaseUnitOfMeasure raised(const BaseUnitOfMeasure& base) {
    const bool is_raised = take('^');
    const bool is_negative = take('-');
    const bool has_sign = is_negative || take('+');
    if (has_sign) take('^');
    const std::size_t digits = count(&is_digit);
    if (digits == 0) return is_raised || has_sign ? fail() : base;
    const long double exponent = value(take_front(digits));
    if (exponent > kMostExponent) return fail();
    return power(base, static_cast<int>(is_negative ? -exponent : exponent));
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%';
  }
  std::size_t count(bool (*fits)(char)) const {
    std::size_t size = 0;
    while (size < text_.size() && fits(text_[size])) ++size;
    return size;
  }
  std::string_view take_front(std::size_t size) {
    const std::string_view front = text_.substr(0, size);
    text_.remove_prefix(size);
    return front;
  }
  /// 1 for no digits.
  static long double value(std::string_view digits) {
    if (digits.empty()) return 1;
    long double number = 0;
    for (const char digit : digits) number = number * 10 + (digit - '0');
    return number;
  }

  std::string_view text_;
  const OwnUnitsOfMeasure& own_;
  bool is_valid_ = true;
  int depth_ = 0;
};

inline std::string respelt(std::string_view name) {
  std::string plain;
  while (!name.empty()) {
    std::string_view from = name.substr(0, 1), to = from;
    for (const UnitOfMeasureSpelling& spelling : kUnitOfMeasureSpellings) {
      if (name.substr(0, spelling.written.size()) != spelling.written) continue;
      from = spelling.written;
      to = spelling.plain;
      break;
    }
    plain += to;
    name.remove_prefix(from.size());
  }
  return plain;
}

/// A blank between two factors joins them; others have no meaning.
inline std::string without_blanks(std::string_view name) {
  const auto joins = [](char c) {
    return std::string_view("./(").find(c) != std::string_view::npos;
  };
  std::string plain;
  bool is_apart = false;
  for (const char c : name) {
    if (c == ' ') {
      is_apart = !plain.empty();
      continue;
    }
    const bool is_factor =
        is_apart && !joins(plain.back()) && (c == '(' || (!joins(c) && c != ')'));
    if (is_factor) plain += '.';
    is_apart = false;
    plain += c;
  }
  return plain;
}

}  // namespace detail

inline std::string plain_unit_of_measure(std::string_view name) {
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    name = name.substr(1, name.size() - 2);
  }
  return detail::without_blanks(detail::respelt(name));
}

inline std::optional<BaseUnitOfMeasure> find_unit_of_measure(std::string_view name,
                                                             const OwnUnitsOfMeasure& own) {
  if (const auto found = own.find(name); found != own.end()) return found->second;
  const std::string plain = plain_unit_of_measure(name);
  if (plain == "-") return BaseUnitOfMeasure{};
  return detail::UnitOfMeasureReader(plain, own).read();
}

inline std::optional<BaseUnitOfMeasure> find_unit_of_measure(std::string_view name) {
  return find_unit_of_measure(name, {});
}

}  // namespace stride

#endif
