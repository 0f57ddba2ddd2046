#include "master/study/campaign/cases/case_record.h"

#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "master/observe/coverage/coverage_json.h"

namespace stride::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kOutcomes{Outcome::Passed, Outcome::Failed, Outcome::Error, Outcome::Crashed,
                               Outcome::TimedOut};

/// JSON has no infinity and no NaN.
Json number_json(std::optional<double> number) {
  if (!number) return {};
  if (std::isfinite(*number)) return *number;
  if (std::isnan(*number)) return "nan";
  return *number > 0 ? "inf" : "-inf";
}

std::optional<double> number_if_any(const Json& json) {
  if (json.is_null()) return std::nullopt;
  if (json.is_number()) return json.get<double>();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return text == "inf" ? kInfinity : -kInfinity;
}

Json margin_json(const std::optional<CaseMargin>& margin) {
  if (!margin) return {};
  return {{"value", number_json(margin->value)}, {"unit", margin->unit}, {"at", margin->at}};
}

std::optional<CaseMargin> margin_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return CaseMargin{number_if_any(json.at("value")).value(), json.at("unit"), json.at("at")};
}

/// What is known of a case beforehand.
Json case_json(const Plan& plan, const Case& row) {
  Json values = Json::object();
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    values[plan.columns()[i].parameter.name] = row.values[i] ? Json(*row.values[i]) : Json();
  }
  return {{"case", row.index}, {"values", values}, {"seed", row.seed}};
}

Json verdicts_json(const std::vector<CaseVerdict>& verdicts) {
  Json json = Json::array();
  for (const CaseVerdict& verdict : verdicts) {
    json.push_back({{"name", verdict.name},
                    {"kind", verdict.kind},
                    {"verdict", verdict_name(verdict.passed)},
                    {"text", verdict.text},
                    {"time", number_json(verdict.time)},
                    {"margin", margin_json(verdict.margin)}});
  }
  return json;
}

Json aggregates_json(const Campaign& campaign, const CaseResult& result) {
  Json json = Json::object();
  for (std::size_t i = 0; i < campaign.aggregates.size(); ++i) {
    json[campaign.aggregates[i].name] =
        i < result.aggregates.size() ? number_json(result.aggregates[i]) : Json();
  }
  return json;
}

std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Outcome outcome_of(const std::string& text) {
  for (const Outcome outcome : kOutcomes) {
    if (text == name(outcome)) return outcome;
  }
  throw std::invalid_argument(text);
}

std::optional<bool> passed_of(const std::string& text) {
  if (text == verdict_name(true)) return true;
  if (text == verdict_name(false)) return false;
  return std::nullopt;
}

CaseResult result_of(const Plan& plan, const Json& json) {
  CaseResult result;
  result.outcome = outcome_of(json.at("outcome"));
  result.reason = json.at("reason");
  for (const Json& verdict : json.at("checks")) {
    result.verdicts.push_back({verdict.at("name"), verdict.at("kind"),
                               passed_of(verdict.at("verdict")), verdict.at("text"),
                               number_if_any(verdict.at("time")), margin_of(verdict.at("margin"))});
  }
  for (const Aggregate& aggregate : plan.campaign().aggregates) {
    result.aggregates.push_back(number_if_any(json.at("aggregates").at(aggregate.name)));
  }
  if (json.contains("coverage")) {
    result.coverage = {json.at("coverage_definition"),
                       coverage::covered_bins_of(json.at("coverage"))};
  }
  result.reached = number_if_any(json.at("reached"));
  result.has_results = json.at("results");
  result.wall_time = json.at("wall_time");
  result.began = json.at("began");
  result.host = json.at("host");
  return result;
}

}  // namespace

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::Passed:
      return "passed";
    case Outcome::Failed:
      return "failed";
    case Outcome::Error:
      return "error";
    case Outcome::Crashed:
      return "crashed";
    case Outcome::TimedOut:
      break;
  }
  return "timed out";
}

const char* verdict_name(std::optional<bool> passed) {
  if (!passed) return "undecided";
  return *passed ? "passed" : "failed";
}

std::vector<CaseVerdict> case_verdicts(const std::vector<core::Verdict>& verdicts) {
  std::vector<CaseVerdict> made;
  for (const core::Verdict& verdict : verdicts) {
    CaseVerdict& added = made.emplace_back();
    added.name = verdict.name;
    added.kind = verdict.kind;
    added.passed = verdict.passed;
    added.text = verdict.text;
    if (verdict.time) added.time = to_seconds(*verdict.time);
    if (!verdict.margin) continue;
    added.margin = {verdict.margin->value, verdict.margin->unit, to_seconds(verdict.margin->at)};
  }
  return made;
}

std::string record_line(const Plan& plan, const Case& row, const CaseResult& result) {
  Json json = case_json(plan, row);
  json["outcome"] = name(result.outcome);
  json["reason"] = result.reason;
  json["checks"] = verdicts_json(result.verdicts);
  json["aggregates"] = aggregates_json(plan.campaign(), result);
  if (result.coverage) {
    json["coverage"] = coverage::to_json(result.coverage->bins);
    json["coverage_definition"] = result.coverage->definition;
  }
  json["reached"] = number_json(result.reached);
  json["results"] = result.has_results;
  json["hash"] = plan.hash(row);
  json["wall_time"] = result.wall_time;
  json["began"] = result.began;
  json["host"] = result.host;
  return json_line(json);
}

std::string missing_line(const Plan& plan, const Case& row) {
  Json json = case_json(plan, row);
  json["outcome"] = "missing";
  json["hash"] = plan.hash(row);
  return json_line(json);
}

std::optional<CaseResult> parse_record(const Plan& plan, std::uint64_t index,
                                       std::string_view line) {
  try {
    const Json json = Json::parse(line);
    if (json.at("case") != index || json.at("hash") != plan.hash(plan.at(index))) {
      return std::nullopt;
    }
    return result_of(plan, json);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace stride::campaign
