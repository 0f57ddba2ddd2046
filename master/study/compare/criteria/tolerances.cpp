#include "master/study/compare/criteria/tolerances.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/text/number_text.h"
#include "master/base/text/suggest.h"
#include "master/report/table.h"
#include "master/study/compare/criteria/selection.h"

namespace stride::compare {
namespace {

bool is_about(const std::string& pattern, const std::string& signal, const std::string& unit) {
  return is_meant(pattern, signal) || pattern == core::with_unit(signal, unit);
}

double number_of(const report::Table& table, std::size_t place) {
  try {
    return core::parse_at_least_zero(table.field(place).text);
  } catch (const std::invalid_argument& mistake) {
    table.fail(place, mistake.what());
  }
}

}  // namespace

bool Tolerance::allows(double a, double b) const {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  if (is_exact()) return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  if (!std::isfinite(a) || !std::isfinite(b)) return a == b;
  return std::abs(a - b) <= absolute + relative * std::abs(b);
}

SignalTolerance parse_tolerance(const std::string& text) {
  const core::Location where{"--tolerance " + text, 0};
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    core::fail_input({.where = where}, "expected SIGNAL=ABSOLUTE or SIGNAL=ABSOLUTE,RELATIVE",
                     "as in --tolerance 'tank.*=1e-6,1e-3'");
  }
  const std::string numbers = text.substr(equals + 1);
  const std::size_t comma = std::min(numbers.find(','), numbers.size());
  try {
    Tolerance tolerance{core::parse_at_least_zero(numbers.substr(0, comma)), 0};
    if (comma < numbers.size()) {
      tolerance.relative = core::parse_at_least_zero(numbers.substr(comma + 1));
    }
    return {text.substr(0, equals), tolerance, where};
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({.where = where}, mistake.what(), "as in --tolerance 'tank.*=1e-6,1e-3'");
  }
}

std::vector<SignalTolerance> read_tolerances(const std::filesystem::path& file) {
  report::Table table(file);
  std::vector<SignalTolerance> rules;
  if (table.columns().empty()) return rules;
  const std::size_t signal = table.place("signal");
  const std::size_t absolute = table.place("absolute");
  const std::size_t relative = table.place("relative");
  while (table.next()) {
    rules.push_back({table.field(signal).value(),
                     {number_of(table, absolute), number_of(table, relative)},
                     {file.string(), static_cast<int>(table.line())}});
  }
  return rules;
}

Tolerance Tolerances::of(const std::string& signal, const std::string& unit) const {
  const auto found = std::find_if(rules_.rbegin(), rules_.rend(), [&](const SignalTolerance& rule) {
    return is_about(rule.pattern, signal, unit);
  });
  return found == rules_.rend() ? all_ : found->tolerance;
}

bool Tolerances::are_exact() const {
  return all_.is_exact() && std::ranges::all_of(rules_, [](const SignalTolerance& rule) {
           return rule.tolerance.is_exact();
         });
}

void Tolerances::require_use(std::span<const std::string> signals,
                             std::span<const std::string> units) const {
  for (const SignalTolerance& rule : rules_) {
    bool is_used = false;
    for (std::size_t i = 0; i < signals.size() && !is_used; ++i) {
      is_used = is_about(rule.pattern, signals[i], units[i]);
    }
    if (is_used) continue;
    const std::set<std::string> known(signals.begin(), signals.end());  // both runs may have it
    core::fail_input(
        {.where = rule.where}, fmt::format("'{}' is no signal of either run", rule.pattern),
        core::suggestion(rule.pattern, std::vector<std::string>(known.begin(), known.end())));
  }
}

}  // namespace stride::compare
