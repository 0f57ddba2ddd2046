#include "master/front/cli/compare/comparison_table.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/text/readable_text.h"
#include "master/base/time_text.h"
#include "master/front/cli/terminal/table.h"

namespace stride::cli {
namespace {

constexpr std::size_t kMostRows = 20;

std::string seconds(Time time) { return core::to_text(time); }

std::string verdict(const compare::Comparison& comparison) {
  if (comparison.differences.empty()) {
    return fmt::format(
        "equal: {} in {}, {} sent or received", core::counted(comparison.signals, "signal"),
        core::counted(comparison.rows, "row"), core::counted(comparison.messages, "message"));
  }
  const compare::Difference& first = comparison.differences.front();
  const std::string where = fmt::format("in {} {}", compare::name(first.kind), first.name);
  if (!first.time) return fmt::format("differ {}", where);
  return fmt::format("differ first at t = {} s {}", seconds(*first.time), where);
}

std::string short_number(const std::string& text) {
  constexpr std::size_t kShort = 9;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && text.size() > kShort ? fmt::format("{:.6g}", number) : text;
}

/// How the runs ended, and what was demanded of them, come before all else.
std::vector<const compare::Difference*> most_important(const compare::Differences& differences) {
  std::vector<const compare::Difference*> ordered;
  for (const compare::Difference& difference : differences) ordered.push_back(&difference);
  std::ranges::stable_partition(ordered, [](const compare::Difference* difference) {
    return difference->kind == compare::Kind::Outcome ||
           difference->kind == compare::Kind::Verdict || difference->kind == compare::Kind::Check;
  });
  return ordered;
}

/// Behind what both begin with, but for a few characters of that.
std::pair<std::string, std::string> ends_of(const std::string& a, const std::string& b) {
  constexpr std::ptrdiff_t kKept = 4;
  const auto [differs, other] = std::ranges::mismatch(a, b);
  std::ptrdiff_t from = std::max<std::ptrdiff_t>(differs - a.begin() - kKept, 0);
  while (from > 0 && core::is_within_character(a[static_cast<std::size_t>(from)])) --from;
  if (from == 0) return {a, b};
  const auto end = [&](const std::string& text) {
    return "…" + text.substr(static_cast<std::size_t>(from));
  };
  return {end(a), end(b)};
}

/// In short, unless they are the same in short.
std::pair<std::string, std::string> shown_values(const compare::Difference& difference) {
  constexpr std::size_t kMostCharacters = 36;
  const auto shortened = [](const std::string& a, const std::string& b) {
    return std::pair(core::readable_text(a, kMostCharacters),
                     core::readable_text(b, kMostCharacters));
  };
  const auto& [a, b] = std::tie(difference.a, difference.b);
  auto shown = shortened(short_number(a), short_number(b));
  if (shown.first == shown.second) shown = shortened(a, b);
  if (shown.first != shown.second) return shown;
  const auto [end_a, end_b] = ends_of(a, b);
  return shortened(end_a, end_b);
}

std::string extreme_text(const std::optional<compare::Extreme>& extreme) {
  return extreme ? fmt::format("{:.3g} at {}", extreme->value, seconds(extreme->time)) : "";
}

std::string difference_table(const compare::Differences& differences) {
  using enum Table::Align;
  Table table({{"what", Left},
               {"name", Left},
               {"first [s]", Right},
               {"A", Left},
               {"B", Left},
               {"places", Right},
               {"greatest", Left},
               {"relative", Left}});
  const std::vector<const compare::Difference*> ordered = most_important(differences);
  for (std::size_t i = 0; i < std::min(ordered.size(), kMostRows); ++i) {
    const compare::Difference& difference = *ordered[i];
    const auto [a, b] = shown_values(difference);
    table.add({compare::name(difference.kind), difference.name,
               difference.time ? seconds(*difference.time) : "", a, b,
               std::to_string(difference.count), extreme_text(difference.absolute),
               extreme_text(difference.relative)});
  }
  std::string text = table.text();
  if (ordered.size() > kMostRows) {
    text += fmt::format("  and {} more; --json has all\n", ordered.size() - kMostRows);
  }
  return text;
}

/// A digest is long, and its beginning tells it from another one.
std::string shown(const compare::InputDifference& input, const std::string& value) {
  constexpr std::size_t kDigits = 12;
  constexpr std::size_t kMostCharacters = 60;
  if (value.empty()) return "none";
  if (input.kind == "source") return "sha256 " + value.substr(0, kDigits);
  return core::readable_text(value, kMostCharacters);
}

std::string input_table(const std::optional<std::vector<compare::InputDifference>>& inputs) {
  if (!inputs) return "What the runs were made from is not compared: run.json is missing.\n";
  if (inputs->empty()) return "They were made from the same inputs.\n";
  using enum Table::Align;
  Table table({{"input", Left}, {"name", Left}, {"A", Left}, {"B", Left}});
  for (std::size_t i = 0; i < std::min(inputs->size(), kMostRows); ++i) {
    const compare::InputDifference& input = (*inputs)[i];
    table.add({input.kind, input.name, shown(input, input.a), shown(input, input.b)});
  }
  std::string text = "They were made from other inputs:\n" + table.text();
  if (inputs->size() > kMostRows) {
    text += fmt::format("  and {} more; --json has all\n", inputs->size() - kMostRows);
  }
  return text;
}

bool is_of_rows(const compare::Difference& difference) {
  return difference.kind == compare::Kind::File &&
         (difference.a == compare::kRow || difference.b == compare::kRow);
}

}  // namespace

std::string comparison_text(const compare::Comparison& comparison) {
  std::string text = verdict(comparison) + "\n";
  if (!comparison.differences.empty()) text += difference_table(comparison.differences);
  if (std::ranges::any_of(comparison.differences, is_of_rows)) {
    text += "They have rows at other instants: --time-tolerance 0 compares signals as curves.\n";
  }
  text += input_table(comparison.inputs);
  return text + fmt::format("Not compared: {}.\n", compare::kNotCompared);
}

}  // namespace stride::cli
