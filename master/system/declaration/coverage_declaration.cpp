#include "master/system/declaration/coverage_declaration.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "master/base/text/words.h"
#include "master/base/time_text.h"
#include "master/system/declaration/parse_attribute.h"
#include "master/system/ssp/ssp.h"

namespace stride::scenario {
namespace {

constexpr double kWhole = 100;

std::optional<double> read_percentage(const xml::Element& element, const char* attribute) {
  const auto percentage = element.number<double>(attribute);
  if (percentage && !(*percentage >= 0 && *percentage <= kWhole)) {
    element.fail(fmt::format("{}: expected a percentage, from 0 to 100", attribute));
  }
  return percentage;
}

std::optional<std::uint64_t> read_at_least(const xml::Element& element) {
  const auto at_least = element.number<std::uint64_t>("atLeast");
  if (at_least == std::uint64_t{0}) element.fail("atLeast: expected 1 at least");
  return at_least;
}

void read_values(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "signal", "min", "max", "bins", "scale", "edges", "atLeast"});
  point.subject = element.required("signal");
  point.min = element.number<double>("min");
  point.max = element.number<double>("max");
  point.bins = element.number<std::uint64_t>("bins");
  const std::string scale = element.attribute("scale").value_or("linear");
  if (scale != "linear" && scale != "log") element.fail("scale: expected 'linear' or 'log'");
  point.is_logarithmic = scale == "log";
  if (!element.attribute("edges")) return;
  point.edges = element.number_list<double>("edges");
  for (const char* const other : {"min", "max", "bins", "scale"}) {
    if (element.attribute(other))
      element.fail(fmt::format("edges and {} exclude each other", other));
  }
}

void read_transitions(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "signal", "min", "max", "atLeast"});
  point.subject = element.required("signal");
  point.min = element.number<double>("min");
  point.max = element.number<double>("max");
}

void read_words(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "event", "words", "atLeast"});
  point.subject = element.required("event");
  if (!element.attribute("words")) return;
  point.words = core::words_of(element.required("words"));
  if (point.words.empty()) element.fail("words: expected some, with blanks between them");
  std::set<std::string> known;
  for (const std::string& word : point.words) {
    if (!known.insert(word).second) element.fail(fmt::format("words: '{}' is there twice", word));
  }
}

void read_lengths(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "event", "max", "atLeast"});
  point.subject = element.required("event");
  point.greatest = element.number<std::uint64_t>("max");
}

void read_gaps(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "event", "min", "max", "atLeast"});
  point.subject = element.required("event");
  point.shortest = parse_optional_attribute(element, "min", core::parse_seconds);
  point.longest = parse_optional_attribute(element, "max", core::parse_seconds);
  if (point.shortest && point.longest && *point.shortest >= *point.longest) {
    element.fail("no gap is longer than min and shorter than max");
  }
}

void read_cross(const xml::Element& element, PointDeclaration& point) {
  element.allow_attributes({"name", "of", "atLeast"});
  point.of = core::words_of(element.required("of"));
}

struct PointWord {
  const char* element;
  PointKind kind;
  void (*read)(const xml::Element& element, PointDeclaration& point);
};
constexpr std::array kPoints{PointWord{"Values", PointKind::Values, read_values},
                             PointWord{"Transitions", PointKind::Transitions, read_transitions},
                             PointWord{"Words", PointKind::Words, read_words},
                             PointWord{"Lengths", PointKind::Lengths, read_lengths},
                             PointWord{"Sequences", PointKind::Sequences, read_words},
                             PointWord{"Gaps", PointKind::Gaps, read_gaps},
                             PointWord{"Cross", PointKind::Cross, read_cross}};

void read_ignored(const xml::Element& element, GroupDeclaration& group) {
  element.allow_attributes({"point", "bins"});
  element.allow_children({});
  group.ignored.push_back({element.required("point"), element.required("bins"), element.where()});
}

GroupDeclaration read_group(const xml::Element& element) {
  element.allow_attributes({"component", "goal", "atLeast"});
  std::vector<xml::Name> known;
  for (const PointWord& word : kPoints) known.emplace_back(ssp::kStrideScenario, word.element);
  known.emplace_back(ssp::kStrideScenario, "Ignore");
  element.allow_children(known);
  GroupDeclaration group{element.required("component"), read_percentage(element, "goal")};
  group.at_least = read_at_least(element).value_or(1);
  group.where = element.where();
  for (const xml::Element& child : element.children()) {
    if (child.is(ssp::kStrideScenario, "Ignore")) read_ignored(child, group);
    for (const PointWord& word : kPoints) {
      if (!child.is(ssp::kStrideScenario, word.element)) continue;
      child.allow_children({});
      PointDeclaration& point = group.points.emplace_back();
      point.kind = word.kind;
      point.where = child.where();
      if (child.attribute("name")) point.name = child.required_line("name");
      point.at_least = read_at_least(child);
      word.read(child, point);
    }
  }
  return group;
}

}  // namespace

const char* element_name(PointKind kind) {
  return std::ranges::find(kPoints, kind, &PointWord::kind)->element;
}

std::vector<GroupDeclaration> read_coverage(const xml::Element& coverage) {
  const xml::Name group(ssp::kStrideScenario, "Group");
  coverage.allow_attributes({});
  coverage.allow_children({group});
  std::vector<GroupDeclaration> groups;
  for (const xml::Element& element : coverage.children(group)) {
    groups.push_back(read_group(element));
  }
  return groups;
}

std::vector<CoveredDeclaration> read_covered(const xml::Element& checks) {
  std::vector<CoveredDeclaration> found;
  for (const xml::Element& element : checks.children({ssp::kStrideScenario, "Covered"})) {
    element.allow_attributes({"name", "component", "point", "min"});
    element.allow_children({});
    CoveredDeclaration& covered = found.emplace_back();
    if (element.attribute("name")) covered.name = element.required_line("name");
    covered.component = element.required("component");
    if (element.attribute("point")) covered.points = element.required("point");
    element.required("min");
    covered.min = *read_percentage(element, "min");
    covered.where = element.where();
  }
  return found;
}

}  // namespace stride::scenario
