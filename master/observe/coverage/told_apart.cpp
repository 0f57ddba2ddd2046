#include "master/observe/coverage/told_apart.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::coverage {
namespace {

/// What a bin is called where the definition of a point decides it.
std::string declared_bin(const PointReport& point, std::size_t i) {
  if (i >= point.declared) return "not there";
  return fmt::format("'{}'{}", point.bins[i].name, point.bins[i].is_ignored ? ", ignored" : "");
}

/// The first thing in which `point` is not `other`; its text names both.
std::string difference(const PointReport& point, const PointReport& other,
                       const std::string& other_label) {
  const auto differ = [&](const std::string& what, const std::string& own,
                          const std::string& others) {
    return fmt::format("{} is {}, and {} in {}", what, own, others, other_label);
  };
  const auto quoted = [](const std::string& text) { return fmt::format("'{}'", text); };
  if (point.kind != other.kind) return differ("the kind", name(point.kind), name(other.kind));
  if (point.signal != other.signal) {
    return differ("the signal", quoted(point.signal), quoted(other.signal));
  }
  if (point.unit != other.unit) {
    return differ("the unit of measure", quoted(point.unit), quoted(other.unit));
  }
  if (point.at_least != other.at_least) {
    return differ("at_least", std::to_string(point.at_least), std::to_string(other.at_least));
  }
  if (point.of != other.of) {
    return differ("it", quoted(fmt::format("{}", fmt::join(point.of, " "))),
                  quoted(fmt::format("{}", fmt::join(other.of, " "))));
  }
  if (point.of_definitions != other.of_definitions) {
    return fmt::format("a part of it is another one than in {}", other_label);
  }
  for (std::size_t i = 0; i < std::max(point.declared, other.declared); ++i) {
    const std::string own = declared_bin(point, i), others = declared_bin(other, i);
    if (own != others) return differ(fmt::format("bin {}", i + 1), own, others);
  }
  if (point.is_open != other.is_open) {
    return differ("it", point.is_open ? "open" : "not open", other.is_open ? "open" : "not");
  }
  return fmt::format("other bins are ignored than in {}", other_label);
}

std::string why(const GroupReport& group, const PointReport& point) {
  const auto first = std::ranges::find(group.points, point.name, &PointReport::name);
  if (&*first != &point) return difference(point, *first, label(group, *first));
  const bool is_only = std::ranges::count(group.points, point.name, &PointReport::name) == 1;
  return is_only ? "the others have no such point" : "others define it otherwise";
}

}  // namespace

std::string label(const std::string& name, const std::string& definition) {
  constexpr std::size_t kDigits = 8;
  return fmt::format("{}@{}", name, definition.substr(0, kDigits));
}

std::string label(const GroupReport& group, const PointReport& point) {
  if (std::ranges::count(group.points, point.name, &PointReport::name) == 1) return point.name;
  return label(point.name, point.definition);
}

std::vector<std::string> part_labels(const GroupReport& group, const PointReport& cross) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < cross.of.size(); ++i) {
    const auto part = std::ranges::find_if(group.points, [&](const PointReport& point) {
      return point.name == cross.of[i] && point.definition == cross.of_definitions[i];
    });
    labels.push_back(part == group.points.end() ? cross.of[i] : label(group, *part));
  }
  return labels;
}

std::vector<ToldApart> told_apart(const Report& report) {
  std::vector<ToldApart> found;
  for (const GroupReport& group : report.groups) {
    for (const PointReport& point : group.points) {
      if (point.runs >= report.runs) continue;
      found.push_back({group.component, label(group, point), point.definition, point.runs,
                       point.first_case, why(group, point)});
    }
  }
  return found;
}

}  // namespace stride::coverage
