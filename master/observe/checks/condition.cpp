#include "master/observe/checks/condition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "master/engine/model/number_range.h"
#include "master/observe/checks/difference.h"

namespace stride::checks {
namespace {

using core::ValueBlock;
using core::ValueType;

/// The only element.
template <class T>
const T& only(const ValueBlock& block) {
  if constexpr (std::is_same_v<T, std::string>) {
    return block.strings()[0];
  } else if constexpr (std::is_same_v<T, core::Binary>) {
    return block.binaries()[0];
  } else {
    return block.numbers<T>()[0];
  }
}

}  // namespace

Condition::Condition(const core::Variable& variable, const ConditionText& text)
    : variable_(variable), has_order_(core::is_number(variable.type)) {
  variable_.dimensions.clear();
  variable_.size = 1;
  read_bounds(text);
  read_expected(text);
  if (!text_.empty()) return;
  throw std::invalid_argument(has_order_
                                  ? "it compares with nothing; expected min, max, above, below or "
                                    "equals"
                                  : "it compares with nothing; expected equals");
}

void Condition::read_bounds(const ConditionText& text) {
  min_ = parse("min", text.min);
  max_ = parse("max", text.max);
  above_ = parse("above", text.above);
  below_ = parse("below", text.below);
  if ((min_ || max_ || above_ || below_) && !has_order_) {
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
  tolerance_ = parse("tolerance", text.tolerance);
  if (core::real(*tolerance_, 0) < 0) {
    throw std::invalid_argument(
        fmt::format("tolerance: '{}' is not a number of at least 0", *text.tolerance));
  }
  text_ += " ± " + value_text(*tolerance_, 0);
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
  const bool fits = core::visit(*low, [&](auto values) {
    using T = std::remove_const_t<typename decltype(values)::element_type>;
    const T& other = only<T>(*high);
    return values[0] < other || (may_be_equal && values[0] == other);
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

template <class T>
Judgement Condition::judge_number(T value) const {
  Judgement judged{Truth::True, std::numeric_limits<double>::infinity()};
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(value)) return {Truth::NotANumber, -judged.robustness};
  }
  const auto add = [&](bool holds, double distance) {
    if (!holds) judged.truth = Truth::False;
    judged.robustness = std::min(judged.robustness, distance);
  };
  const auto limit = [](const Bound& bound) { return only<T>(*bound); };
  if (min_) add(value >= limit(min_), difference(value, limit(min_)));
  if (max_) add(value <= limit(max_), difference(limit(max_), value));
  if (above_) add(value > limit(above_), difference(value, limit(above_)));
  if (below_) add(value < limit(below_), difference(limit(below_), value));
  if (!equals_) return judged;
  const double distance = std::abs(difference(value, limit(equals_)));
  const double tolerance = tolerance_ ? static_cast<double>(limit(tolerance_)) : 0;
  add(tolerance_ ? distance <= tolerance : value == limit(equals_), tolerance - distance);
  return judged;
}

Judgement Condition::judge(const ValueBlock& block, std::size_t element) const {
  return core::visit(block, [&](auto values) {
    using T = std::remove_const_t<typename decltype(values)::element_type>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (has_order_) return judge_number<T>(values[element]);
    }
    const bool holds = values[element] == only<T>(*equals_);
    return holds ? Judgement{Truth::True, 1} : Judgement{Truth::False, -1};
  });
}

std::vector<core::SignalLimits::Limit> Condition::limits() const {
  std::vector<core::SignalLimits::Limit> limits;
  const auto add = [&](const char* name, const Bound& bound) {
    if (bound) limits.push_back({name, *bound});
  };
  add("min", min_), add("max", max_), add("above", above_), add("below", below_);
  add("equals", equals_), add("tolerance", tolerance_);
  return limits;
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
