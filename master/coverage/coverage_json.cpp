#include "master/coverage/coverage_json.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/util/error.h"
#include "master/util/input_file.h"
#include "master/util/message_text.h"
#include "master/util/replacement.h"

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

Json point_json(const PointReport& point) {
  Json json = {{"name", point.name}, {"kind", name(point.kind)}};
  if (point.kind == Kind::Cross) {
    json["of"] = point.of;
  } else {
    json["signal"] = point.signal;
    json["unit"] = point.unit;
  }
  json["at_least"] = point.at_least;
  json["open"] = point.is_open;
  json["percentage"] = percentage_json(point.percentage());
  json["bins"] = Json::array();
  for (const BinCount& bin : point.bins) json["bins"].push_back(bin_json(bin));
  return json;
}

Json group_json(const GroupReport& group) {
  Json json = {{"component", group.component}};
  if (group.goal) json["goal"] = *group.goal;
  json["percentage"] = percentage_json(group.percentage());
  json["points"] = Json::array();
  for (const PointReport& point : group.points) json["points"].push_back(point_json(point));
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

PointReport point_of(const Json& json) {
  PointReport point{json.at("name").get<std::string>()};
  const std::string kind = json.at("kind").get<std::string>();
  const auto known = kind_of(kind);
  if (!known) fail_value(fmt::format("'{}' is no kind of a point", kind));
  point.kind = *known;
  if (point.kind == Kind::Cross) {
    point.of = json.at("of").get<std::vector<std::string>>();
  } else {
    point.signal = json.at("signal").get<std::string>();
    point.unit = json.at("unit").get<std::string>();
  }
  point.at_least = count_of(json.at("at_least"));
  point.is_open = json.at("open").get<bool>();
  for (const Json& bin : json.at("bins")) point.bins.push_back(bin_of(bin));
  return point;
}

GroupReport group_of(const Json& json) {
  GroupReport group{json.at("component").get<std::string>()};
  if (json.contains("goal")) group.goal = number_of(json["goal"]);
  for (const Json& point : json.at("points")) group.points.push_back(point_of(point));
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
  for (const Json& group : json.at("groups")) report.groups.push_back(group_of(group));
  return report;
}

}  // namespace

Json to_json(const Report& report) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"scenario", report.scenario},
               {"definition", report.definition}};
  if (report.cases) json["cases"] = *report.cases;
  json["groups"] = Json::array();
  for (const GroupReport& group : report.groups) json["groups"].push_back(group_json(group));
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
