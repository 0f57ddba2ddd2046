#include "master/study/campaign/plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/files/sha256.h"
#include "master/base/message_text.h"
#include "master/base/text/boolean_text.h"
#include "master/base/text/suggest.h"
#include "master/observe/recorders/provenance.h"
#include "master/study/campaign/intervention_parts.h"
#include "master/study/campaign/random.h"

namespace stride::campaign {
namespace {

using Role = PlanColumn::Role;

/// Of cases.csv, beside those of each plan.
constexpr std::string_view kColumnsOfResults[] = {"outcome",   "reason", "reached",
                                                  "wall_time", "began",  "host"};
constexpr std::string_view kPrefixesOfResults[] = {"check", "margin", "verdict", "aggregate"};

void refuse_column_of_results(const Parameter& parameter) {
  const std::string prefix = parameter.name.substr(0, parameter.name.find(':'));
  const bool has_prefix =
      prefix.size() != parameter.name.size() &&
      std::ranges::find(kPrefixesOfResults, prefix) != std::end(kPrefixesOfResults);
  const bool is_taken =
      std::ranges::find(kColumnsOfResults, parameter.name) != std::end(kColumnsOfResults);
  if (!has_prefix && !is_taken) return;
  core::fail_input(
      {.where = parameter.where},
      fmt::format("'{}' is the name of a column that a table of cases may have", parameter.name),
      "choose another name");
}

PlanColumn column_of(const Campaign& campaign, const Parameter& parameter) {
  refuse_column_of_results(parameter);
  for (std::size_t i = 0; i < campaign.swaps.size(); ++i) {
    if (campaign.swaps[i].name == parameter.name) return {parameter, Role::Swap, i, {}};
  }
  const std::size_t dot = parameter.name.rfind('.');
  for (std::size_t i = 0; dot != std::string::npos && i < campaign.interventions.size(); ++i) {
    const NamedIntervention& intervention = campaign.interventions[i];
    if (intervention.name != parameter.name.substr(0, dot)) continue;
    const std::string part = parameter.name.substr(dot + 1);
    const std::vector<std::string> parts = parts_of(intervention.declared.kind);
    if (std::ranges::find(parts, part) == parts.end()) {
      core::fail_input({.where = parameter.where},
                       fmt::format("the intervention '{}' has no '{}'", intervention.name,
                                   core::name_text(part)),
                       core::suggestion(part, parts));
    }
    return {parameter, Role::Intervention, i, part};
  }
  return {parameter, Role::Start, 0, {}};
}

[[noreturn]] void fail_size(const Campaign& campaign, const std::string& count) {
  core::fail_input(
      {.where = {campaign.file.string(), 0}},
      fmt::format("the campaign has {} cases, which is more than {}", count, Plan::kMostCases));
}

std::uint64_t count_cases(const Campaign& campaign) {
  if (const auto* const stochastic = std::get_if<Stochastic>(&campaign.variation)) {
    if (stochastic->runs > Plan::kMostCases) fail_size(campaign, std::to_string(stochastic->runs));
    return stochastic->runs;
  }
  std::uint64_t count = 1;
  for (const Factor& factor : std::get<Deterministic>(campaign.variation).factors) {
    if (__builtin_mul_overflow(count, size_of(factor), &count)) fail_size(campaign, "2^64 or more");
    if (count > Plan::kMostCases) fail_size(campaign, fmt::format("{} or more", count));
  }
  return count;
}

/// Limits are numbers of 64 bits with a point, of which those are all whole numbers.
void check_whole_limits(const StochasticParameter& drawn, const Limits& limits) {
  constexpr double kMost = 9007199254740992;  // 2^53
  if (std::abs(limits.lower) < kMost && std::abs(limits.upper) < kMost) return;
  core::fail_input({.where = drawn.where}, "whole numbers from 2^53 on cannot be drawn with limits",
                   "use limits below that, or <stride:Seed> for a seed");
}

/// A number is drawn for what is one.
void check_kind(const StochasticParameter& drawn, const Parameter& parameter,
                const ValueKind& kind) {
  const core::Context context{.where = drawn.where};
  const bool is_of_texts = std::holds_alternative<ProbabilitySet>(drawn.distribution);
  if (kind.type == ValueKind::Type::Text && !is_of_texts) {
    core::fail_input(context,
                     fmt::format("'{}' is not a number, so none can be drawn for it",
                                 core::name_text(parameter.name)),
                     "list its values in a <ProbabilityDistributionSet>");
  }
  if (kind.type != ValueKind::Type::Whole) return;
  if (const auto* const histogram = std::get_if<Histogram>(&drawn.distribution)) {
    for (const Histogram::Bin& bin : histogram->bins) check_whole_limits(drawn, bin.limits);
  }
  const auto* const uniform = std::get_if<Uniform>(&drawn.distribution);
  if (uniform == nullptr) return;
  check_whole_limits(drawn, uniform->limits);
  const auto [lower, upper] = uniform->limits;
  if (std::ceil(lower) <= std::floor(upper)) return;
  core::fail_input(context, fmt::format("there is no whole number from {} to {} for '{}'", lower,
                                        upper, core::name_text(parameter.name)));
}

std::vector<std::string> drawn_names(const Campaign& campaign) {
  std::vector<std::string> names;
  if (const auto* const stochastic = std::get_if<Stochastic>(&campaign.variation)) {
    for (const StochasticParameter& drawn : stochastic->parameters) {
      names.push_back(campaign.parameters[drawn.parameter].name);
    }
  }
  return names;
}

SamplingMethod method_of(const Campaign& campaign) {
  const auto* const stochastic = std::get_if<Stochastic>(&campaign.variation);
  return stochastic != nullptr ? stochastic->method : SamplingMethod::Independent;
}

}  // namespace

std::vector<PlanColumn> plan_columns(const Campaign& campaign) {
  std::vector<PlanColumn> columns;
  for (const Parameter& parameter : campaign.parameters) {
    columns.push_back(column_of(campaign, parameter));
  }
  for (const Parameter& seed : campaign.seeds) columns.push_back({seed, Role::Start, 0, {}});
  return columns;
}

Plan::Plan(Campaign campaign, std::vector<ValueKind> kinds, Fingerprints fingerprints)
    : campaign_(std::move(campaign)),
      columns_(plan_columns(campaign_)),
      kinds_(std::move(kinds)),
      fingerprints_(std::move(fingerprints)),
      key_(std::bit_cast<std::uint64_t>(campaign_.random_seed + 0.0)),  // which has no -0
      size_(count_cases(campaign_)),
      sampling_(method_of(campaign_), key_, drawn_names(campaign_), size_) {
  const auto* const stochastic = std::get_if<Stochastic>(&campaign_.variation);
  if (stochastic == nullptr) return;
  for (const StochasticParameter& drawn : stochastic->parameters) {
    check_kind(drawn, campaign_.parameters[drawn.parameter], kinds_[drawn.parameter]);
  }
}

Case Plan::at(std::uint64_t index) const {
  Case row{index, std::vector<Text>(columns_.size()), RandomStream(key_, "case").bits(index)};
  if (const auto* const stochastic = std::get_if<Stochastic>(&campaign_.variation)) {
    add_draws(*stochastic, row);
  } else {
    add_combination(std::get<Deterministic>(campaign_.variation), row);
  }
  for (std::size_t i = campaign_.parameters.size(); i < columns_.size(); ++i) {
    const RandomStream stream(row.seed, "seed " + columns_[i].parameter.name);
    row.values[i] = seed_text(kinds_[i], stream.bits(0));
  }
  return row;
}

void Plan::add_combination(const Deterministic& variation, Case& row) const {
  std::uint64_t rest = row.index;
  for (auto factor = variation.factors.rbegin(); factor != variation.factors.rend(); ++factor) {
    const std::uint64_t size = size_of(*factor);
    const std::uint64_t place = rest % size;
    rest /= size;
    if (const auto* const range = std::get_if<ValueRange>(&*factor)) {
      row.values[range->parameter] = step_text(range->first, range->step, place);
      continue;
    }
    const ValueTable& table = std::get<ValueTable>(*factor);
    for (std::size_t i = 0; i < table.parameters.size(); ++i) {
      row.values[table.parameters[i]] = table.rows[place].values[i];
    }
  }
}

void Plan::add_draws(const Stochastic& variation, Case& row) const {
  const std::vector<double> point = sampling_.point(row.index);
  for (std::size_t i = 0; i < variation.parameters.size(); ++i) {
    const auto& [parameter, distribution, where] = variation.parameters[i];
    row.values[parameter] = drawn_text(kinds_[parameter], distribution, point[i]);
  }
}

/// Null where the scenario's own unit is in its place.
const Swap::Alternative* Plan::alternative(const Case& row, std::size_t column) const {
  if (columns_[column].role != Role::Swap || !row.values[column]) return nullptr;
  const auto& alternatives = campaign_.swaps[columns_[column].item].alternatives;
  const auto found = std::ranges::find(alternatives, *row.values[column], &Swap::Alternative::name);
  return found == alternatives.end() || found->file.empty() ? nullptr : &*found;
}

std::vector<scenario::InterventionDeclaration> Plan::interventions(const Case& row) const {
  std::vector<scenario::InterventionDeclaration> declared;
  std::vector<bool> is_enabled(campaign_.interventions.size(), true);
  for (const auto& named : campaign_.interventions) declared.push_back(named.declared);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const PlanColumn& column = columns_[i];
    if (column.role != Role::Intervention || !row.values[i]) continue;
    const std::string& text = *row.values[i];
    try {
      if (column.part != kEnabledPart) {
        set_part(declared[column.item], column.part, text);
        continue;
      }
      const auto enabled = core::boolean_of(text);
      if (!enabled)
        throw std::invalid_argument(fmt::format("'{}' is neither true nor false", text));
      is_enabled[column.item] = *enabled;
    } catch (const std::invalid_argument& mistake) {
      core::fail_input(
          {.where = column.parameter.where},
          fmt::format("'{}' of case {}: {}", column.parameter.name, row.index, mistake.what()));
    }
  }
  std::vector<scenario::InterventionDeclaration> made;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    if (is_enabled[i]) made.push_back(std::move(declared[i]));
  }
  return made;
}

scenario::ScenarioRequest Plan::request(const Case& row) const {
  scenario::ScenarioRequest request;
  request.scenario = campaign_.scenario;
  request.interventions = interventions(row);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const PlanColumn& column = columns_[i];
    if (const Swap::Alternative* const unit = alternative(row, i)) {
      request.swaps.push_back(campaign_.swaps[column.item].component + "=" + unit->file.string());
    }
    if (column.role != Role::Start || !row.values[i]) continue;
    ssp::ParameterValue& value = request.parameters.emplace_back();
    value.name = column.parameter.name;
    value.value = *row.values[i];
    value.where = column.parameter.where;
    value.is_required = true;
  }
  return request;
}

std::vector<std::string> Plan::words(const Case& row) const {
  const scenario::ScenarioRequest wanted = request(row);
  std::vector<std::string> words{"run", wanted.scenario.string()};
  const auto add = [&](const std::string& option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  for (const std::string& swap : wanted.swaps) add("--swap", swap);
  for (const auto& value : wanted.parameters) add("--set", value.name + "=" + value.value);
  for (const auto& declared : wanted.interventions) {
    const auto [option, value] = option_of(declared);
    add(option, value);
  }
  return words;
}

std::string Plan::command(const Case& row) const { return recorders::shell_text(words(row)); }

std::string Plan::hash(const Case& row) const {
  const scenario::ScenarioRequest wanted = request(row);
  nlohmann::json units = fingerprints_.units;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Swap::Alternative* const unit = alternative(row, i);
    if (unit == nullptr) continue;
    const Swap& swap = campaign_.swaps[columns_[i].item];
    units[swap.component] = fingerprints_.alternatives.at({swap.name, unit->name});
  }
  nlohmann::json settings = nlohmann::json::array();
  for (const auto& value : wanted.parameters) settings.push_back({value.name, value.value});
  for (const auto& declared : wanted.interventions) {
    const auto [option, value] = option_of(declared);
    settings.push_back({option, value});
  }
  const nlohmann::json all{fingerprints_.version, fingerprints_.files, units, settings};
  return core::sha256(all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace stride::campaign
