#include "master/checks/condition.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

namespace stride::checks {
namespace {

using core::ValueBlock;
using core::ValueType;

bool has_order(ValueType type) {
  return type != ValueType::Boolean && type != ValueType::Enumeration &&
         type != ValueType::String && type != ValueType::Binary;
}

/// Calls compare(value, bound) with the element and the only one of `bound`, of the same type.
template <class Compare>
bool compare(const ValueBlock& block, std::size_t element, const ValueBlock& bound,
             Compare&& compare) {
  return core::visit(block, [&](auto values) {
    using T = std::remove_const_t<typename decltype(values)::element_type>;
    const T* limit = nullptr;
    if constexpr (std::is_same_v<T, std::string>) {
      limit = bound.strings().data();
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      limit = bound.binaries().data();
    } else {
      limit = bound.numbers<T>().data();
    }
    return static_cast<bool>(compare(values[element], *limit));
  });
}

}  // namespace

Condition::Condition(const core::Variable& variable, const ConditionText& text)
    : variable_(variable) {
  variable_.dimensions.clear();
  variable_.size = 1;
  read_bounds(text);
  read_expected(text);
  if (!text_.empty()) return;
  throw std::invalid_argument(has_order(variable_.type)
                                  ? "it compares with nothing; expected min, max, above, below or "
                                    "equals"
                                  : "it compares with nothing; expected equals");
}

void Condition::read_bounds(const ConditionText& text) {
  min_ = parse("min", text.min);
  max_ = parse("max", text.max);
  above_ = parse("above", text.above);
  below_ = parse("below", text.below);
  if ((min_ || max_ || above_ || below_) && !has_order(variable_.type)) {
    throw std::invalid_argument(
        fmt::format("a {} has no order; expected equals", core::name(variable_.type)));
  }
  check_order("min", min_, "max", max_, true);
  check_order("min", min_, "below", below_, false);
  check_order("above", above_, "max", max_, false);
  check_order("above", above_, "below", below_, false);
  describe(">=", min_);
  describe(">", above_);
  describe("<=", max_);
  describe("<", below_);
}

void Condition::read_expected(const ConditionText& text) {
  if (!text.equals) {
    if (text.tolerance) throw std::invalid_argument("a tolerance is for equals, which is missing");
    return;
  }
  if (!text_.empty()) throw std::invalid_argument("equals and bounds exclude each other");
  equals_ = parse("equals", text.equals);
  describe("=", equals_);
  if (!text.tolerance) return;
  if (!core::is_real(variable_.type)) {
    throw std::invalid_argument(fmt::format("a tolerance is for real numbers; the signal is a {}",
                                            core::name(variable_.type)));
  }
  const Bound tolerance = parse("tolerance", text.tolerance);
  tolerance_ = core::real(*tolerance, 0);
  if (*tolerance_ < 0) {
    throw std::invalid_argument(
        fmt::format("tolerance: '{}' is not a number of at least 0", *text.tolerance));
  }
  text_ += " ± " + value_text(*tolerance, 0);
}

Condition::Bound Condition::parse(const char* attribute,
                                  const std::optional<std::string>& text) const {
  if (!text) return std::nullopt;
  try {
    ValueBlock value = core::parse(variable_, *text);
    if (!core::is_real(variable_.type) || std::isfinite(core::real(value, 0))) return value;
  } catch (const std::invalid_argument& mistake) {
    throw std::invalid_argument(fmt::format("{}: {}", attribute, mistake.what()));
  }
  throw std::invalid_argument(fmt::format("{}: '{}' is not a finite number", attribute, *text));
}

void Condition::check_order(const char* low_name, const Bound& low, const char* high_name,
                            const Bound& high, bool may_be_equal) const {
  if (!low || !high) return;
  const bool fits = compare(*low, 0, *high, [&](const auto& a, const auto& b) {
    return a < b || (may_be_equal && a == b);
  });
  if (fits) return;
  throw std::invalid_argument(fmt::format("no value fits {} {} and {} {}", low_name,
                                          core::element_text(*low, 0), high_name,
                                          core::element_text(*high, 0)));
}

void Condition::describe(const char* sign, const Bound& bound) {
  if (!bound) return;
  text_ += fmt::format("{}{} {}", text_.empty() ? "" : " and ", sign, value_text(*bound, 0));
}

Truth Condition::holds(const ValueBlock& block, std::size_t element) const {
  if (core::is_real(block.type()) && std::isnan(core::real(block, element))) {
    return Truth::NotANumber;
  }
  const auto keeps = [&](const Bound& bound, auto&& keep) {
    return !bound || compare(block, element, *bound, keep);
  };
  if (tolerance_) {
    const double distance = std::abs(core::real(block, element) - core::real(*equals_, 0));
    return distance <= *tolerance_ ? Truth::True : Truth::False;
  }
  const bool holds = keeps(min_, [](const auto& a, const auto& b) { return a >= b; }) &&
                     keeps(max_, [](const auto& a, const auto& b) { return a <= b; }) &&
                     keeps(above_, [](const auto& a, const auto& b) { return a > b; }) &&
                     keeps(below_, [](const auto& a, const auto& b) { return a < b; }) &&
                     keeps(equals_, [](const auto& a, const auto& b) { return a == b; });
  return holds ? Truth::True : Truth::False;
}

std::string Condition::value_text(const ValueBlock& block, std::size_t element) const {
  if (block.type() == ValueType::String) {
    return fmt::format("'{}'", block.strings()[element]);
  }
  if (block.type() == ValueType::Enumeration) {
    const std::int64_t number = block.numbers<std::int64_t>()[element];
    const auto item =
        std::ranges::find(variable_.items, number, [](const auto& i) { return i.second; });
    if (item != variable_.items.end()) return item->first;
  }
  const std::string text = core::element_text(block, element);
  if (text.empty()) return "no bytes";
  return variable_.unit.empty() ? text : text + " " + variable_.unit;
}

}  // namespace stride::checks
