#include "master/study/verify/stimulus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace stride::verify {
namespace {

using core::Causality;
using core::ValueBlock;
using core::ValueType;
using core::Variability;
using core::Variable;

constexpr std::size_t kPointsPerTick = 7;

bool is_number(ValueType type) {
  return type != ValueType::String && type != ValueType::Binary && type != ValueType::Clock;
}

/// The bounds of a variable's type, or those that it declares.
template <class T>
std::pair<T, T> bounds(const Variable& variable) {
  std::pair<T, T> range{std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()};
  Variable scalar = variable;
  scalar.size = 1;
  scalar.dimensions.clear();
  const auto read = [&](const std::string& text, T& bound) {
    if (!text.empty()) bound = core::parse_start(scalar, text).template numbers<T>()[0];
  };
  read(variable.min, range.first);
  read(variable.max, range.second);
  return range;
}

/// How far a number may go for the unit to notice it, and not to be surprised.
double reach(const Variable& variable, double start) {
  if (variable.nominal > 0) return variable.nominal;
  return start != 0 ? std::abs(start) / 4 : 1;
}

template <class T>
T other_number(const Variable& variable, T start) {
  const auto [low, high] = bounds<T>(variable);
  if constexpr (std::is_floating_point_v<T>) {
    const double way = reach(variable, start);
    const double up = std::min<double>(way, (static_cast<double>(high) - start) / 2);
    if (up > 0) return static_cast<T>(start + up);
    const double down = std::min<double>(way, (start - static_cast<double>(low)) / 2);
    return static_cast<T>(down > 0 ? start - down : start);
  } else {
    if (start < high) return static_cast<T>(start + 1);
    return start > low ? static_cast<T>(start - 1) : start;
  }
}

std::int64_t other_item(const Variable& variable, std::int64_t start) {
  for (const auto& [item, value] : variable.items) {
    if (value != start) return value;
  }
  return start;
}

}  // namespace

// SplitMix64 (Steele, Lea and Flood, 2014)
double uniform(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15U + (index + 1) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

std::pair<double, double> range_of(const Variable& variable) { return bounds<double>(variable); }

bool has_start_value(const Variable& variable) {
  const bool is_opaque = variable.type == ValueType::String || variable.type == ValueType::Binary;
  return variable.dimensions.empty() || !is_opaque;
}

ValueBlock start_value(const Variable& variable) {
  if (!variable.start.empty()) return core::parse_start(variable, variable.start);
  ValueBlock block(variable.type, variable.size);
  if (variable.type == ValueType::Enumeration && !variable.items.empty()) {
    std::ranges::fill(block.numbers<std::int64_t>(), variable.items.front().second);
  }
  return block;
}

ValueBlock other_value(const Variable& variable, const ValueBlock& start) {
  ValueBlock other = start;
  core::visit(other, [&]<class T>(std::span<T> elements) {
    for (T& element : elements) {
      if constexpr (std::is_same_v<T, bool>) {
        element = !element;
      } else if constexpr (std::is_arithmetic_v<T>) {
        if (variable.type == ValueType::Enumeration) {
          element = static_cast<T>(other_item(variable, static_cast<std::int64_t>(element)));
        } else {
          element = other_number(variable, element);
        }
      }
    }
  });
  return other;
}

Stimulus::Stimulus(const TestedUnit& tested, std::uint64_t seed) {
  const auto& variables = tested.description().variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Variable& variable = variables[i];
    const bool is_stimulated =
        variable.causality == Causality::Input && is_number(variable.type) && !tested.is_set(i);
    if (!is_stimulated) continue;
    const ValueBlock start = start_value(variable);
    const double luck = uniform(seed, variable.reference);
    inputs_.push_back(
        {.variable = i,
         .reference = variable.reference,
         .is_continuous = variable.variability == Variability::Continuous && !variable.is_clocked(),
         .is_clocked = variable.is_clocked(),
         .start = start,
         .other = other_value(variable, start),
         .cycle = 17 + 40 * luck,
         .hold = 5 + static_cast<std::size_t>(12 * luck)});
  }
}

bool Stimulus::changes_at(std::size_t k) const {
  return std::any_of(inputs_.begin(), inputs_.end(), [&](const Input& input) {
    return !input.is_continuous && !input.is_clocked && k > 0 && k % input.hold == 0 &&
           input.start != input.other;
  });
}

bool Stimulus::ticks_at(std::size_t k) const { return k % kPointsPerTick == 3; }

ValueBlock Stimulus::value(const Input& input, std::size_t k) const {
  if (!input.is_continuous) return (k / input.hold) % 2 == 0 ? input.start : input.other;
  const double phase = 2 * std::numbers::pi * static_cast<double>(k) / input.cycle;
  const double share = (1 - std::cos(phase)) / 2;
  ValueBlock block = input.start;
  for (std::size_t e = 0; e < block.size(); ++e) {
    const double from = core::real(input.start, e);
    core::set_real(block, e, from + share * (core::real(input.other, e) - from));
  }
  return block;
}

}  // namespace stride::verify
