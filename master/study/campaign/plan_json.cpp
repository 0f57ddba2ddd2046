#include "master/study/campaign/plan_json.h"

#include <type_traits>

#include <nlohmann/json.hpp>

#include "master/base/files/sha256.h"
#include "master/base/time_text.h"
#include "master/study/campaign/intervention_parts.h"

namespace stride::campaign {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json limits_json(const Limits& limits) { return {limits.lower, limits.upper}; }

void add_limits(Json& json, const std::optional<Limits>& limits) {
  if (limits) json["limits"] = limits_json(*limits);
}

struct DistributionJson {
  Json operator()(const Uniform& law) const {
    return {{"type", "uniform"}, {"limits", limits_json(law.limits)}};
  }
  Json operator()(const Normal& law) const { return with_mean("normal", law); }
  Json operator()(const LogNormal& law) const { return with_mean("log-normal", law); }
  Json operator()(const Poisson& law) const {
    Json json{{"type", "poisson"}, {"mean", law.mean}};
    add_limits(json, law.limits);
    return json;
  }
  Json operator()(const Histogram& histogram) const {
    Json bins = Json::array();
    for (const auto& [limits, weight] : histogram.bins) {
      bins.push_back({{"limits", limits_json(limits)}, {"weight", weight}});
    }
    return {{"type", "histogram"}, {"bins", bins}};
  }
  Json operator()(const ProbabilitySet& set) const {
    Json elements = Json::array();
    for (const auto& [value, weight, where] : set.elements) {
      elements.push_back({{"value", value}, {"weight", weight}});
    }
    return {{"type", "set"}, {"elements", elements}};
  }

  template <class Law>
  static Json with_mean(const char* type, const Law& law) {
    Json json{{"type", type}, {"mean", law.mean}, {"variance", law.variance}};
    add_limits(json, law.limits);
    return json;
  }
};

/// Rows may be many, so their digest stands for them.
Json table_json(const ValueTable& table, const std::vector<PlanColumn>& columns) {
  core::Sha256 hash;
  for (const ValueTable::Row& row : table.rows) {
    Json values = Json::array();
    for (const Text& value : row.values) values.push_back(value ? Json(*value) : Json());
    hash.add(dumped(values));
  }
  Json names = Json::array();
  for (const std::size_t place : table.parameters) names.push_back(columns[place].parameter.name);
  return {
      {"parameters", names}, {"rows", table.rows.size()}, {"sha256", core::to_hex(hash.digest())}};
}

Json factor_json(const Factor& factor, const std::vector<PlanColumn>& columns) {
  if (const auto* const table = std::get_if<ValueTable>(&factor))
    return table_json(*table, columns);
  const auto& range = std::get<ValueRange>(factor);
  return {{"parameters", {columns[range.parameter].parameter.name}},
          {"rows", range.count},
          {"first", step_text(range.first, range.step, 0)},
          {"last", step_text(range.first, range.step, range.count - 1)}};
}

Json variation_json(const Plan& plan) {
  const Campaign& campaign = plan.campaign();
  if (const auto* const stochastic = std::get_if<Stochastic>(&campaign.variation)) {
    Json parameters = Json::array();
    for (const auto& [place, distribution, where] : stochastic->parameters) {
      parameters.push_back({{"parameter", campaign.parameters[place].name},
                            {"distribution", std::visit(DistributionJson{}, distribution)}});
    }
    return {{"type", "stochastic"},
            {"random_seed", campaign.random_seed},
            {"sampling", name(stochastic->method)},
            {"parameters", parameters}};
  }
  Json factors = Json::array();
  for (const Factor& factor : std::get<Deterministic>(campaign.variation).factors) {
    factors.push_back(factor_json(factor, plan.columns()));
  }
  return {{"type", "deterministic"}, {"factors", factors}};
}

Json declared_json(const Campaign& campaign) {
  Json json = Json::object();
  Json swaps = Json::array(), interventions = Json::array(), seeds = Json::array();
  for (const Swap& swap : campaign.swaps) {
    Json units = Json::array();
    for (const auto& alternative : swap.alternatives) units.push_back(alternative.name);
    swaps.push_back({{"name", swap.name}, {"component", swap.component}, {"units", units}});
  }
  for (const NamedIntervention& intervention : campaign.interventions) {
    const auto [option, value] = option_of(intervention.declared);
    interventions.push_back({{"name", intervention.name}, {"option", option}, {"value", value}});
  }
  for (const Parameter& seed : campaign.seeds) seeds.push_back(seed.name);
  return {{"swaps", swaps}, {"interventions", interventions}, {"seeds", seeds}};
}

Json kept_json(const Campaign& campaign) {
  Json aggregates = Json::array();
  for (const Aggregate& aggregate : campaign.aggregates) {
    Json json{{"name", aggregate.name},
              {"signal", aggregate.signal},
              {"function", name(aggregate.function)}};
    if (aggregate.function == Aggregate::Function::At) json["at"] = core::to_text(aggregate.at);
    aggregates.push_back(std::move(json));
  }
  Json json{
      {"results", name(campaign.keep.results)},
      {"every", campaign.keep.every},
      {"aggregates", aggregates},
      {"wall_time_limit", campaign.wall_time_limit ? Json(*campaign.wall_time_limit) : Json()}};
  // a campaign without captures is the one that it was before there were any
  for (const CapturedComponent& capture : campaign.captures) {
    json["captures"].push_back(capture.component);
  }
  return json;
}

Json inputs_json(const Fingerprints& fingerprints) {
  Json alternatives = Json::object();
  for (const auto& [names, digest] : fingerprints.alternatives) {
    alternatives[names.first][names.second] = digest;
  }
  return {
      {"files", fingerprints.files}, {"units", fingerprints.units}, {"alternatives", alternatives}};
}

/// All that the identity stands for.
Json content_json(const Plan& plan) {
  Json columns = Json::array();
  for (const PlanColumn& column : plan.columns()) columns.push_back(column.parameter.name);
  return {{"version", plan.fingerprints().version},
          {"cases", plan.size()},
          {"columns", columns},
          {"variation", variation_json(plan)},
          {"declared", declared_json(plan.campaign())},
          {"kept", kept_json(plan.campaign())},
          {"inputs", inputs_json(plan.fingerprints())}};
}

}  // namespace

std::string plan_identity(const Plan& plan) { return core::sha256(dumped(content_json(plan))); }

std::string plan_json(const Plan& plan, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const Campaign& campaign = plan.campaign();
  const fs::path file = fs::absolute(campaign.file).lexically_normal();
  const fs::path base = fs::absolute(folder).lexically_normal();
  Json json{{"identity", plan_identity(plan)},
            {"campaign", file.lexically_proximate(base).generic_string()},
            {"scenario",
             campaign.scenario.lexically_proximate(campaign.file.parent_path()).generic_string()}};
  json.update(content_json(plan));
  return dumped(json, 2) + "\n";
}

}  // namespace stride::campaign
