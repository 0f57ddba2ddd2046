#include "master/study/campaign/campaign_scenario.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "master/base/diagnostics.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"
#include "master/study/campaign/scenario_digests.h"
#include "master/system/declaration/find_variable.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::campaign {
namespace {

using Type = ValueKind::Type;

scenario::RunPlan load(const Campaign& campaign, std::vector<std::string> swaps,
                       std::shared_ptr<scenario::UnitStore> units) {
  if (!core::path_exists(campaign.scenario)) {
    core::fail_input({.where = campaign.scenario_where},
                     fmt::format("the scenario '{}' does not exist",
                                 core::name_text(campaign.scenario.string())),
                     "filepath is relative to the folder of the campaign");
  }
  scenario::ScenarioRequest request;
  request.scenario = campaign.scenario;
  request.swaps = std::move(swaps);
  request.units = std::move(units);
  return scenario::RunPlan(request);
}

Type type_of(const core::Variable& variable) {
  switch (variable.type) {
    case core::ValueType::Float64:
      return Type::Float64;
    case core::ValueType::Float32:
      return Type::Float32;
    case core::ValueType::Boolean:
    case core::ValueType::String:
    case core::ValueType::Binary:
    case core::ValueType::Enumeration:
    case core::ValueType::Clock:
      return Type::Text;
    default:
      return Type::Whole;
  }
}

double number_at(const core::ValueBlock& block, std::size_t element) {
  return core::visit(block, [&](auto values) {
    using T = typename decltype(values)::value_type;
    if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(values[element]);
    return std::numeric_limits<double>::quiet_NaN();
  });
}

/// Of a list; one of fewer words has the last one for all further elements.
std::string_view word_at(std::string_view list, std::size_t place) {
  const std::vector<std::string_view> words = xml::split(list);
  return words.empty() ? "" : words[std::min(place, words.size() - 1)];
}

bool is_number(Type type) { return type != Type::Text; }

/// The greatest whole number of the type; of Float64, that has no gap below it.
std::uint64_t greatest_whole(core::ValueType type) {
  switch (type) {
    case core::ValueType::Int8:
      return std::numeric_limits<std::int8_t>::max();
    case core::ValueType::UInt8:
      return std::numeric_limits<std::uint8_t>::max();
    case core::ValueType::Int16:
      return std::numeric_limits<std::int16_t>::max();
    case core::ValueType::UInt16:
      return std::numeric_limits<std::uint16_t>::max();
    case core::ValueType::Int32:
      return std::numeric_limits<std::int32_t>::max();
    case core::ValueType::UInt32:
      return std::numeric_limits<std::uint32_t>::max();
    case core::ValueType::Int64:
      return std::numeric_limits<std::int64_t>::max();
    case core::ValueType::UInt64:
      return std::numeric_limits<std::uint64_t>::max();
    case core::ValueType::Float32:
      return std::uint64_t{1} << 24;
    default:
      return std::uint64_t{1} << 53;
  }
}

/// A bound of the description, if it is a whole number.
std::uint64_t bound_or(const std::string& text, std::uint64_t otherwise) {
  double bound = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bound);
  if (text.empty() || error != std::errc() || std::isnan(bound) || bound < 1) return otherwise;
  return bound >= 0x1p63 ? otherwise : static_cast<std::uint64_t>(bound);
}

/// The parameters, whose values tell them apart where they end.
std::vector<ssp::ParameterValue> marked(const std::vector<PlanColumn>& columns) {
  std::vector<ssp::ParameterValue> values;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].role != PlanColumn::Role::Start) continue;
    ssp::ParameterValue& value = values.emplace_back();
    value.name = columns[i].parameter.name;
    value.value = std::to_string(i);
    value.where = columns[i].parameter.where;
    value.is_required = true;
  }
  return values;
}

bool is_same_place(const core::Location& a, const core::Location& b) {
  return a.file == b.file && a.line == b.line;
}

}  // namespace

CampaignScenario::CampaignScenario(const Campaign& campaign, const std::string& version,
                                   scenario::UnitStore units)
    : units_(std::make_shared<scenario::UnitStore>(std::move(units))),
      loaded_(load(campaign, {}, units_)) {
  for (const core::Component& component : loaded_.system().components()) {
    names_.add(component.name, component.description);
  }
  const std::vector<PlanColumn> columns = plan_columns(campaign);
  check_names(campaign);
  find_start_targets(campaign, columns);
  check_effects(columns);
  find_kinds(campaign, columns);
  check_aggregates(campaign);
  check_captures(campaign);
  load_alternatives(campaign);
  fingerprints_.version = version;
  take_fingerprints(campaign);
}

void CampaignScenario::check_names(const Campaign& campaign) const {
  const std::vector<std::string> components = loaded_.component_names();
  const auto refuse_component = [&](const auto& declared, const char* what) {
    if (!names_.component(declared.name)) return;
    core::fail_input({.where = declared.where},
                     fmt::format("a component of the scenario has the name of the {} '{}'", what,
                                 core::name_text(declared.name)),
                     "choose another name");
  };
  for (const NamedIntervention& declared : campaign.interventions) {
    refuse_component(declared, "intervention");
  }
  for (const Swap& swap : campaign.swaps) {
    refuse_component(swap, "swap");
    if (names_.component(swap.component)) continue;
    core::fail_input({.where = swap.where},
                     fmt::format("there is no component '{}'", core::name_text(swap.component)),
                     core::suggestion(swap.component, components));
  }
}

/// By reading the scenario again, with the parameters bound to it as `--set` binds them.
void CampaignScenario::find_start_targets(const Campaign& campaign,
                                          const std::vector<PlanColumn>& columns) {
  const scenario::Scenario read = scenario::read_scenario(
      campaign.scenario, {scenario::find_unit, marked(columns), loaded_.scenario().files});
  for (const core::StartDeclaration& declared : read.system.start_values) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].role != PlanColumn::Role::Start || declared.value != std::to_string(i) ||
          !is_same_place(declared.where, columns[i].parameter.where)) {
        continue;
      }
      targets_.push_back({i, declared});
      targets_.back().declaration.group = 0;
      targets_.back().declaration.rank = 0;  // many of its values are checked at once
    }
  }
  // unknown variables are what a system complains of before it looks at the values
  core::SystemDeclaration system = loaded_.scenario().system;
  core::Diagnostics diagnostics;
  for (const StartTarget& target : targets_) {
    if (!elements_of(target.column).empty()) continue;
    system.start_values = {target.declaration};
    diagnostics.attempt([&] { const core::System checked(system); });
  }
  diagnostics.raise();
}

/// None where a name is unknown.
std::vector<core::ConnectorElements> CampaignScenario::elements_of(std::size_t column) const {
  std::vector<core::ConnectorElements> found;
  for (const StartTarget& target : targets_) {
    if (target.column != column) continue;
    const core::StartDeclaration& declared = target.declaration;
    const auto component = names_.component(declared.component);
    if (!component) return {};
    const core::Context context{declared.where, declared.component, declared.variable, {}};
    auto elements = core::find_elements(
        names_, *component, *loaded_.system().components()[*component].description, context);
    if (!elements) return {};
    found.push_back(std::move(*elements));
  }
  return found;
}

std::optional<double> CampaignScenario::scenario_value(std::size_t column) const {
  if (!is_number(kinds_[column].type)) return std::nullopt;
  const auto is_direct = [&](const StartTarget& target) {
    const core::StartDeclaration& declared = target.declaration;
    return declared.via.empty() && declared.unit.name.empty();
  };
  for (const StartTarget& target : targets_) {
    if (target.column == column && !is_direct(target)) return std::nullopt;
  }
  const auto elements = elements_of(column);
  if (elements.size() != 1 || elements.front().size() != 1) return std::nullopt;
  const core::ElementRange& element = elements.front().parts.front();
  for (const core::StartValue& start : loaded_.system().start_values()) {
    if (loaded_.system().value_owner(start.id) != loaded_.system().value_owner(element.id))
      continue;
    if (std::ranges::count(start.kept, element.first) > 0) continue;
    return number_at(start.value, element.first);
  }
  return number_of(word_at(loaded_.system().variable(element.id).start, element.first));
}

std::string CampaignScenario::unit_of_measure(std::size_t column) const {
  for (const StartTarget& target : targets_) {
    if (target.column != column) continue;
    const auto elements = elements_of(column);
    return loaded_.system().start_unit(target.declaration, elements.front().parts.front()).name;
  }
  return "";
}

/// A source replaces a start value, and one of two values for a variable the other.
void CampaignScenario::check_effects(const std::vector<PlanColumn>& columns) const {
  const core::System& system = loaded_.system();
  std::vector<std::pair<core::ElementRange, std::size_t>> taken;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Parameter& parameter = columns[i].parameter;
    for (const core::ConnectorElements& elements : elements_of(i)) {
      for (const core::ElementRange& part : elements.parts) {
        for (const core::Connection& connection : system.connections_to(part.id)) {
          if (!connection.target().overlaps(part)) continue;
          core::fail_input(
              {.where = parameter.where},
              fmt::format("'{}' is connected to '{}', whose value replaces this one, "
                          "so it has no effect",
                          core::name_text(parameter.name), system.range_name(connection.source())),
              "force it for some time: <stride:Force> in a <stride:Intervention>");
        }
        for (const auto& [other, column] : taken) {
          const bool is_alias =
              system.value_owner(other.id) == system.value_owner(part.id) && other.id != part.id;
          if (column == i || !(is_alias || other.overlaps(part))) continue;
          core::fail_input({.where = parameter.where},
                           fmt::format("'{}' and '{}' are two sources for one variable",
                                       core::name_text(columns[column].parameter.name),
                                       core::name_text(parameter.name)),
                           "leave one of them out");
        }
        taken.emplace_back(part, i);
      }
    }
  }
}

ValueKind CampaignScenario::start_kind(std::size_t column) const {
  const auto elements = elements_of(column);
  if (elements.empty()) return {.type = Type::Text};
  const core::Variable& variable = loaded_.system().variable(elements.front().parts.front().id);
  const bool is_array = elements.front().size() != 1;
  return {.type = is_array ? Type::Text : type_of(variable),
          .variable_type = core::name(variable.type),
          .is_array = is_array};
}

ValueKind CampaignScenario::part_kind(const NamedIntervention& intervention,
                                      const std::string& part) const {
  if (part == "at" || part == "from" || part == "until" || part == "time") {
    return {.type = Type::Instant};
  }
  if (part == "bits" || part == "header" || part == "seed") return {.type = Type::Whole};
  if (part != "value") return {.type = Type::Text};
  const core::VariableId id = scenario::find_variable(
      loaded_.system(), intervention.declared.variable, intervention.declared.where,
      "a variable of a component", [](const auto&, const auto&) { return true; });
  const core::Variable& variable = loaded_.system().variable(id);
  return {.type = variable.size == 1 ? type_of(variable) : Type::Text};
}

ValueKind CampaignScenario::seed_kind(std::size_t column, const Parameter& seed) const {
  ValueKind kind = start_kind(column);
  if (!is_number(kind.type)) {
    core::fail_input(
        {.where = seed.where},
        fmt::format("'{}' is not a number, so it can be no seed", core::name_text(seed.name)));
  }
  const core::VariableId id = elements_of(column).front().parts.front().id;
  const core::Variable& variable = loaded_.system().variable(id);
  kind.least_seed = bound_or(variable.min, kind.least_seed);
  const std::uint64_t most = greatest_whole(variable.type);
  kind.most_seed = std::max(kind.least_seed, std::min(most, bound_or(variable.max, most)));
  return kind;
}

void CampaignScenario::find_kinds(const Campaign& campaign,
                                  const std::vector<PlanColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const PlanColumn& column = columns[i];
    if (column.role == PlanColumn::Role::Swap) {
      kinds_.push_back({.type = Type::Text});
    } else if (column.role == PlanColumn::Role::Intervention) {
      kinds_.push_back(part_kind(campaign.interventions[column.item], column.part));
    } else if (i < campaign.parameters.size()) {
      kinds_.push_back(start_kind(i));
    } else {
      kinds_.push_back(seed_kind(i, column.parameter));
    }
  }
}

/// A signal that is recorded, or could be, and has numbers.
void CampaignScenario::check_aggregates(const Campaign& campaign) const {
  const core::System& system = loaded_.system();
  for (const Aggregate& aggregate : campaign.aggregates) {
    const auto has_numbers = [&](const core::UnitDescription&, const core::Variable& variable) {
      return variable.size == 1 && variable.is_unclocked_value() &&
             (is_number(type_of(variable)) || variable.type == core::ValueType::Boolean);
    };
    scenario::find_variable(system, aggregate.signal, aggregate.where, "a signal with a number",
                            has_numbers);
    const core::RunOptions& options = loaded_.options();
    if (aggregate.function != Aggregate::Function::At ||
        (options.start <= aggregate.at && aggregate.at <= options.stop)) {
      continue;
    }
    core::fail_input(
        {.where = aggregate.where},
        fmt::format("{} s is outside of the run, from {} s to {} s", core::to_text(aggregate.at),
                    core::to_text(options.start), core::to_text(options.stop)));
  }
}

void CampaignScenario::check_captures(const Campaign& campaign) const {
  for (const CapturedComponent& capture : campaign.captures) {
    if (!names_.component(capture.component)) {
      core::fail_input(
          {.where = capture.where},
          fmt::format("there is no component '{}'", core::name_text(capture.component)),
          core::suggestion(capture.component, loaded_.component_names()));
    }
    if (!loaded_.options().sets_inputs_in_steps()) continue;
    core::fail_input({.where = capture.where},
                     "inputs of this scenario change within a step, which cannot be captured",
                     "let it have coupling=\"jacobi\" and extrapolation=\"hold\"");
  }
}

void CampaignScenario::load_alternatives(const Campaign& campaign) {
  for (std::size_t i = 0; i < campaign.swaps.size(); ++i) {
    const Swap& swap = campaign.swaps[i];
    for (const auto& [name, file, where] : swap.alternatives) {
      if (file.empty()) continue;
      scenario::find_unit(file, where);
      alternatives_.push_back(
          {i, name, load(campaign, {swap.component + "=" + file.string()}, units_)});
    }
  }
}

void CampaignScenario::take_fingerprints(const Campaign& campaign) {
  fingerprints_.files = scenario_digests(loaded_.scenario(), digests_);
  const auto& components = loaded_.system().components();
  for (std::size_t i = 0; i < components.size(); ++i) {
    fingerprints_.units[components[i].name] = unit_digest(loaded_, i, digests_);
  }
  for (const LoadedAlternative& alternative : alternatives_) {
    const Swap& swap = campaign.swaps[alternative.swap];
    fingerprints_.alternatives[{swap.name, alternative.name}] =
        unit_digest(alternative.loaded, names_.component(swap.component).value(), digests_);
  }
}

}  // namespace stride::campaign
