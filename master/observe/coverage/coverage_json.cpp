#include "master/observe/coverage/coverage_json.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/base/message_text.h"
#include "master/observe/coverage/told_apart.h"

namespace stride::coverage {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "stride coverage";
constexpr int kVersion = 1;

Json percentage_json(std::optional<double> percentage) {
  return percentage ? Json(*percentage) : Json();
}

Json bin_json(const BinCount& bin) {
  Json json = {{"name", bin.name}, {"count", bin.count}};
  if (bin.first) json["first"] = *bin.first;
  if (bin.in_case) json["case"] = *bin.in_case;
  if (bin.is_ignored) json["ignored"] = true;
  return json;
}

/// What goes without saying is left out: the place, and of how many runs it is.
Json point_json(const PointReport& point, std::size_t place, std::uint64_t runs) {
  Json json = {{"name", point.name}, {"definition", point.definition}, {"kind", name(point.kind)}};
  if (point.place != place) json["place"] = point.place;
  if (point.runs != runs) json["runs"] = point.runs;
  if (point.first_case) json["first_case"] = *point.first_case;
  if (point.kind == Kind::Cross) {
    json["of"] = point.of;
    json["of_definitions"] = point.of_definitions;
  } else {
    json["signal"] = point.signal;
    json["unit"] = point.unit;
  }
  json["at_least"] = point.at_least;
  json["open"] = point.is_open;
  if (point.declared != (point.is_open ? 0 : point.bins.size())) json["declared"] = point.declared;
  json["percentage"] = percentage_json(point.percentage());
  json["bins"] = Json::array();
  for (const BinCount& bin : point.bins) json["bins"].push_back(bin_json(bin));
  return json;
}

Json group_json(const GroupReport& group, std::size_t place, std::uint64_t runs) {
  Json json = {{"component", group.component}};
  if (group.place != place) json["place"] = group.place;
  if (group.goal) json["goal"] = *group.goal;
  json["percentage"] = percentage_json(group.percentage());
  json["points"] = Json::array();
  for (std::size_t i = 0; i < group.points.size(); ++i) {
    json["points"].push_back(point_json(group.points[i], i, runs));
  }
  return json;
}

Json told_apart_json(const ToldApart& point) {
  Json json = {{"component", point.component},
               {"point", point.point},
               {"definition", point.definition},
               {"runs", point.runs}};
  if (point.first_case) json["first_case"] = *point.first_case;
  json["why"] = point.why;
  return json;
}

[[noreturn]] void fail_value(const std::string& what) { throw std::invalid_argument(what); }

double number_of(const Json& json) {
  const double number = json.get<double>();
  if (!json.is_number() || !std::isfinite(number)) fail_value("expected a number");
  return number;
}

std::uint64_t count_of(const Json& json) {
  if (!json.is_number_unsigned()) fail_value("expected a whole number that is not negative");
  return json.get<std::uint64_t>();
}

BinCount bin_of(const Json& json) {
  BinCount bin{json.at("name").get<std::string>()};
  bin.count = count_of(json.at("count"));
  if (json.contains("first")) bin.first = number_of(json["first"]);
  if (json.contains("case")) bin.in_case = count_of(json["case"]);
  if (json.contains("ignored")) bin.is_ignored = json["ignored"].get<bool>();
  if (bin.first.has_value() != (bin.count > 0)) {
    fail_value(fmt::format("bin '{}': there is an instant without a visit, or none", bin.name));
  }
  if (bin.in_case && !bin.first) fail_value("there is a case without a visit");
  return bin;
}

std::uint64_t count_or(const Json& json, const char* key, std::uint64_t otherwise) {
  return json.contains(key) ? count_of(json[key]) : otherwise;
}

/// merge() relies on it.
void require_order(const PointReport& point) {
  for (std::size_t i = point.declared + 1; i < point.bins.size(); ++i) {
    if (bin_order(point.bins[i - 1].name, point.bins[i].name)) continue;
    fail_value(
        fmt::format("point '{}': bin '{}' is not in its place", point.name, point.bins[i].name));
  }
}

PointReport point_of(const Json& json, std::size_t place, std::uint64_t runs) {
  PointReport point{json.at("name").get<std::string>(), json.at("definition").get<std::string>()};
  point.place = count_or(json, "place", place);
  point.runs = count_or(json, "runs", runs);
  if (json.contains("first_case")) point.first_case = count_of(json["first_case"]);
  const std::string kind = json.at("kind").get<std::string>();
  const auto known = kind_of(kind);
  if (!known) fail_value(fmt::format("'{}' is no kind of a point", kind));
  point.kind = *known;
  if (point.kind == Kind::Cross) {
    point.of = json.at("of").get<std::vector<std::string>>();
    point.of_definitions = json.at("of_definitions").get<std::vector<std::string>>();
    if (point.of_definitions.size() != point.of.size()) {
      fail_value(fmt::format("point '{}': there are not as many definitions as parts", point.name));
    }
  } else {
    point.signal = json.at("signal").get<std::string>();
    point.unit = json.at("unit").get<std::string>();
  }
  point.at_least = count_of(json.at("at_least"));
  point.is_open = json.at("open").get<bool>();
  for (const Json& bin : json.at("bins")) point.bins.push_back(bin_of(bin));
  point.declared = count_or(json, "declared", point.is_open ? 0 : point.bins.size());
  if (point.declared > point.bins.size()) {
    fail_value(fmt::format("point '{}': more bins are declared than there are", point.name));
  }
  require_order(point);
  return point;
}

/// Each point once, of which the name and the definition tell it.
void add_point(GroupReport& group, PointReport point) {
  for (const PointReport& other : group.points) {
    if (other.name != point.name || other.definition != point.definition) continue;
    fail_value(fmt::format("'{}': point '{}' is there twice", group.component, point.name));
  }
  group.points.push_back(std::move(point));
}

GroupReport group_of(const Json& json, std::size_t place, std::uint64_t runs) {
  GroupReport group{json.at("component").get<std::string>()};
  group.place = count_or(json, "place", place);
  if (json.contains("goal")) group.goal = number_of(json["goal"]);
  for (const Json& point : json.at("points")) {
    add_point(group, point_of(point, group.points.size(), runs));
  }
  return group;
}

Report report_of(const Json& json) {
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
    fail_value("this is no coverage");
  }
  if (json.at("version") != kVersion) {
    fail_value(fmt::format("it is of another version than {}", kVersion));
  }
  Report report{json.at("scenario").get<std::string>(), json.at("definition").get<std::string>()};
  if (json.contains("cases")) report.cases = count_of(json["cases"]);
  report.runs = count_or(json, "runs", report.cases.value_or(1));
  for (const Json& group : json.at("groups")) {
    GroupReport read = group_of(group, report.groups.size(), report.runs);
    for (const GroupReport& other : report.groups) {
      if (other.component != read.component) continue;
      fail_value(fmt::format("the component '{}' is there twice", read.component));
    }
    report.groups.push_back(std::move(read));
  }
  return report;
}

}  // namespace

Json to_json(const Report& report) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"scenario", report.scenario},
               {"definition", report.definition}};
  if (report.cases) json["cases"] = *report.cases;
  if (report.runs != report.cases.value_or(1)) json["runs"] = report.runs;
  json["groups"] = Json::array();
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    json["groups"].push_back(group_json(report.groups[i], i, report.runs));
  }
  for (const ToldApart& point : told_apart(report)) {
    json["told_apart"].push_back(told_apart_json(point));
  }
  return json;
}

void write_coverage(const std::filesystem::path& file, const Report& report) {
  core::Replacement output(file);
  output.file().write(to_json(report).dump(1, ' ', false, Json::error_handler_t::replace));
  output.file().write('\n');
  output.commit();
}

Report read_coverage(const std::filesystem::path& file) {
  const std::string text = core::read_input(file);
  std::string what;
  try {
    return report_of(Json::parse(text));
  } catch (const Json::exception& mistake) {
    what = fmt::format("this is no coverage of stride: {}", core::message_text(mistake.what()));
  } catch (const std::invalid_argument& mistake) {
    what = mistake.what();
  }
  core::fail_input({.where = {file.string(), 0}}, what,
                   "name a coverage.json that 'stride run' or 'stride campaign' has written");
}

Json to_json(const CoveredBins& covered) {
  Json json = Json::object();
  for (const CoveredGroup& group : covered) {
    Json& of_group = json[group.component] = Json::object();
    for (const CoveredPoint& point : group.points) {
      Json& of_point = of_group[point.name] = Json::object();
      for (const CoveredBin& bin : point.bins) of_point[bin.name] = {bin.count, bin.first};
    }
  }
  return json;
}

CoveredBins covered_bins_of(const Json& json) {
  CoveredBins covered;
  for (const auto& [component, points] : json.items()) {
    CoveredGroup& group = covered.emplace_back(CoveredGroup{component});
    for (const auto& [name, bins] : points.items()) {
      CoveredPoint& point = group.points.emplace_back(CoveredPoint{name});
      for (const auto& [bin, visits] : bins.items()) {
        point.bins.push_back({bin, count_of(visits.at(0)), number_of(visits.at(1))});
      }
    }
  }
  return covered;
}

}  // namespace stride::coverage
