#include "master/system/scenario/loaded_scenario.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/engine/run/step_policies/unlimited_steps.h"
#include "master/loader/process/hosted_unit.h"
#include "master/observe/checks/checks.h"
#include "master/observe/coverage/coverage.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/system/declaration/component_selection.h"
#include "master/system/scenario/check_selection.h"
#include "master/system/scenario/component_steps.h"
#include "master/system/scenario/default_step.h"
#include "master/system/scenario/recordings.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/signal_selection.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {
namespace {

template <class Parse>
auto parse_option(const std::string& option, const std::string& text, Parse&& parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({}, fmt::format("{} {}: {}", option, text, mistake.what()));
  }
}

std::vector<std::string> names_of(std::span<const core::ComponentDeclaration> components) {
  std::vector<std::string> names;
  for (const core::ComponentDeclaration& component : components) names.push_back(component.name);
  return names;
}

void swap(const std::string& text, Scenario& scenario) {
  auto& components = scenario.system.components;
  const std::vector<std::string> names = names_of(components);
  const auto [name, file] =
      component_file("--swap", text, "component=FILE.fmu", core::KnownNames(names));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    core::fail_input({}, fmt::format("--swap {}: there is no component '{}'", text, name),
                     core::suggestion(name, names));
  }
  const auto i = static_cast<std::size_t>(found - names.begin());
  scenario.sources[i] = file;
  components[i].where = {fmt::format("--swap {}", text), 0};
}

ssp::ParameterValue set_value(const std::string& text, const core::KnownNames& names) {
  const auto [name, value] = split_option("--set", text, "component.variable=value", names);
  ssp::ParameterValue made;
  made.name = name;
  made.value = value;
  made.where = {fmt::format("--set {}", text), 0};
  made.is_required = true;
  return made;
}

/// Whether a name holds a '=', or a value does.
bool is_unclear(const std::string& text) { return std::ranges::count(text, '=') > 1; }

/// The units may be loaded for it, since they know the names of their variables.
core::KnownNames names_of_start_values(const ScenarioRequest& request, Scenario scenario) {
  core::KnownNames names;
  for (const core::InputDeclaration& input : scenario.system.inputs) {
    names.add(input.via.front().connector.name, true);
  }
  for (const core::OutputDeclaration& output : scenario.system.outputs) {
    names.add(output.via.back().connector.name, true);
  }
  for (const std::string& text : request.swaps) swap(text, scenario);
  UnitStore own;
  const auto fmus = load_fmus(scenario, request.units ? *request.units : own,
                              hosts_for_loading(scenario, request.hosts));
  for (std::size_t i = 0; i < fmus.size(); ++i) {
    names.add(scenario.system.components[i].name + ".", *fmus[i]->description());
  }
  return names;
}

/// The parameters, and the values of --set, which have precedence.
std::vector<ssp::ParameterValue> set_values(const ScenarioRequest& request,
                                            const core::KnownNames& names) {
  std::vector<ssp::ParameterValue> values = request.parameters;
  for (const std::string& text : request.sets) values.push_back(set_value(text, names));
  return values;
}

ReadOptions read_options(const ScenarioRequest& request) {
  ReadOptions options{find_unit, {}, request.files, nullptr};
  if (std::ranges::any_of(request.sets, is_unclear)) {
    options.late_parameters = [&](const Scenario& scenario) {
      return set_values(request, names_of_start_values(request, scenario));
    };
  } else {
    options.parameters = set_values(request, {});
  }
  return options;
}

ScenarioChanges changes_of(const ScenarioRequest& request) {
  ScenarioChanges changes{
      .swaps = request.swaps, .values = {}, .parameter_files = request.parameter_files};
  for (const ssp::ParameterValue& parameter : request.parameters) {
    changes.values.push_back(parameter.name + "=" + parameter.value);
  }
  changes.values.insert(changes.values.end(), request.sets.begin(), request.sets.end());
  return changes;
}

/// Where a unit was looked for: that of a linked scenario also beside what the link leads to.
std::string shown_places(const Scenario& scenario, const std::filesystem::path& source) {
  std::string shown = scenario.files->shown(source);
  std::error_code error;
  if (core::path_exists(source) || !std::filesystem::is_symlink(scenario.path, error)) return shown;
  const std::filesystem::path folder = scenario.path.parent_path();
  const auto inside = source.lexically_relative(folder.empty() ? "." : folder);
  const std::filesystem::path target = std::filesystem::canonical(scenario.path, error);
  if (error || inside.empty()) return shown;
  return shown + "', or '" + (target.parent_path() / inside).lexically_normal().string();
}

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

/// Of what is written with another sign than '='.
std::string assignment_hint(const std::string& option, const std::string& text) {
  constexpr std::string_view kSigns = " :\t";
  const std::size_t sign = text.find_first_of(kSigns);
  const std::size_t value = text.find_first_not_of(kSigns, sign);
  if (sign == 0 || sign == text.npos || value == text.npos) return "";
  return fmt::format("write {} {}={}", option, text.substr(0, sign), text.substr(value));
}

}  // namespace

std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text,
                                                 const std::string& form,
                                                 const core::KnownNames& names) {
  auto [name, value] = names.split(option, text, false);
  if (value && !name.empty()) return {std::move(name), *std::move(value)};
  core::fail_input({}, fmt::format("{} {}: expected {}", option, text, form),
                   assignment_hint(option, text));
}

std::optional<ComponentFile> split_existing_file(const std::string& option,
                                                 const std::string& text) {
  core::KnownNames names;
  for (std::size_t end = text.find('='); end != text.npos; end = text.find('=', end + 1)) {
    if (core::path_exists(text.substr(end + 1))) names.add(text.substr(0, end), true);
  }
  return split_component_file(option, text, names);
}

std::optional<ComponentFile> split_component_file(const std::string& option,
                                                  const std::string& text,
                                                  const core::KnownNames& names) {
  const auto [name, file] = names.split(option, text, false);
  if (name.empty() || !file || file->empty()) return std::nullopt;
  return ComponentFile{name, *file};
}

ComponentFile component_file(const std::string& option, const std::string& text,
                             const std::string& form, const core::KnownNames& names) {
  const auto [name, file] = split_option(option, text, form, names);
  if (!file.empty()) return {name, file};
  core::fail_input({}, fmt::format("{} {}: no file is named", option, text));
}

std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario) {
  UnitStore units;
  return load_fmus(scenario, units, hosts_for_loading(scenario, {}));
}

std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario, UnitStore& units,
                                                      std::span<const HostSettings> hosts) {
  UnitStore by_source;
  std::vector<std::shared_ptr<importer::Fmu>> fmus;
  for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
    const core::Location& where = scenario.system.components[i].where;
    const std::filesystem::path& source = scenario.sources[i];
    if (hosts[i].remote && !hosts[i].remote->sends) {
      const remote::RemoteSpec spec = remote_spec(*hosts[i].remote, source);
      auto& fmu = units[key_of(spec)];
      if (!fmu) fmu = remote::describe(spec, hosts[i].remote->where);
      fmus.push_back(fmu);
      continue;
    }
    auto& named = by_source[source];
    if (!named) {
      const auto path = find_unit_shown_as(source, shown_places(scenario, source), where);
      auto& fmu = units[path];
      if (!fmu) fmu = load_unit(path, where, scenario.files->shown(path));
      named = fmu;
    }
    fmus.push_back(named);
  }
  return fmus;
}

LoadedScenario::LoadedScenario(const ScenarioRequest& request)
    : changes_(changes_of(request)),
      scenario_(read_scenario(request.scenario, read_options(request))) {
  for (const std::string& text : request.swaps) swap(text, scenario_);
  if (scenario_.system.components.empty()) {
    core::fail_input(of_file(), "the system has no component, so there is nothing to simulate");
  }
  load_units(request);
  switch_on(kFilm, scenario_.system, request.film);
  switch_on(kScene, scenario_.system, request.scene);
  connect_terminals();
  if (request.idle_twins) add_twins();
  choose_early_returns();
  choose_state_saving();
  choose_repeated_steps();
  system_.emplace(scenario_.system);
  for (const auto& warnings : {scenario_.warnings, system_->warnings()}) {
    for (const std::string& warning : warnings) spdlog::warn("{}", core::message_text(warning));
  }
  choose_times(request);
  choose_steps(request.step);
  choose_hosts(request.hosts);
  system_ = std::move(*system_).with_stepping(scenario_.system.components);
  check_steps();
  choose_idle_skips(request);
  choose_interventions(request);
  choose_signals(request);
  options_.threads.main_only =
      select_components(selection_names(), scenario_.annotation.main_thread);
  choose_checks(request);
  choose_coverage(request);
}

core::Context LoadedScenario::of_file() const { return {.where = {scenario_.path.string(), 0}}; }

std::vector<std::string> LoadedScenario::component_names() const {
  return names_of(scenario_.system.components);
}

bool LoadedScenario::stays_elsewhere(std::size_t component) const {
  const std::optional<Hosting>& hosting = hostings_[component];
  return hosting && hosting->remote && hosting->remote->sent.empty();
}

void LoadedScenario::load_units(const ScenarioRequest& request) {
  UnitStore own;
  fmus_ = load_fmus(scenario_, request.units ? *request.units : own,
                    hosts_for_loading(scenario_, request.hosts));
  std::set<std::string> known;
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    core::ComponentDeclaration& component = scenario_.system.components[i];
    component.description = fmus_[i]->description();
    log_->add_unit(component.name, fmus_[i]->path().string());
    for (const std::string& warning : fmus_[i]->description()->warnings) {
      if (known.insert(warning).second) scenario_.warnings.push_back(warning);
    }
  }
}

/// Those that `stride complete` has written are there already.
void LoadedScenario::connect_terminals() {
  auto& connections = scenario_.system.connections;
  for (auto& made : scenario::connect_terminals(scenario_.annotation.terminals,
                                                scenario_.system.components, fmus_)) {
    const bool is_there = std::ranges::any_of(connections, [&](const auto& other) {
      return other.from_component == made.from_component &&
             other.from_connector == made.from_connector &&
             other.to_component == made.to_component && other.to_connector == made.to_connector;
    });
    if (!is_there) connections.push_back(std::move(made));
  }
}

void LoadedScenario::add_twins() {
  idle_twins_ = add_idle_twins(scenario_.system);
  for (const IdleTwin& pair : idle_twins_) {
    scenario_.sources.push_back(scenario_.sources[pair.unit]);
    fmus_.push_back(fmus_[pair.unit]);
  }
}

/// What selects a component selects its twin.
std::vector<std::string> LoadedScenario::selection_names() const {
  std::vector<std::string> names = component_names();
  for (const IdleTwin& pair : idle_twins_) names[pair.twin] = names[pair.unit];
  return names;
}

void LoadedScenario::choose_early_returns() {
  const std::vector<bool> allowed = permissions(scenario_.annotation.early_return);
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    scenario_.system.components[i].early_return_allowed = allowed[i];
  }
}

/// A component whose own functions for its state are not to be used counts as one without them.
void LoadedScenario::choose_state_saving() {
  const std::vector<bool> allowed = permissions(scenario_.annotation.state_saving);
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (allowed[i]) continue;
    auto& description = scenario_.system.components[i].description;
    auto without = std::make_shared<core::UnitDescription>(*description);
    without->can_save_state = without->can_serialize_state = false;
    description = std::move(without);
  }
}

void LoadedScenario::choose_repeated_steps() {
  const std::vector<bool> repeats = permissions(scenario_.annotation.repeated_steps);
  for (std::size_t i = 0; i < repeats.size(); ++i) {
    if (!repeats[i]) options_.state_saving.each_step.push_back(i);
  }
}

/// Of each component.
std::vector<bool> LoadedScenario::permissions(std::span<const PermissionRule> rules) const {
  const std::vector<std::string> names = selection_names();
  const ComponentSelector selector(names);
  std::vector<bool> allowed(names.size(), true);
  for (const PermissionRule& rule : rules) {
    for (const std::size_t i : selector.select(rule.components)) allowed[i] = rule.allowed;
  }
  return allowed;
}

void LoadedScenario::choose_times(const ScenarioRequest& request) {
  options_.start = chosen_start(request);
  options_.warn = [](const std::string& text) { spdlog::warn("{}", core::message_text(text)); };
  has_stop_ = !request.may_lack_stop || !request.stop.empty() || declared_stop();
  const Time beyond_all(Time::max().time_since_epoch() / 2);  // no difference overflows
  options_.stop = has_stop_ ? chosen_stop(request) : beyond_all;
  if (options_.stop == options_.start) {
    spdlog::warn("the run ends where it starts, at {} s, so it has initial values only",
                 core::to_text(options_.start));
  }
  if (options_.stop >= options_.start) return;
  const char* const of_units = ", which is that of the units' DefaultExperiment,";
  core::fail_input(of_file(),
                   fmt::format("the stop time {} s{} is before the start time {} s{}",
                               core::to_text(options_.stop),
                               request.stop.empty() && !scenario_.stop ? of_units : "",
                               core::to_text(options_.start),
                               request.start.empty() && !scenario_.start ? of_units : ""),
                   "give a later stop time by --stop SECONDS or <ssd:DefaultExperiment "
                   "stopTime=\"…\"/>, or an earlier start time by --start or startTime");
}

Time LoadedScenario::chosen_start(const ScenarioRequest& request) const {
  if (!request.start.empty()) return parse_option("--start", request.start, &core::parse_time);
  return scenario_.start ? *scenario_.start : earliest_start_of_units();
}

/// Those of different units need not be the same.
Time LoadedScenario::earliest_start_of_units() const {
  const auto& components = scenario_.system.components;
  std::vector<std::pair<Time, std::size_t>> starts;
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    if (const auto& start = fmus_[i]->description()->default_start) starts.emplace_back(*start, i);
  }
  if (starts.empty()) return {};
  const auto [first, last] = std::ranges::minmax(starts);
  const core::ComponentDeclaration& earliest = components[first.second];
  if (first.first != last.first) {
    spdlog::warn(
        "the run begins at {} s, the start time of '{}'; that of '{}' is {} s; --start "
        "chooses another one",
        core::to_text(first.first), earliest.name, components[last.second].name,
        core::to_text(last.first));
  }
  return first.first;
}

Time LoadedScenario::chosen_stop(const ScenarioRequest& request) const {
  if (!request.stop.empty()) return parse_option("--stop", request.stop, &core::parse_time);
  const std::optional<Time> stop = declared_stop();
  const std::string hint =
      "use --stop SECONDS; a system has it in <ssd:DefaultExperiment stopTime=\"…\"/>";
  if (!stop) {
    core::fail_input(of_file(), "there is no stop time, neither of the system nor of a unit", hint);
  }
  if (*stop == Time::max()) {
    core::fail_input(of_file(),
                     "the stop time of a unit's DefaultExperiment is beyond 9.2e6 s, the largest "
                     "time",
                     hint);
  }
  return *stop;
}

/// That of the scenario, or else the latest of the units.
std::optional<Time> LoadedScenario::declared_stop() const {
  std::optional<Time> latest = scenario_.stop;
  if (latest) return latest;
  for (const auto& fmu : fmus_) {
    const auto& stop = fmu->description()->default_stop;
    if (stop) latest = std::max(latest.value_or(*stop), *stop);
  }
  return latest;
}

/// 0 if no stop time is declared. It does not depend on --stop: a run that ends earlier, or is
/// resumed to end later, makes the same steps.
Duration LoadedScenario::declared_length() const {
  const Time stop = declared_stop().value_or(Time::max());
  return stop == Time::max() ? Duration{} : stop - options_.start;
}

void LoadedScenario::choose_steps(const StepSettings& request) {
  const auto set = set_component_steps(request);
  const bool are_all_set =
      std::ranges::all_of(set, [](const auto& step) { return step.has_value(); });
  std::optional<core::Interval> unit_step;
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    if (set[i] && !are_all_set) continue;
    const auto step = set[i] ? set[i] : declared_step(*fmus_[i]->description());
    if (step) unit_step = std::min(unit_step.value_or(*step), *step);
  }
  options_.step.size = unit_step.value_or(default_step(declared_length()));
  const auto& vendor = scenario_.vendor_step;
  const bool has_own_step = scenario_.annotation.step.size || request.size;
  if (vendor && !has_own_step) {
    options_.step.size = vendor->size;
    spdlog::warn(
        "{}the step is {} s, as {} of another tool has it; <stride:Step size=\"…\"/> "
        "or --step sets another one",
        core::to_text({.where = vendor->where}), core::to_text(vendor->size), vendor->tag);
  }
  scenario_.annotation.step.apply(options_);
  request.apply(options_);
  if (options_.step.maximum && *options_.step.maximum < options_.step.minimum) {
    core::fail_input(of_file(), fmt::format("the maximum step of {} s is below the minimum of {} s",
                                            core::to_text(*options_.step.maximum),
                                            core::to_text(options_.step.minimum)));
  }
  const core::StepOptions& step = options_.step;
  if (step.policy->controls_error && step.relative_tolerance == 0 && step.absolute_tolerance == 0) {
    core::fail_input(of_file(), "both tolerances are 0, so no step is good enough",
                     "give a relative or an absolute tolerance above 0");
  }
  choose_component_steps(set, has_own_step || vendor);
}

/// Those of the request replace those of the scenario.
ComponentSteps LoadedScenario::set_component_steps(const StepSettings& request) const {
  const std::vector<std::string> names = selection_names();
  auto steps = request.component_steps(names);
  const auto own = scenario_.annotation.step.component_steps(names);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i]) steps[i] = own[i];
  }
  return steps;
}

void LoadedScenario::choose_component_steps(const ComponentSteps& set, bool is_size_set) {
  auto& components = scenario_.system.components;
  const auto steps = scenario::choose_component_steps(components, set, options_, is_size_set);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!steps[i]) continue;
    components[i].own_step = steps[i];
    check_internal_step(components[i]);
    if (set[i]) warn_of_early_returns(components[i]);
  }
}

/// A unit that takes steps of its internal size only cannot have others.
void LoadedScenario::check_internal_step(const core::ComponentDeclaration& component) const {
  const auto& internal = component.description->fixed_internal_step;
  const bool is_rigid = !component.description->can_vary_step;
  if (!is_rigid || !internal || component.own_step->is_multiple_of(*internal)) return;
  core::fail_input({component.where, component.name, {}, {}},
                   fmt::format("its step of {} s is not a multiple of its unit's fixed internal "
                               "step of {} s, and the unit takes steps of one size only",
                               core::to_text(*component.own_step), core::to_text(*internal)),
                   fmt::format("use --step {}={}, or <stride:Step components=\"{}\" size=\"{}\"/>",
                               component.name, core::to_text(*internal), component.name,
                               core::to_text(*internal)));
}

void LoadedScenario::warn_of_early_returns(const core::ComponentDeclaration& component) const {
  if (!component.may_return_early()) return;
  spdlog::warn(
      "{}its unit may return early, so it is called at the points of the others, too, and its own "
      "step of {} s is its longest one; <stride:EarlyReturn components=\"{}\" "
      "allowed=\"false\"/> lets it make whole steps only",
      core::to_text({component.where, component.name, {}, {}}), core::to_text(*component.own_step),
      component.name);
}

/// That of its regular steps.
core::Interval LoadedScenario::step_of(std::size_t component) const {
  return scenario_.system.components[component].own_step.value_or(options_.step.size);
}

/// Their intervals are those of the scenario, also with --stop.
void LoadedScenario::choose_checks(const ScenarioRequest& request) {
  if (request.no_checks) return;
  const std::optional<Time> stop =
      request.stop.empty() && has_stop() ? options_.stop : scenario_.stop;
  checks_ = select_checks(*system_, scenario_.annotation.checks, {options_.start, stop});
  options_.watched = checks::Checks(checks_).signals();
}

void LoadedScenario::choose_coverage(const ScenarioRequest& request) {
  std::vector<GroupDeclaration> groups;
  if (!request.no_coverage) groups = scenario_.annotation.coverage;
  for (const std::string& component : request.coverage) {
    groups.push_back({.component = component, .where = {"--coverage " + component, 0}});
  }
  std::span<const CoveredDeclaration> demands = scenario_.annotation.covered;
  if (request.no_checks || request.no_coverage) demands = {};
  coverage_ = select_coverage(*system_, groups, demands);
  check_demand_names();
  for (const std::string& note : coverage_.notes) spdlog::warn("{}", core::message_text(note));
  if (coverage_.groups.empty()) return;
  const std::vector<core::VariableId> signals = coverage::Coverage(coverage_.groups).signals();
  options_.watched.insert(options_.watched.end(), signals.begin(), signals.end());
}

/// Other checks are looked at before, and have names of their own.
void LoadedScenario::check_demand_names() const {
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

void LoadedScenario::choose_hosts(const HostRequest& request) {
  auto& components = scenario_.system.components;
  auto settings = host_settings(selection_names(), scenario_.annotation.hosts, request);
  for (const IdleTwin& pair : idle_twins_) {
    if (components[pair.twin].description->single_instance) settings[pair.twin].process = true;
  }
  hostings_ = choose_hostings(components, *options_.step.policy, settings);
  check_unit_timeout(request, hostings_);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!settings[i].remote) continue;
    hostings_[i]->remote = remote_spec(*settings[i].remote, scenario_.sources[i]);
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    components[i].has_snapshots = hostings_[i] && hostings_[i]->options.takes_snapshots;
  }
}

void LoadedScenario::check_steps() {
  core::check_step_policy(*system_, options_);
  if (core::has_unlimited_steps(*system_, options_)) warn_of_unlimited_steps();
  if (options_.step.policy->has_grid) {
    warn_of_many_steps();
    end_with_whole_steps();
    warn_of_internal_steps();
  }
  warn_of_last_own_steps();
}

void LoadedScenario::choose_idle_skips(const ScenarioRequest& request) {
  if (request.no_idle_skip) {
    if (!request.max_skip.empty()) {
      core::fail_input({}, "--no-idle-skip and --max-skip contradict each other",
                       "use one of them");
    }
    return;
  }
  IdleSettings settings = scenario_.annotation.idle;
  if (!request.max_skip.empty()) {
    const Duration skip = parse_option("--max-skip", request.max_skip, &parse_max_skip);
    for (IdleRule& rule : settings.rules) rule.max_skip = skip;
    settings.rules.insert(settings.rules.begin(), {{"*"}, true, skip, {"--max-skip", 0}});
  }
  options_.idle = settings.options(*system_, options_.step);
  for (const IdleTwin& pair : idle_twins_) options_.idle.max_skip[pair.twin].reset();
}

core::Grid LoadedScenario::grid() const { return {options_.start, options_.step.size}; }

core::Grid LoadedScenario::grid_of(std::size_t component) const {
  return {options_.start, step_of(component)};
}

/// A unit that takes steps of one size only cannot have one that ends in between.
void LoadedScenario::check_instants(std::span<const core::Intervention> interventions) const {
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    const core::Component& component = system_->components()[i];
    if (component.description->can_vary_step) continue;
    const bool is_alone = component.keeps_own_step();
    if (!is_alone && !options_.step.policy->has_grid) continue;
    for (const core::Intervention& intervention : interventions) {
      if (!is_alone || intervention.id.component == i) check_instants(i, intervention);
    }
  }
}

/// Whether they are ends of steps of this component.
void LoadedScenario::check_instants(std::size_t component,
                                    const core::Intervention& intervention) const {
  const core::ComponentDeclaration& rigid = scenario_.system.components[component];
  for (const Time time : {intervention.from, intervention.until.value_or(intervention.from)}) {
    if (grid_of(component).has(time)) continue;
    core::fail_input({rigid.where, rigid.name, {}, {}},
                     fmt::format("the unit takes steps of one size only, and none of {} s ends at "
                                 "{} s, the instant of an intervention on '{}'",
                                 core::to_text(step_of(component)), core::to_text(time),
                                 system_->full_name(intervention.id)),
                     "choose a multiple of the step for it");
  }
}

std::vector<core::Intervention> LoadedScenario::resolve(
    std::vector<InterventionDeclaration> further) const {
  const auto& own = scenario_.annotation.interventions;
  further.insert(further.begin(), own.begin(), own.end());
  auto resolved = resolve_interventions(*system_, further, {options_.start, latest_intervention_});
  check_instants(resolved);
  return resolved;
}

/// Those of the scenario are within its own time, also with --stop. What changes a unit changes its
/// twin.
void LoadedScenario::choose_interventions(const ScenarioRequest& request) {
  latest_intervention_ = request.stop.empty()
                             ? options_.stop
                             : std::max(options_.stop, scenario_.stop.value_or(options_.stop));
  std::vector<InterventionDeclaration>& declared = further_interventions_;
  declared = request.interventions;
  const auto parse_all = [&](std::span<const std::string> texts, auto& parse) {
    if (texts.empty()) return;
    const core::KnownNames names(*system_);
    for (const std::string& text : texts) declared.push_back(parse(text, names));
  };
  parse_all(request.set_at, parse_set_at);
  parse_all(request.forces, parse_force);
  parse_all(request.drops, parse_drop);
  parse_all(request.delays, parse_delay);
  parse_all(request.corruptions, parse_corrupt);
  for (const BranchReference& branch : request.branches) {
    const std::vector<InterventionDeclaration> further = find_branch(branch).interventions;
    declared.insert(declared.end(), further.begin(), further.end());
  }
  options_.interventions = resolve(declared);
  const std::size_t count = options_.interventions.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const IdleTwin& pair : idle_twins_) {
      if (options_.interventions[i].id.component != pair.unit) continue;
      core::Intervention of_twin = options_.interventions[i];
      of_twin.id.component = of_twin.clock.component = pair.twin;
      options_.interventions.push_back(std::move(of_twin));
    }
  }
}

std::vector<core::Intervention> LoadedScenario::interventions_of_branch(
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
  return resolve_interventions(*system_, declarations, {options_.start, latest_intervention_});
}

void LoadedScenario::choose_signals(const ScenarioRequest& request) {
  const ScenarioAnnotation& chosen = scenario_.annotation;
  std::vector<SignalPattern> patterns;
  for (const std::string& text : request.signals) patterns.push_back({text, {"--signals", 0}});
  options_.recorded = select_signals(*system_, patterns.empty() ? chosen.record : patterns);
  check_column_count(*system_, options_.recorded);
  plots_ = patterns.empty() ? select_plots(*system_, options_.recorded, chosen.plots)
                            : remaining_plots(*system_, options_.recorded, chosen.plots);
}

void LoadedScenario::warn_of_many_steps() const {
  constexpr std::uint64_t kMany = 10'000'000;
  const std::uint64_t steps = grid().index_at(options_.stop);
  if (steps <= kMany || !has_stop()) return;
  spdlog::warn(
      "up to {} steps of {} s are made, with a row of the results each; a longer step, "
      "--step SECONDS or <stride:Step size=\"…\"/>, makes fewer",
      steps, core::to_text(options_.step.size));
}

/// A run with units that takes steps of one size only ends with the last whole one.
void LoadedScenario::end_with_whole_steps() {
  if (!has_stop() || grid().ends_at(options_.stop)) return;
  std::size_t rigid = 0;
  const auto is_bound = [&](std::size_t i) {
    return !fmus_[i]->description()->can_vary_step && step_of(i) == options_.step.size;
  };
  while (rigid < fmus_.size() && !is_bound(rigid)) ++rigid;
  if (rigid == fmus_.size()) return;
  const core::ComponentDeclaration& component = scenario_.system.components[rigid];
  const core::Context context{component.where, component.name, {}, {}};
  const std::string reason = fmt::format(
      "the unit takes steps of one size only, and the run to {} s is not a whole number of steps "
      "of {} s",
      core::to_text(options_.stop), core::to_text(options_.step.size));
  const Time last = grid().last_point(options_.stop);
  if (last == options_.start) {
    core::fail_input(context, reason,
                     fmt::format("stop at a multiple of them, at {} s or later",
                                 core::to_text(grid().point(1))));
  }
  options_.stop = last;
  spdlog::warn("{}", core::message_text(core::to_text(context) + reason +
                                        fmt::format(": the run ends at {} s, with the last whole "
                                                    "one",
                                                    core::to_text(options_.stop))));
}

/// A component that takes steps of one size only has made its last one before the end of the run.
void LoadedScenario::warn_of_last_own_steps() const {
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    const core::Component& component = system_->components()[i];
    if (component.description->can_vary_step || !component.keeps_own_step()) continue;
    const core::Grid grid = grid_of(i);
    if (grid.ends_at(options_.stop)) continue;
    const Time last = grid.last_point(options_.stop);
    const core::Context context{scenario_.system.components[i].where, component.name, {}, {}};
    const std::string reason =
        fmt::format("the unit takes steps of one size only, {} s, none of which ends at {} s",
                    core::to_text(step_of(i)), core::to_text(options_.stop));
    if (last == options_.start) {
      core::fail_input(context, reason,
                       fmt::format("stop at a multiple of them, at {} s or later",
                                   core::to_text(grid.point(1))));
    }
    spdlog::warn("{}{}: its last one ends at {} s, and its outputs hold from there on",
                 core::to_text(context), reason, core::to_text(last));
  }
}

/// Some units count their steps, and not the time.
void LoadedScenario::warn_of_other_steps() const {
  if (!options_.step.policy->has_grid) return;
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    const core::UnitDescription& unit = *fmus_[i]->description();
    if (unit.can_vary_step || !unit.default_step || *unit.default_step == step_of(i)) {
      continue;
    }
    const std::string step = core::to_text(*unit.default_step);
    log_->write(
        scenario_.system.components[i].name, importer::Status::Warning, "stride",
        fmt::format("it takes steps of one size only, and its DefaultExperiment has {} s, "
                    "but its steps are of {} s; if its times or values are wrong then, use "
                    "--step {}={}",
                    step, core::to_text(step_of(i)), scenario_.system.components[i].name, step));
  }
}

void LoadedScenario::warn_of_internal_steps() const {
  for (std::size_t i = 0; i < fmus_.size(); ++i) {
    const auto& internal = fmus_[i]->description()->fixed_internal_step;
    if (!internal || step_of(i).is_multiple_of(*internal)) continue;
    log_->write(scenario_.system.components[i].name, importer::Status::Warning, "stride",
                fmt::format("its internal step of {} s is not part of the communication step of "
                            "{} s, so it is not always where the others are",
                            core::to_text(*internal), core::to_text(step_of(i))));
  }
}

void LoadedScenario::warn_of_unlimited_steps() const {
  constexpr std::size_t kMostNames = 5;
  const std::vector<std::string> names = core::connections_without_events(*system_);
  if (names.empty()) return;
  spdlog::warn(
      "values travel at events only, since nothing else ends a step, so what these outputs do "
      "meanwhile is missed: {}; <stride:Step maximum=\"…\"/> (--max-step) ends steps, or says "
      "with a long one that this is meant",
      core::abridged(names, kMostNames));
}

importer::InstanceOptions LoadedScenario::instance_options(
    std::size_t component, const std::filesystem::path& results,
    const volatile std::sig_atomic_t* interrupted) const {
  const core::ComponentDeclaration& declared = scenario_.system.components[component];
  importer::InstanceOptions options;
  options.log = [log = log_](const auto&... message) { log->write(message...); };
  options.debug_logging = true;  // the log's level decides what is shown
  options.early_return_allowed = declared.early_return_allowed;
  options.intermediate_update = options_.sets_inputs_in_steps();
  options.where = declared.where;
  if (declared.own_step || options_.step.policy->has_grid) options.step = step_of(component);
  options.interrupted = interrupted;
  if (!results.empty()) options.results = recorders::unit_folder(results, declared.name);
  options.description = system_->components()[component].description;
  return options;
}

std::vector<std::unique_ptr<core::Unit>> LoadedScenario::instantiate(
    const std::filesystem::path& results, const volatile std::sig_atomic_t* interrupted) const {
  const auto& components = system_->components();
  // a unit may change the working folder
  const std::filesystem::path folder =
      results.empty() ? results : std::filesystem::absolute(results);
  std::vector<std::unique_ptr<core::Unit>> units(components.size());
  // processes first: they are forked from this one, which has loaded no unit's library yet; and
  // before them links, so that machines are awaited together
  std::vector<remote::RemoteUnit*> remote_units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!hostings_[i] || !hostings_[i]->remote) continue;
    auto unit = std::make_unique<remote::RemoteUnit>(
        *hostings_[i]->remote, fmus_[i], components[i].name,
        instance_options(i, folder, interrupted), hostings_[i]->options);
    remote_units.push_back(unit.get());
    units[i] = std::move(unit);
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!hostings_[i] || units[i]) continue;
    isolation::HostOptions host = hostings_[i]->options;
    importer::InstanceOptions options = instance_options(i, folder, interrupted);
    if (!folder.empty()) host.writable.push_back(options.results);
    units[i] =
        isolation::instantiate(fmus_[i], components[i].name, std::move(options), std::move(host));
  }
  for (remote::RemoteUnit* const unit : remote_units) unit->instantiate();
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i]) continue;
    importer::InstanceOptions options = instance_options(i, folder, interrupted);
    options.process = process_;
    units[i] = fmus_[i]->instantiate(components[i].name, std::move(options));
  }
  return units;
}

}  // namespace stride::scenario
