#include "master/system/declaration/coverage_writer.h"

#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/time_text.h"

namespace stride::scenario {
namespace {

template <class Number>
void write_number(xml::Writer& writer, const char* name, const std::optional<Number>& number) {
  if (number) writer.attribute(name, fmt::format("{}", *number));
}

void write_gap(xml::Writer& writer, const char* name, const std::optional<Duration>& gap) {
  if (gap) writer.attribute(name, core::to_text(*gap));
}

/// Each member is there only where the kind has it.
void write_point(xml::Writer& writer, const PointDeclaration& point) {
  const std::string element = fmt::format("stride:{}", element_name(point.kind));
  writer.open(element.c_str());
  if (!point.name.empty()) writer.attribute("name", point.name);
  if (point.kind == PointKind::Cross) {
    writer.attribute("of", fmt::format("{}", fmt::join(point.of, " ")));
  } else {
    writer.attribute(coverage::is_of_signal(point.kind) ? "signal" : "event", point.subject);
  }
  write_number(writer, "min", point.min);
  write_number(writer, "max", point.max);
  write_number(writer, "bins", point.bins);
  if (point.is_logarithmic) writer.attribute("scale", "log");
  if (!point.edges.empty())
    writer.attribute("edges", fmt::format("{}", fmt::join(point.edges, " ")));
  if (!point.words.empty())
    writer.attribute("words", fmt::format("{}", fmt::join(point.words, " ")));
  write_number(writer, "max", point.greatest);
  write_gap(writer, "min", point.shortest);
  write_gap(writer, "max", point.longest);
  write_number(writer, "atLeast", point.at_least);
  writer.close();
}

}  // namespace

void write_group(xml::Writer& writer, const GroupDeclaration& group, const std::string& component) {
  writer.open("stride:Group");
  writer.attribute("component", component);
  write_number(writer, "goal", group.goal);
  if (group.at_least != 1) writer.attribute("atLeast", fmt::format("{}", group.at_least));
  for (const PointDeclaration& point : group.points) write_point(writer, point);
  for (const IgnoreDeclaration& ignored : group.ignored) {
    writer.open("stride:Ignore");
    writer.attribute("point", ignored.points);
    writer.attribute("bins", ignored.bins);
    writer.close();
  }
  writer.close();
}

}  // namespace stride::scenario
