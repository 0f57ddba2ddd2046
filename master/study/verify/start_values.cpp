#include "master/study/verify/start_values.h"

#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "master/study/verify/finding.h"
#include "master/study/verify/stimulus.h"

namespace stride::verify {

using core::Causality;
using core::Initial;
using core::ValueBlock;
using core::ValueType;
using core::Variable;

namespace {

std::string text_of(const ValueBlock& block) {
  const std::string text = core::elements_text(block);
  return text.empty() ? "empty" : text;
}

/// A unit may compute what it was given, and round it.
bool is_same(const ValueBlock& value, const ValueBlock& expected) {
  if (value == expected) return true;
  bool is_same = value.type() == expected.type() && value.size() == expected.size();
  core::visit(expected, [&]<class T>(std::span<const T> numbers) {
    if constexpr (std::is_floating_point_v<T>) {
      constexpr T kRounding = 64 * std::numeric_limits<T>::epsilon();
      for (std::size_t i = 0; is_same && i < numbers.size(); ++i) {
        const T seen = value.numbers<T>()[i];
        is_same = seen == numbers[i] || std::abs(seen - numbers[i]) <= kRounding * std::abs(seen);
      }
    } else {
      is_same = false;
    }
  });
  return is_same;
}

}  // namespace

bool has_exact_start(const Variable& variable) {
  return variable.is_unclocked_value() && variable.initial == Initial::Exact &&
         has_start_value(variable) && variable.causality != Causality::StructuralParameter;
}

void expect_value(TestInstance& instance, const Variable& variable, const ValueBlock& expected,
                  const std::string& when, const std::string& reason) {
  const ValueBlock value = instance.get(variable);
  if (is_same(value, expected)) return;
  throw Failure(fmt::format("'{}' is {} {}, though {} {}", variable.name, text_of(value), when,
                            reason, text_of(expected)));
}

void expect_start_values(const core::UnitDescription& unit, TestInstance& instance,
                         const std::string& when) {
  for (const Variable& variable : unit.variables) {
    if (!has_exact_start(variable)) continue;
    expect_value(instance, variable, start_value(variable), when, "its start value is");
  }
}

}  // namespace stride::verify
