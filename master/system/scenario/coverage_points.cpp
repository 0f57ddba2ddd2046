#include "master/system/scenario/coverage_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"
#include "master/base/text/words.h"
#include "master/engine/model/array_element.h"
#include "master/engine/model/number_range.h"

namespace stride::scenario {
namespace {

using core::ValueType;
using coverage::PointDefinition;

constexpr std::uint64_t kDefaultBins = 10;
/// An integer with no more values has a bin for each.
constexpr double kMostItems = 64;

bool is_bytes(ValueType type) { return type == ValueType::Binary || type == ValueType::String; }

/// Of the description's `min` or `max`; nothing where that is the limit of the type, as FMI has it
/// by default, or beyond what bins of integers have.
std::optional<double> limit_of(const core::Variable& variable, const std::string& text,
                               std::size_t element) {
  const std::vector<std::string> words = core::words_of(text);
  if (words.empty()) return std::nullopt;
  const auto number =
      xml::to_number<double>(words[words.size() == 1 ? 0 : std::min(element, words.size() - 1)]);
  const double most = core::is_integer(variable.type) ? coverage::kExactIntegers
                                                      : std::numeric_limits<double>::max();
  if (!number || !(std::abs(*number) < most)) return std::nullopt;
  return number;
}

struct Range {
  std::optional<double> min, max;
  bool is_whole() const { return min && max; }
};

Range range_of(const core::Variable& variable, std::size_t element,
               const PointDeclaration& declared) {
  Range range{declared.min, declared.max};
  if (!range.min) range.min = limit_of(variable, variable.min, element);
  if (!range.max) range.max = limit_of(variable, variable.max, element);
  return range;
}

/// Throws std::invalid_argument where the type has not all of them.
coverage::Items items_between(double min, double max, ValueType type) {
  std::vector<std::pair<std::int64_t, std::string>> items;
  for (auto i = static_cast<std::int64_t>(std::ceil(min)); static_cast<double>(i) <= max; ++i) {
    if (!core::range_of(type)->holds(i)) {
      throw std::invalid_argument(fmt::format("{} is no {}", i, core::name(type)));
    }
    items.emplace_back(i, std::to_string(i));
  }
  if (items.empty()) {
    throw std::invalid_argument(fmt::format("no {} is from {} to {}", core::name(type), min, max));
  }
  return coverage::Items(std::move(items));
}

coverage::Items items_of(const core::Variable& variable) {
  std::map<std::int64_t, std::string> items;
  for (const auto& [name, number] : variable.items) items.emplace(number, name);
  return coverage::Items({items.begin(), items.end()});
}

bool has_few_values(const core::Variable& variable, const Range& range) {
  return core::is_number(variable.type) && !core::is_real(variable.type) && range.is_whole() &&
         *range.max >= *range.min && *range.max - *range.min < kMostItems &&
         std::max(std::abs(*range.min), std::abs(*range.max)) <= coverage::kExactIntegers;
}

/// Throws std::invalid_argument.
coverage::Classes classes_of(const core::Variable& variable, std::size_t element,
                             const PointDeclaration& declared) {
  if (!core::is_number(variable.type)) {
    if (variable.type != ValueType::Boolean && variable.type != ValueType::Enumeration) {
      throw std::invalid_argument(fmt::format("it is {}, whose values have no bins",
                                              core::name_with_article(variable.type)));
    }
    if (declared.min || declared.max || declared.bins || !declared.edges.empty()) {
      throw std::invalid_argument(fmt::format("it is {}, which has a bin for each value",
                                              core::name_with_article(variable.type)));
    }
    return variable.type == ValueType::Enumeration ? items_of(variable)
                                                   : coverage::Items({{0, "false"}, {1, "true"}});
  }
  if (!declared.edges.empty()) return coverage::ranges_between(declared.edges, variable.type);
  const Range range = range_of(variable, element, declared);
  if (!range.is_whole()) {
    const bool has_edges = declared.kind == PointKind::Values;
    throw std::invalid_argument(fmt::format("it has no {}; write min=\"…\" max=\"…\"{}",
                                            range.min   ? "max"
                                            : range.max ? "min"
                                                        : "min and max",
                                            has_edges ? ", or edges=\"…\"" : ""));
  }
  if (!declared.bins && !declared.is_logarithmic && has_few_values(variable, range)) {
    return items_between(*range.min, *range.max, variable.type);
  }
  return coverage::equal_ranges(*range.min, *range.max, declared.bins.value_or(kDefaultBins),
                                declared.is_logarithmic, variable.type);
}

[[noreturn]] void fail_transitions(const std::string& signal) {
  throw std::invalid_argument(fmt::format(
      "transitions are those of a Boolean, an Enumeration or an integer with {} values at most; "
      "cover its values in bins: <stride:Values signal=\"{}\" min=\"…\" max=\"…\" bins=\"…\"/>",
      kMostItems, signal));
}

void set_values(PointDefinition& point, const core::Variable& variable,
                const PointDeclaration& declared) {
  const bool is_values = point.kind == PointKind::Values;
  if (!is_values && core::is_real(variable.type)) fail_transitions(point.signal);
  point.unit = variable.unit;
  point.classes = classes_of(variable, point.element, declared);
  if (is_values) {
    point.bins = std::visit([](const auto& all) { return all.bins(); }, *point.classes);
    return;
  }
  const auto* const items = std::get_if<coverage::Items>(&*point.classes);
  if (items == nullptr) fail_transitions(point.signal);
  point.bins = items->transitions();
}

void set_words(PointDefinition& point, const core::Variable& variable,
               const PointDeclaration& declared) {
  if (variable.size != 1) throw std::invalid_argument("it is an array, which has no word");
  point.items = variable.items;
  point.is_text = variable.type == ValueType::Binary;
  point.is_open = declared.words.empty();
  if (point.kind == PointKind::Words) {
    for (const std::string& word : declared.words) point.bins.push_back({word});
    return;
  }
  for (const std::string& from : declared.words) {
    for (const std::string& to : declared.words) {
      coverage::set_pair(point.bins.emplace_back().name, from, to);
    }
  }
}

void set_lengths(PointDefinition& point, const core::Variable& variable,
                 const PointDeclaration& declared) {
  if (!is_bytes(variable.type) || variable.size != 1) {
    throw std::invalid_argument("lengths are those of a Binary or a String");
  }
  point.greatest = declared.greatest;
  point.is_open = !declared.greatest;
  if (declared.greatest) point.bins = coverage::length_bins(*declared.greatest);
}

}  // namespace

bool CoveragePoints::is_signal(std::size_t variable) const {
  return description_.variables[variable].causality != core::Causality::Independent &&
         system_.is_signal({component_, variable});
}

bool CoveragePoints::is_reported(std::size_t variable) const {
  return system_.is_reported({component_, variable});
}

std::vector<CoveragePoints::Subject> CoveragePoints::find(const PointDeclaration& declared) const {
  const std::string& pattern = declared.subject;
  const bool wants_signal = coverage::is_of_signal(declared.kind);
  std::vector<Subject> found;
  for (std::size_t i = 0; i < description_.variables.size(); ++i) {
    const core::Variable& variable = description_.variables[i];
    if (wants_signal ? !is_signal(i) : !is_reported(i)) continue;
    const bool is_whole = core::means(pattern, variable.name) ||
                          std::ranges::any_of(variable.aliases, [&](const std::string& alias) {
                            return core::means(pattern, alias);
                          });
    if (!wants_signal) {
      if (is_whole) found.push_back({i, 0, variable.name});
      continue;
    }
    for (std::size_t k = 0; k < variable.size; ++k) {
      std::string name = core::element_name(variable, k);
      if (is_whole || core::means(pattern, name)) found.push_back({i, k, std::move(name)});
    }
  }
  if (found.empty()) fail_unknown(declared);
  return found;
}

void CoveragePoints::fail_unknown(const PointDeclaration& declared) const {
  const bool wants_signal = coverage::is_of_signal(declared.kind);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < description_.variables.size(); ++i) {
    const core::Variable& variable = description_.variables[i];
    const bool fits = wants_signal ? is_signal(i) : is_reported(i);
    if (fits) names.push_back(variable.name);
    if (fits || variable.name != declared.subject) continue;
    core::fail_input(
        {.where = declared.where},
        fmt::format("'{}' is not a {}", variable.name, wants_signal ? "signal" : "message"),
        is_signal(i)     ? "cover it with <stride:Values> or <stride:Transitions>"
        : is_reported(i) ? "cover it with <stride:Words>, <stride:Lengths>, "
                           "<stride:Sequences> or <stride:Gaps>"
                         : "name what the clock carries");
  }
  core::fail_input({.where = declared.where},
                   fmt::format("the component has no {} '{}'", wants_signal ? "signal" : "message",
                               declared.subject),
                   core::suggestion(declared.subject, names));
}

PointDefinition CoveragePoints::point(const PointDeclaration& declared,
                                      const Subject& subject) const {
  const core::Variable& variable = description_.variables[subject.variable];
  PointDefinition point;
  point.kind = declared.kind;
  point.id = {component_, subject.variable};
  point.element = subject.element;
  point.signal = subject.name;
  point.name = declared.kind == PointKind::Values
                   ? subject.name
                   : fmt::format("{}:{}", subject.name, name(declared.kind));
  switch (declared.kind) {
    case PointKind::Values:
    case PointKind::Transitions:
      set_values(point, variable, declared);
      break;
    case PointKind::Lengths:
      set_lengths(point, variable, declared);
      break;
    case PointKind::Gaps:
      point.bins = coverage::gap_bins(declared.shortest, declared.longest);
      break;
    default:
      set_words(point, variable, declared);
  }
  return point;
}

std::vector<PointDefinition> CoveragePoints::select(const PointDeclaration& declared,
                                                    std::uint64_t at_least) const {
  std::vector<PointDefinition> points;
  const std::vector<Subject> subjects = find(declared);
  for (const Subject& subject : subjects) {
    try {
      points.push_back(point(declared, subject));
    } catch (const std::invalid_argument& mistake) {
      core::fail_input({.where = declared.where},
                       fmt::format("'{}': {}", subject.name, mistake.what()));
    }
    points.back().at_least = declared.at_least.value_or(at_least);
    if (declared.name.empty()) continue;
    points.back().name =
        subjects.size() == 1 ? declared.name : fmt::format("{}: {}", declared.name, subject.name);
  }
  return points;
}

void CoveragePoints::add_messages(const Subject& subject, std::uint64_t at_least,
                                  std::vector<PointDefinition>& points) const {
  const core::Variable& variable = description_.variables[subject.variable];
  const bool has_words = variable.size == 1 && !core::is_real(variable.type);
  for (const PointKind kind :
       {PointKind::Words, PointKind::Lengths, PointKind::Sequences, PointKind::Gaps}) {
    if ((kind == PointKind::Words || kind == PointKind::Sequences) && !has_words) continue;
    if (kind == PointKind::Lengths && !(has_words && is_bytes(variable.type))) continue;
    points.push_back(point({kind}, subject));
    points.back().at_least = at_least;
  }
}

void CoveragePoints::add_values(const Subject& subject, std::uint64_t at_least,
                                std::vector<PointDefinition>& points,
                                std::vector<std::string>& without_range) const {
  const core::Variable& variable = description_.variables[subject.variable];
  const bool has_items =
      variable.type == ValueType::Boolean || variable.type == ValueType::Enumeration;
  const bool is_input = variable.causality == core::Causality::Input;
  if (!has_items && (!is_input || !core::is_number(variable.type))) return;
  try {
    points.push_back(point({PointKind::Values}, subject));
  } catch (const std::invalid_argument&) {
    without_range.push_back(subject.name);
    return;
  }
  points.back().at_least = at_least;
  if (is_input) return;
  points.push_back(point({PointKind::Transitions}, subject));
  points.back().at_least = at_least;
}

std::vector<PointDefinition> CoveragePoints::automatic(
    std::uint64_t at_least, std::vector<std::string>& without_range) const {
  std::vector<PointDefinition> points;
  for (std::size_t i = 0; i < description_.variables.size(); ++i) {
    const core::Variable& variable = description_.variables[i];
    const bool is_input = variable.causality == core::Causality::Input;
    if (!is_input && variable.causality != core::Causality::Output) continue;
    if (is_input && is_reported(i)) add_messages({i, 0, variable.name}, at_least, points);
    if (!is_signal(i) || variable.size != 1) continue;
    add_values({i, 0, variable.name}, at_least, points, without_range);
  }
  return points;
}

}  // namespace stride::scenario
