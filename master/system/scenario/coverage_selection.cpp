#include "master/system/scenario/coverage_selection.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/diagnostics.h"
#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"
#include "master/system/scenario/coverage_points.h"

namespace stride::scenario {
namespace {

using coverage::GroupDefinition;
using coverage::PointDefinition;

constexpr std::size_t kMostNames = 5;

std::vector<std::string> point_names(const GroupDefinition& group) {
  std::vector<std::string> names;
  for (const PointDefinition& point : group.points) names.push_back(point.name);
  return names;
}

void add_point(GroupDefinition& group, PointDefinition point, const core::Location& where) {
  if (std::ranges::find(group.points, point.name, &PointDefinition::name) != group.points.end()) {
    core::fail_input({.where = where},
                     fmt::format("a second point '{}' of the component", point.name),
                     "give each a name of its own");
  }
  group.points.push_back(std::move(point));
}

/// A declaration that is of several signals has made a point for each, with names of their own.
[[noreturn]] void fail_part(const GroupDefinition& group, const core::Context& context,
                            const std::string& name) {
  const auto first_with = [&](const char* behind) -> const std::string* {
    const auto found = std::ranges::find_if(group.points, [&](const PointDefinition& point) {
      return point.name.starts_with(name + behind);
    });
    return found == group.points.end() ? nullptr : &found->name;
  };
  if (const std::string* const element = first_with("[")) {
    core::fail_input(context, fmt::format("'{}' is an array, with a point for each element", name),
                     fmt::format("cross one of them, such as {}", *element));
  }
  if (const std::string* const signal = first_with(": ")) {
    core::fail_input(context, fmt::format("'{}' is of several signals", name),
                     fmt::format("write a point for '{}' alone, with another name", *signal));
  }
  if (const std::string* const other = first_with(" ")) {
    core::fail_input(context,
                     fmt::format("the component has no point '{}'; blanks separate points", name),
                     fmt::format("give '{}' a name without blanks", *other));
  }
  core::fail_input(context, fmt::format("the component has no point '{}'", name),
                   core::suggestion(name, point_names(group)));
}

const PointDefinition& part_of(const GroupDefinition& group, const PointDeclaration& cross,
                               const std::string& name) {
  const auto found = std::ranges::find(group.points, name, &PointDefinition::name);
  const core::Context context{.where = cross.where};
  if (found == group.points.end()) fail_part(group, context, name);
  if (found->kind == PointKind::Values || found->kind == PointKind::Words ||
      found->kind == PointKind::Lengths) {
    return *found;
  }
  core::fail_input(context, fmt::format("'{}' is of {}", name, coverage::name(found->kind)),
                   "a cross is of values, words and lengths");
}

void check_parts(const std::vector<const PointDefinition*>& parts, const PointDeclaration& cross) {
  const core::Context context{.where = cross.where};
  if (parts.size() < 2 || parts.size() > coverage::kMostParts) {
    core::fail_input(context, fmt::format("a cross is of 2 to {} points", coverage::kMostParts));
  }
  const PointDefinition* message = nullptr;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (std::find(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), parts[i]) !=
        parts.begin() + static_cast<std::ptrdiff_t>(i)) {
      core::fail_input(context, fmt::format("'{}' is crossed with itself", parts[i]->name));
    }
    if (coverage::is_of_signal(parts[i]->kind)) continue;
    if (message != nullptr && message->id != parts[i]->id) {
      core::fail_input(context, fmt::format("'{}' and '{}' are of different messages, which are "
                                            "not received at the same time",
                                            message->name, parts[i]->name));
    }
    message = parts[i];
  }
}

void add_cross(GroupDefinition& group, const PointDeclaration& declared, std::uint64_t at_least) {
  std::vector<const PointDefinition*> parts;
  PointDefinition cross;
  cross.kind = PointKind::Cross;
  cross.at_least = declared.at_least.value_or(at_least);
  for (const std::string& name : declared.of) {
    parts.push_back(&part_of(group, declared, name));
    cross.of.push_back(static_cast<std::size_t>(parts.back() - group.points.data()));
    coverage::append_crossed(cross.name, name);
    cross.is_open |= parts.back()->is_open;
  }
  check_parts(parts, declared);
  try {
    if (!cross.is_open) cross.bins = coverage::cross_bins(parts);
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({.where = declared.where}, mistake.what(), "cross points with fewer bins");
  }
  if (!declared.name.empty()) cross.name = declared.name;
  add_point(group, std::move(cross), declared.where);
}

/// Returns whether it is one of the point's bins, or may be.
bool ignore(PointDefinition& point, const std::string& bins) {
  point.ignored.push_back(bins);
  bool any = point.is_open;
  for (coverage::DeclaredBin& bin : point.bins) {
    if (!core::means(bins, bin.name)) continue;
    bin.is_ignored = any = true;
  }
  return any;
}

/// Crosses are made of what their parts do not ignore, so they come later.
void ignore(GroupDefinition& group, const IgnoreDeclaration& declared, bool is_of_crosses) {
  bool any = false;
  std::vector<std::string> bins;
  for (PointDefinition& point : group.points) {
    if ((point.kind == PointKind::Cross) != is_of_crosses) continue;
    if (!core::means(declared.points, point.name)) continue;
    any |= ignore(point, declared.bins);
    for (const coverage::DeclaredBin& bin : point.bins) bins.push_back(bin.name);
  }
  if (any || bins.empty()) return;
  core::fail_input({.where = declared.where},
                   fmt::format("no point '{}' has a bin '{}'", declared.points, declared.bins),
                   core::suggestion(declared.bins, bins));
}

void require_point(const GroupDefinition& group, const std::string& pattern,
                   const core::Location& where) {
  const std::vector<std::string> names = point_names(group);
  if (std::ranges::any_of(names, [&](const auto& name) { return core::means(pattern, name); })) {
    return;
  }
  core::fail_input({.where = where}, fmt::format("the component has no point '{}'", pattern),
                   core::suggestion(pattern, names));
}

std::string note_of(const std::string& component, const std::vector<std::string>& inputs) {
  return fmt::format(
      "coverage of '{0}': nothing says which values these inputs have, so they have no automatic "
      "points: {1}; <stride:Values signal=\"{2}\" min=\"…\" max=\"…\"/> in a "
      "<stride:Group component=\"{0}\"> covers one",
      component, core::abridged(inputs, kMostNames), inputs.front());
}

class CoverageSelection {
 public:
  explicit CoverageSelection(const core::System& system) : system_(system) {}

  void add_group(const GroupDeclaration& declared) {
    GroupDefinition group{
        .name = declared.component, .goal = declared.goal, .where = declared.where};
    group.component = system_.find_component(declared.component, declared.where);
    check_new(group);
    const CoveragePoints points(system_, group.component);
    if (declared.points.empty()) {
      add_automatic(group, points, declared);
    } else {
      add_declared(group, points, declared);
    }
    if (!diagnostics_.any()) check_goal(group);
    selected_.groups.push_back(std::move(group));
  }

  void add_demand(const CoveredDeclaration& declared);
  core::Diagnostics& diagnostics() { return diagnostics_; }
  SelectedCoverage take() { return std::move(selected_); }

 private:
  void check_new(const GroupDefinition& group) {
    const auto [first, is_new] = before_.emplace(group.name, group.where);
    if (is_new) return;
    const core::Location& where = first->second;
    core::fail_input({.where = group.where},
                     fmt::format("a second group of the component '{}'; the first is in line {}",
                                 group.name, where.line),
                     "put all points of a component into one group");
  }

  /// One that no run could be measured by.
  static void check_goal(const GroupDefinition& group) {
    const auto counts = [](const PointDefinition& point) {
      return !point.is_open &&
             std::ranges::any_of(point.bins,
                                 [](const coverage::DeclaredBin& bin) { return !bin.is_ignored; });
    };
    if (!group.goal || std::ranges::any_of(group.points, counts)) return;
    core::fail_input({.where = group.where},
                     fmt::format("the group of '{}' has a goal, but no percentage, since nothing "
                                 "says which bins its points have",
                                 group.name),
                     "declare bins, with words=\"…\" or max=\"…\", or leave the goal out");
  }

  void add_automatic(GroupDefinition& group, const CoveragePoints& points,
                     const GroupDeclaration& declared);
  void add_declared(GroupDefinition& group, const CoveragePoints& points,
                    const GroupDeclaration& declared);
  void apply_ignored(GroupDefinition& group, const GroupDeclaration& declared, bool is_of_crosses);
  coverage::Demand demand(const CoveredDeclaration& declared, std::size_t group,
                          std::optional<std::size_t> point, bool is_alone) const;

  const core::System& system_;
  core::Diagnostics diagnostics_;
  std::map<std::string, core::Location> before_;
  SelectedCoverage selected_;
};

void CoverageSelection::apply_ignored(GroupDefinition& group, const GroupDeclaration& declared,
                                      bool is_of_crosses) {
  for (const IgnoreDeclaration& ignored : declared.ignored) {
    diagnostics_.attempt([&] { ignore(group, ignored, is_of_crosses); });
  }
}

void CoverageSelection::add_automatic(GroupDefinition& group, const CoveragePoints& points,
                                      const GroupDeclaration& declared) {
  std::vector<std::string> without_range;
  group.points = points.automatic(declared.at_least, without_range);
  if (!without_range.empty()) selected_.notes.push_back(note_of(group.name, without_range));
  if (group.points.empty()) {
    core::fail_input({.where = declared.where},
                     fmt::format("the component '{}' has nothing for automatic points", group.name),
                     "write some into its <stride:Group>");
  }
  apply_ignored(group, declared, false);
  for (const IgnoreDeclaration& ignored : declared.ignored) {
    diagnostics_.attempt([&] { require_point(group, ignored.points, ignored.where); });
  }
}

void CoverageSelection::add_declared(GroupDefinition& group, const CoveragePoints& points,
                                     const GroupDeclaration& declared) {
  bool is_whole = true;
  for (const PointDeclaration& point : declared.points) {
    if (point.kind == PointKind::Cross) continue;
    is_whole &= diagnostics_.attempt([&] {
      for (PointDefinition& selected : points.select(point, declared.at_least)) {
        add_point(group, std::move(selected), point.where);
      }
    });
  }
  if (!is_whole) return;  // crosses and what is ignored may be of what is missing
  apply_ignored(group, declared, false);
  for (const PointDeclaration& point : declared.points) {
    if (point.kind != PointKind::Cross) continue;
    is_whole &= diagnostics_.attempt([&] { add_cross(group, point, declared.at_least); });
  }
  if (!is_whole) return;
  apply_ignored(group, declared, true);
  for (const IgnoreDeclaration& ignored : declared.ignored) {
    diagnostics_.attempt([&] { require_point(group, ignored.points, ignored.where); });
  }
}

coverage::Demand CoverageSelection::demand(const CoveredDeclaration& declared, std::size_t group,
                                           std::optional<std::size_t> point, bool is_alone) const {
  const GroupDefinition& covered = selected_.groups[group];
  const std::string subject =
      point ? fmt::format("{}, {}", covered.name, covered.points[*point].name) : covered.name;
  coverage::Demand demand{.demand = fmt::format("{} covered >= {} %", subject, declared.min),
                          .group = group,
                          .point = point,
                          .min = declared.min,
                          .where = declared.where};
  demand.name = declared.name.empty() ? demand.demand
                : is_alone            ? declared.name
                                      : fmt::format("{}: {}", declared.name, subject);
  return demand;
}

void CoverageSelection::add_demand(const CoveredDeclaration& declared) {
  const core::Context context{.where = declared.where};
  system_.find_component(declared.component, declared.where);
  const auto group =
      std::ranges::find(selected_.groups, declared.component, &GroupDefinition::name);
  if (group == selected_.groups.end()) {
    core::fail_input(context, fmt::format("the component '{}' has no coverage", declared.component),
                     fmt::format("write <stride:Coverage><stride:Group component=\"{}\"/>"
                                 "</stride:Coverage>",
                                 declared.component));
  }
  const auto index = static_cast<std::size_t>(group - selected_.groups.begin());
  if (!declared.points) {
    selected_.demands.push_back(demand(declared, index, {}, true));
    return;
  }
  require_point(*group, *declared.points, declared.where);
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < group->points.size(); ++i) {
    const PointDefinition& point = group->points[i];
    if (!point.is_open && core::means(*declared.points, point.name)) points.push_back(i);
  }
  if (points.empty()) {
    core::fail_input(context,
                     fmt::format("'{}' has no percentage, since nothing says which bins it has",
                                 *declared.points),
                     "declare them, with words=\"…\" or max=\"…\"");
  }
  for (const std::size_t point : points) {
    selected_.demands.push_back(demand(declared, index, point, points.size() == 1));
  }
}

}  // namespace

SelectedCoverage select_coverage(const core::System& system,
                                 std::span<const GroupDeclaration> groups,
                                 std::span<const CoveredDeclaration> demands) {
  CoverageSelection selection(system);
  core::Diagnostics& diagnostics = selection.diagnostics();
  for (const GroupDeclaration& group : groups) {
    diagnostics.attempt([&] { selection.add_group(group); });
  }
  if (!diagnostics.any()) {
    for (const CoveredDeclaration& demand : demands) {
      diagnostics.attempt([&] { selection.add_demand(demand); });
    }
  }
  diagnostics.raise();
  return selection.take();
}

}  // namespace stride::scenario
