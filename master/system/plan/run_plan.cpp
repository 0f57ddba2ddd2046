#include "master/system/plan/run_plan.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/message_text.h"
#include "master/base/parse_option.h"
#include "master/base/time_text.h"
#include "master/engine/model/system/known_names.h"
#include "master/observe/checks/checks.h"
#include "master/observe/coverage/coverage.h"
#include "master/system/declaration/component_selection.h"
#include "master/system/plan/run_steps.h"
#include "master/system/plan/run_times.h"
#include "master/system/scenario/check_selection.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/signal_selection.h"

namespace stride::scenario {
namespace {

/// Each element of an array is a column.
void check_column_count(const core::System& system, std::span<const core::VariableId> recorded) {
  constexpr std::size_t kMostColumns = 1'000'000;
  std::size_t columns = 0;
  for (const core::VariableId id : recorded) columns += system.variable(id).size;
  if (columns <= kMostColumns) return;
  core::fail_input({},
                   fmt::format("the recorded signals have {} columns, an element of an array each, "
                               "and {} at most are possible",
                               columns, kMostColumns),
                   "choose fewer signals, with <stride:Record signals=\"…\"/> or --signals");
}

void warn(const std::string& text) { spdlog::warn("{}", core::message_text(text)); }

/// A pattern of a unit alone may leave its name out, see core::with_component().
std::string full_pattern(const core::System& system, const std::string& alone,
                         const std::string& pattern) {
  const auto is_full = [&](const NamedVariable& variable) {
    return is_meant(system, variable.id, pattern);
  };
  if (alone.empty() || std::ranges::any_of(named_variables(system), is_full)) return pattern;
  return core::with_component(alone, pattern);
}

std::vector<std::size_t> repeated_each_step(const ResolvedSystem& resolved) {
  std::vector<std::size_t> components;
  const auto repeats = permissions(resolved, resolved.scenario.annotation.repeated_steps);
  for (std::size_t i = 0; i < repeats.size(); ++i) {
    if (!repeats[i]) components.push_back(i);
  }
  return components;
}

}  // namespace

RunPlan::RunPlan(const ScenarioRequest& request)
    : RunPlan(scenario::resolve(declare(request), request), request) {}

RunPlan::RunPlan(ResolvedSystem resolved, const ScenarioRequest& request)
    : changes_(changes_of(request)),
      resolved_(std::move(resolved)),
      system_(resolved_.scenario.system) {
  auto& components = resolved_.scenario.system.components;
  for (std::size_t i = 0; i < components.size(); ++i) {
    log_->add_unit(components[i].name, resolved_.fmus[i]->path().string());
  }
  std::ranges::for_each(resolved_.scenario.warnings, warn);
  std::ranges::for_each(system_.warnings(), warn);
  const PlannedTimes times = choose_times(resolved_, request);
  options_.warn = warn;
  options_.start = times.start;
  options_.stop = times.stop;
  has_stop_ = times.has_stop;
  stop_hint_ = times.stop_hint;
  options_.state_saving.each_step = repeated_each_step(resolved_);
  const ComponentSteps own = choose_steps(resolved_, request.step, times, options_);
  for (std::size_t i = 0; i < components.size(); ++i) components[i].own_step = own[i];
  choose_hosts(request.hosts);
  system_ = std::move(system_).with_stepping(components);
  options_.stop = check_steps(system_, resolved_, has_stop_, options_, *log_);
  choose_idle_skips(request);
  choose_interventions(request);
  choose_signals(request);
  options_.threads.main_only =
      select_components(resolved_.selection_names(), resolved_.scenario.annotation.main_thread);
  choose_checks(request);
  choose_coverage(request);
}

bool RunPlan::stays_elsewhere(std::size_t component) const {
  const std::optional<Hosting>& hosting = hostings_[component];
  return hosting && hosting->remote && hosting->remote->sent.empty();
}

void RunPlan::choose_hosts(const HostRequest& request) {
  auto& components = resolved_.scenario.system.components;
  auto settings =
      host_settings(resolved_.selection_names(), resolved_.scenario.annotation.hosts, request);
  for (const IdleTwin& pair : resolved_.idle_twins) {
    if (components[pair.twin].description->single_instance) settings[pair.twin].process = true;
  }
  hostings_ = choose_hostings(components, *options_.step.policy, settings);
  check_unit_timeout(request, hostings_);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!settings[i].remote) continue;
    hostings_[i]->remote = remote_spec(*settings[i].remote, resolved_.scenario.sources[i]);
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    components[i].has_snapshots = hostings_[i] && hostings_[i]->options.takes_snapshots;
  }
}

void RunPlan::choose_idle_skips(const ScenarioRequest& request) {
  if (request.no_idle_skip) {
    if (!request.max_skip.empty()) {
      core::fail_input({}, "--no-idle-skip and --max-skip contradict each other",
                       "use one of them");
    }
    return;
  }
  IdleSettings settings = resolved_.scenario.annotation.idle;
  if (!request.max_skip.empty()) {
    const Duration skip = core::parse_option("--max-skip", request.max_skip, &parse_max_skip);
    for (IdleRule& rule : settings.rules) rule.max_skip = skip;
    settings.rules.insert(settings.rules.begin(), {{"*"}, true, skip, {"--max-skip", 0}});
  }
  options_.idle = settings.options(system_, options_.step);
  for (const IdleTwin& pair : resolved_.idle_twins) options_.idle.max_skip[pair.twin].reset();
}

void RunPlan::warn_of_other_steps() const {
  scenario::warn_of_other_steps(resolved_, options_, *log_);
}

InterventionScope RunPlan::intervention_scope() const {
  return {resolved_, system_, options_, latest_intervention_, stop_hint_};
}

std::vector<core::Intervention> RunPlan::resolve(
    std::vector<InterventionDeclaration> further) const {
  return resolve_interventions(intervention_scope(), std::move(further));
}

/// Those of the scenario are within its own time, also with --stop.
void RunPlan::choose_interventions(const ScenarioRequest& request) {
  const std::optional<Time>& stop = resolved_.scenario.stop;
  latest_intervention_ =
      request.stop.empty() ? options_.stop : std::max(options_.stop, stop.value_or(options_.stop));
  further_interventions_ = requested_interventions(system_, resolved_.scenario.alone, request);
  options_.interventions = resolve(further_interventions_);
  add_interventions_of_twins(resolved_.idle_twins, options_.interventions);
}

std::vector<core::Intervention> RunPlan::interventions_of_branch(
    std::span<const InterventionDeclaration> declarations, Time begin) const {
  for (const InterventionDeclaration& declared : declarations) {
    if (declared.from >= begin) continue;
    core::fail_input({.where = declared.where},
                     fmt::format("it begins at {} s, before its branch does at {} s",
                                 core::to_text(declared.from), core::to_text(begin)));
  }
  std::vector<InterventionDeclaration> all = further_interventions_;
  all.insert(all.end(), declarations.begin(), declarations.end());
  resolve(std::move(all));  // they may contradict each other
  return resolve_interventions(system_, declarations,
                               {options_.start, latest_intervention_, stop_hint_});
}

void RunPlan::choose_signals(const ScenarioRequest& request) {
  const ScenarioAnnotation& chosen = resolved_.scenario.annotation;
  std::vector<SignalPattern> patterns;
  for (const std::string& text : request.signals) {
    patterns.push_back({full_pattern(system_, resolved_.scenario.alone, text), {"--signals", 0}});
  }
  options_.recorded = select_signals(system_, patterns.empty() ? chosen.record : patterns);
  check_column_count(system_, options_.recorded);
  plots_ = patterns.empty() ? select_plots(system_, options_.recorded, chosen.plots)
                            : remaining_plots(system_, options_.recorded, chosen.plots);
}

/// Their intervals are those of the scenario, also with --stop.
void RunPlan::choose_checks(const ScenarioRequest& request) {
  if (request.no_checks) return;
  const std::optional<Time> stop =
      request.stop.empty() && has_stop() ? options_.stop : resolved_.scenario.stop;
  checks_ = select_checks(system_, resolved_.scenario.annotation.checks,
                          {options_.start, stop, stop_hint_});
  options_.watched = checks::Checks(checks_).signals();
}

void RunPlan::choose_coverage(const ScenarioRequest& request) {
  std::vector<GroupDeclaration> groups;
  if (!request.no_coverage) groups = resolved_.scenario.annotation.coverage;
  for (const std::string& component : request.coverage) {
    groups.push_back({.component = component, .where = {"--coverage " + component, 0}});
  }
  std::span<const CoveredDeclaration> demands = resolved_.scenario.annotation.covered;
  if (request.no_checks || request.no_coverage) demands = {};
  coverage_ = select_coverage(system_, groups, demands);
  check_demand_names();
  std::ranges::for_each(coverage_.notes, warn);
  if (coverage_.groups.empty()) return;
  const std::vector<core::VariableId> signals = coverage::Coverage(coverage_.groups).signals();
  options_.watched.insert(options_.watched.end(), signals.begin(), signals.end());
}

/// Other checks are looked at before, and have names of their own.
void RunPlan::check_demand_names() const {
  std::map<std::string, core::Location> known;
  for (const checks::Definition& check : checks_) known.emplace(check.name, check.where);
  for (const coverage::Demand& demand : coverage_.demands) {
    const auto [first, is_new] = known.emplace(demand.name, demand.where);
    if (is_new) continue;
    core::fail_input({.where = demand.where},
                     fmt::format("a second check '{}'; the first is in line {}", demand.name,
                                 first->second.line),
                     "give each a name of its own");
  }
}

}  // namespace stride::scenario
