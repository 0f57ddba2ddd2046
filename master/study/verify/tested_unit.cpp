#include "master/study/verify/tested_unit.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/model/system/known_names.h"

namespace stride::verify {
namespace {

using core::Causality;
using core::ValueType;
using core::Variable;

constexpr Duration kDefaultStep = std::chrono::milliseconds(1);
constexpr std::int64_t kDefaultSteps = 200;
constexpr std::int64_t kMostSimulatedSteps = 1000;
/// Values that are kept of one run, so that a unit with many variables is not verified for ever.
constexpr std::int64_t kMostValues = 500'000;
constexpr std::int64_t kFewestSteps = 20;

bool is_observed(const Variable& variable) {
  if (!variable.is_unclocked_value()) return false;
  return variable.causality == Causality::Output || variable.causality == Causality::Local ||
         variable.causality == Causality::CalculatedParameter;
}

/// The name in FMI 1.0 of a function that both later versions have.
std::string fmi1_name(const std::string& name) {
  if (name == "EnterInitializationMode") return "InitializeSlave";
  return name == "Reset" || name == "Terminate" ? name + "Slave" : name;
}

core::SystemDeclaration declaration(const VerifyRequest& request, const importer::Fmu& fmu) {
  core::SystemDeclaration system{"verify", {}, {}, {}};
  system.components.push_back({"unit", fmu.description(), {}, {}});
  core::KnownNames names;
  names.add("", *fmu.description());
  for (const std::string& text : request.settings) {
    const auto [variable, value] = names.split("--set", text, false);
    if (!value || variable.empty()) {
      core::fail_input({}, fmt::format("--set {}: expected variable=value", text));
    }
    system.start_values.push_back({.component = "unit",
                                   .variable = variable,
                                   .value = *value,
                                   .unit = {},
                                   .where = {fmt::format("--set {}", text), 0}});
  }
  return system;
}

}  // namespace

TestedUnit::TestedUnit(VerifyRequest request) : request_(std::move(request)) {
  const auto& file = request_.file;
  if (file.extension() == ".so") {
    core::fail_input({},
                     fmt::format("'{}' is a library, which would have to be loaded before anything "
                                 "is known of it",
                                 file.string()),
                     "make an FMU of it: stride pack LIBRARY --output FILE.fmu");
  }
  fmu_ = importer::Fmu::load(file, {}, request_.shown_as);
  system_.emplace(declaration(request_, *fmu_));
  choose_observed();
  choose_times();
}

bool TestedUnit::is_set(std::size_t variable) const {
  const auto& values = system_->start_values();
  return std::any_of(values.begin(), values.end(),
                     [&](const core::StartValue& value) { return value.id.variable == variable; });
}

void TestedUnit::choose_observed() {
  std::map<ValueType, Group> groups;
  const auto& variables = description().variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (!is_observed(variables[i])) continue;
    Group& group = groups[variables[i].type];
    group.type = variables[i].type;
    group.size += variables[i].size;
    group.references.push_back(variables[i].reference);
    group.places.push_back(i);
    ++observed_count_;
  }
  for (auto& [type, group] : groups) observed_.push_back(std::move(group));
}

core::Interval TestedUnit::chosen_step() const {
  if (request_.step) return *request_.step;
  const core::UnitDescription& unit = description();
  const auto& own = unit.default_step ? unit.default_step : unit.fixed_internal_step;
  const core::Interval step = own.value_or(core::Interval(kDefaultStep));
  return unit.maximum_step ? std::min(step, *unit.maximum_step) : step;
}

void TestedUnit::choose_times() {
  const core::UnitDescription& unit = description();
  grid_ = core::Grid(unit.default_start.value_or(Time{}), chosen_step());
  Picoseconds steps = kDefaultSteps;
  const auto values = static_cast<std::int64_t>(std::max<std::size_t>(1, observed_count_));
  if (request_.stop) {
    steps = *request_.stop / step();
    if (steps < 4) {
      core::fail_input({},
                       fmt::format("there are {} steps of {} s to the stop time {} s; expected 4 "
                                   "at least",
                                   steps, core::to_text(step()), core::to_text(*request_.stop)),
                       "choose a smaller --step or a later --stop");
    }
  } else if (unit.default_stop) {
    steps = std::clamp<Picoseconds>((*unit.default_stop - start()) / step(), kFewestSteps,
                                    kMostSimulatedSteps);
  }
  if (!request_.stop) {
    steps = std::min<Picoseconds>(steps, std::max(kFewestSteps, kMostValues / values));
  }
  steps_ = static_cast<std::size_t>(steps);
}

std::string TestedUnit::function(const std::string& name) const {
  const std::string& version = description().fmi_version;
  if (version.starts_with("1.")) return "fmi" + fmi1_name(name);
  return (version.starts_with("2") ? "fmi2" : "fmi3") + name;
}

std::string TestedUnit::symbol(const std::string& name) const {
  const bool has_prefix = description().fmi_version.starts_with("1.");
  return (has_prefix ? description().model_identifier + "_" : "") + function(name);
}

}  // namespace stride::verify
