#include "master/observe/coverage/ucis.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/xml/writer.h"
#include "master/observe/coverage/told_apart.h"

namespace stride::coverage {
namespace {

/// Where UCIS wants a place in a source: there is none.
constexpr const char* kNoFile = "1";

using BinNumbers = std::vector<std::size_t>;  ///< of each part of a cross

/// Adds the numbers of the bins whose names are crossed to the rest of this name. Returns whether
/// there are such.
bool find_numbers(std::string_view rest, std::span<const PointReport* const> parts,
                  BinNumbers& numbers) {
  if (parts.empty()) return rest.empty();
  const auto& bins = parts.front()->bins;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    std::string_view behind = rest;
    const std::string_view joint = numbers.empty() ? "" : kCrossJoint;
    if (!behind.starts_with(joint)) return false;
    behind.remove_prefix(joint.size());
    if (!behind.starts_with(bins[i].name)) continue;
    behind.remove_prefix(bins[i].name.size());
    numbers.push_back(i);
    if (find_numbers(behind, parts.subspan(1), numbers)) return true;
    numbers.pop_back();
  }
  return false;
}

class UcisWriter {
 public:
  UcisWriter(const Report& report, const UcisOrigin& origin) : report_(report), origin_(origin) {}

  std::string document() {
    xml_.open("UCIS");
    attributes({{"ucisVersion", "1.0"}, {"writtenBy", "stride"}, {"writtenTime", origin_.date}});
    element("sourceFiles", {{"fileName", report_.scenario}, {"id", kNoFile}});
    write_history();
    for (std::size_t i = 0; i < report_.groups.size(); ++i) write_instance(i);
    xml_.close();
    return xml_.document();
  }

 private:
  using Attributes = std::vector<std::pair<const char*, std::string>>;

  void attributes(const Attributes& all) {
    for (const auto& [name, value] : all) xml_.attribute(name, value);
  }
  void element(const char* name, const Attributes& all) {
    xml_.open(name);
    attributes(all);
    xml_.close();
  }
  void text(const char* name, const std::string& value) {
    xml_.open(name);
    xml_.text(value);
    xml_.close();
  }
  void write_source(const char* name) {
    element(name, {{"file", kNoFile}, {"line", "1"}, {"inlineCount", "1"}});
  }

  void write_history() {
    for (std::size_t i = 0; i < origin_.files.size(); ++i) {
      element("historyNodes", {{"historyNodeId", std::to_string(i)},
                               {"logicalName", report_.scenario},
                               {"physicalName", origin_.files[i].generic_string()},
                               {"testStatus", "true"},
                               {"date", origin_.date},
                               {"toolCategory", "UCIS:Simulator"},
                               {"ucisVersion", "1.0"},
                               {"vendorId", "stride"},
                               {"vendorTool", "stride"},
                               {"vendorToolVersion", origin_.version}});
    }
  }

  void write_instance(std::size_t i) {
    const GroupReport& group = report_.groups[i];
    xml_.open("instanceCoverages");
    attributes({{"name", group.component},
                {"key", std::to_string(i)},
                {"instanceId", std::to_string(i)},
                {"moduleName", group.component}});
    write_source("id");
    xml_.open("covergroupCoverage");
    write_group(group);
    xml_.close();
    xml_.close();
  }

  void write_group(const GroupReport& group) {
    xml_.open("cgInstance");
    attributes({{"name", group.component}, {"key", "0"}});
    element("options", {{"weight", "1"}, {"goal", goal_text(group.goal)}, {"at_least", "1"}});
    xml_.open("cgId");
    attributes({{"cgName", group.component}, {"moduleName", group.component}});
    write_source("cginstSourceId");
    write_source("cgSourceId");
    xml_.close();
    for (const PointReport& point : group.points) {
      if (point.kind != Kind::Cross && !point.bins.empty()) write_point(point, group);
    }
    for (const PointReport& point : group.points) {
      if (point.kind == Kind::Cross && !point.bins.empty()) write_cross(point, group);
    }
    xml_.close();
  }

  /// UCIS has whole percentages only.
  static std::string goal_text(const std::optional<double>& goal) {
    return std::to_string(static_cast<int>(std::ceil(goal.value_or(100))));
  }

  void begin_point(const char* element_name, const PointReport& point, const GroupReport& group) {
    const std::string name = label(group, point);
    xml_.open(element_name);
    attributes({{"name", name}, {"key", "0"}});
    Attributes options{{"weight", point.percentage() ? "1" : "0"}, {"goal", "100"}};
    for (const ToldApart& apart : apart_) {
      if (apart.component != group.component || apart.point != name) continue;
      options.emplace_back("comment", fmt::format("{} of {}: {}", apart.runs,
                                                  core::counted(report_.runs, "run"), apart.why));
    }
    options.emplace_back("at_least", std::to_string(point.at_least));
    element("options", options);
  }
  static const char* type_of(const BinCount& bin) { return bin.is_ignored ? "ignore" : "bins"; }

  void write_point(const PointReport& point, const GroupReport& group) {
    begin_point("coverpoint", point, group);
    for (std::size_t i = 0; i < point.bins.size(); ++i) {
      const std::string number = std::to_string(i);
      xml_.open("coverpointBin");
      attributes({{"name", point.bins[i].name}, {"key", number}, {"type", type_of(point.bins[i])}});
      xml_.open("range");
      attributes({{"from", number}, {"to", number}});
      write_contents(point.bins[i]);
      xml_.close();
      xml_.close();
    }
    xml_.close();
  }

  void write_contents(const BinCount& bin) {
    element("contents", {{"coverageCount", std::to_string(bin.count)}});
  }

  void write_cross(const PointReport& point, const GroupReport& group) {
    std::vector<const PointReport*> parts;
    for (std::size_t i = 0; i < point.of.size(); ++i) {
      for (const PointReport& other : group.points) {
        const bool is_part =
            other.name == point.of[i] && other.definition == point.of_definitions[i];
        if (is_part) parts.push_back(&other);
      }
    }
    // a part without any bin is not in the document
    if (std::ranges::any_of(parts, [](const PointReport* part) { return part->bins.empty(); }))
      return;
    begin_point("cross", point, group);
    for (const std::string& part : part_labels(group, point)) text("crossExpr", part);
    for (std::size_t i = 0; i < point.bins.size(); ++i) {
      write_cross_bin(point.bins[i], i, parts);
    }
    xml_.close();
  }

  void write_cross_bin(const BinCount& bin, std::size_t number,
                       std::span<const PointReport* const> parts) {
    xml_.open("crossBin");
    attributes({{"name", bin.name}, {"key", std::to_string(number)}, {"type", type_of(bin)}});
    BinNumbers numbers;
    if (!find_numbers(bin.name, parts, numbers)) text("index", "-1");
    for (const std::size_t index : numbers) text("index", std::to_string(index));
    write_contents(bin);
    xml_.close();
  }

  const Report& report_;
  const UcisOrigin& origin_;
  const std::vector<ToldApart> apart_ = told_apart(report_);
  xml::Writer xml_;
};

}  // namespace

std::string ucis_document(const Report& report, const UcisOrigin& origin) {
  return UcisWriter(report, origin).document();
}

}  // namespace stride::coverage
