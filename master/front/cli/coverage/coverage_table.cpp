#include "master/front/cli/coverage/coverage_table.h"

#include <fmt/format.h>

#include "master/front/cli/terminal/table.h"
#include "master/observe/coverage/demand.h"
#include "master/observe/coverage/told_apart.h"

namespace stride::cli {
namespace {

std::string goal_text(const std::optional<double>& goal) {
  return goal ? fmt::format("{} %", *goal) : "";
}

std::string subject_of(const coverage::GroupDefinition& group,
                       const coverage::PointDefinition& point) {
  if (point.kind != coverage::Kind::Cross) return point.signal;
  std::string text;
  for (const std::size_t part : point.of) coverage::append_crossed(text, group.points[part].name);
  return text;
}

}  // namespace

std::string coverage_table(const coverage::Report& report) {
  Table table({{"point"},
               {"bins", Table::Align::Right},
               {"hit", Table::Align::Right},
               {"covered", Table::Align::Right},
               {"goal", Table::Align::Right}});
  for (const coverage::GroupReport& group : report.groups) {
    table.add({group.component, "", "", coverage::percentage_text(group.percentage()),
               goal_text(group.goal)});
    for (const coverage::PointReport& point : group.points) {
      table.add(
          {"  " + label(group, point), point.is_open ? "open" : std::to_string(point.countable()),
           std::to_string(point.covered()), coverage::percentage_text(point.percentage()), ""});
    }
  }
  return "\nCoverage\n" + table.text();
}

std::string coverage_table(std::span<const coverage::GroupDefinition> groups) {
  if (groups.empty()) return "";
  Table table({{"component"},
               {"point"},
               {"kind"},
               {"of"},
               {"bins", Table::Align::Right},
               {"at least", Table::Align::Right}});
  for (const coverage::GroupDefinition& group : groups) {
    for (const coverage::PointDefinition& point : group.points) {
      std::size_t bins = 0;
      for (const coverage::DeclaredBin& bin : point.bins) bins += bin.is_ignored ? 0 : 1;
      table.add({group.name, point.name, name(point.kind), subject_of(group, point),
                 point.is_open ? "open" : std::to_string(bins), std::to_string(point.at_least)});
    }
  }
  return "\nCoverage\n" + table.text();
}

std::string missing_table(const coverage::Report& report) {
  Table table({{"component"}, {"point"}, {"bin"}, {"visits", Table::Align::Right}});
  for (const coverage::GroupReport& group : report.groups) {
    for (const coverage::PointReport& point : group.points) {
      for (const coverage::BinCount& bin : point.bins) {
        if (bin.is_ignored || bin.count >= point.at_least) continue;
        table.add({group.component, label(group, point), bin.name, std::to_string(bin.count)});
      }
    }
  }
  return table.size() == 0 ? "" : "\nNot covered\n" + table.text();
}

std::string told_apart_table(const coverage::Report& report, const FilesOfPoints& where) {
  Table table({{"component"}, {"point"}, {"in"}, {"why"}});
  const char* const word = report.runs == report.cases ? "cases" : "runs";
  for (const coverage::ToldApart& point : coverage::told_apart(report)) {
    std::string in = fmt::format("{} of {} {}", point.runs, report.runs, word);
    const auto place = where.find({point.component, point.definition});
    if (place != where.end()) {
      in += ": " + place->second;
    } else if (point.first_case) {
      in += fmt::format(", from case {} on", *point.first_case);
    }
    table.add({point.component, point.point, in, point.why});
  }
  return table.size() == 0 ? "" : "\nNot alike in all runs\n" + table.text();
}

}  // namespace stride::cli
