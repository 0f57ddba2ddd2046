#include "master/system/scenario/hosting.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/text/glob.h"
#include "master/engine/model/system/known_names.h"
#include "master/engine/run/stepping/step_order.h"

namespace stride::scenario {
namespace {

/// "COMPONENT=PLACE": a pattern may hold a '=', as the names of components and a place may.
core::Assignment split_place(const std::string& text, std::span<const std::string> components) {
  core::KnownNames patterns;
  for (std::size_t end = text.find('='); end != text.npos; end = text.find('=', end + 1)) {
    const std::string pattern = text.substr(0, end);
    const auto is_meant = [&](const std::string& name) { return core::means(pattern, name); };
    if (std::ranges::any_of(components, is_meant)) patterns.add(pattern, true);
  }
  return patterns.split("--at", text, false);
}

HostRule place_rule(const std::string& text, std::span<const std::string> components) {
  const auto [pattern, place] = split_place(text, components);
  if (pattern.empty() || !place) {
    core::fail_input({}, fmt::format("--at {}: expected COMPONENT=PLACE", text));
  }
  // errors name the machine, whose command can be long
  const core::Location where{"--at " + pattern, 0};
  try {
    RemoteSettings remote{.place = remote::parse_place(*place), .where = where};
    HostSettings settings{.process = true, .where = where};
    settings.remote = std::move(remote);
    return {{pattern, where}, settings};
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({.where = where}, mistake.what());
  }
}

/// Rules behind those of the scenario.
void add_rules(const HostRequest& request, std::span<const std::string> components,
               std::vector<HostRule>& rules) {
  for (const std::string& glob : request.hosted) {
    const core::Location where{glob == "*" ? "--isolate" : "--isolate=" + glob, 0};
    rules.push_back({{glob, where}, {.process = true, .where = where}});
  }
  if (!request.unit_timeout.empty()) {
    const std::string option = fmt::format("--unit-timeout {}", request.unit_timeout);
    try {
      const auto limit = parse_call_limit(request.unit_timeout);
      rules.push_back({{"*", {option, 0}}, {.call_limit = limit}});
    } catch (const std::invalid_argument& mistake) {
      core::fail_input({}, fmt::format("{}: {}", option, mistake.what()));
    }
  }
  for (const std::string& text : request.places) rules.push_back(place_rule(text, components));
  if (request.no_sandbox) rules.push_back({{"*", {"--no-sandbox", 0}}, {.sandbox = false}});
}

core::SnapshotProcess snapshot_process(const core::UnitDescription& unit,
                                       const HostSettings& settings) {
  if (!unit.allows_snapshots || !settings.snapshots.value_or(true)) {
    return core::SnapshotProcess::None;
  }
  if (!settings.process) return core::SnapshotProcess::New;
  return *settings.process ? core::SnapshotProcess::Own : core::SnapshotProcess::None;
}

std::string text(const core::Location& where) {
  return where.line == 0 ? where.file : fmt::format("{}:{}", where.file, where.line);
}

void warn_of_impossible_snapshots(const core::ComponentDeclaration& component,
                                  const HostSettings& settings) {
  const core::UnitDescription& unit = *component.description;
  if (unit.allows_snapshots || unit.can_save_state || !settings.snapshots.value_or(false)) return;
  spdlog::warn(
      "{}it gets no snapshots, which {} asks for: they would not hold what it has outside of its "
      "process, such as a program",
      core::to_text({component.where, component.name, {}, {}}), text(settings.where));
}

std::string snapshots_text(const core::UnitDescription& unit, const HostSettings& settings) {
  if (unit.can_save_state) return "no: it saves its own state";
  if (!unit.allows_snapshots) return "no: they would not hold what it has outside of its process";
  if (!settings.snapshots)
    return "no: it steps after the others; snapshots=\"true\" rolls it back from rejected steps";
  return fmt::format("{0}: snapshots=\"{1}\"", *settings.snapshots ? "yes" : "no",
                     *settings.snapshots);
}

Hosting make_hosting(std::string reason, const core::UnitDescription& unit,
                     const HostSettings& settings) {
  Hosting hosting{std::move(reason), snapshots_text(unit, settings), {}};
  hosting.options.call_limit = settings.call_limit;
  hosting.options.memory_limit = settings.memory_limit;
  hosting.options.is_sandboxed = settings.sandbox.value_or(true);
  hosting.options.takes_snapshots =
      !unit.can_save_state && unit.allows_snapshots && settings.snapshots.value_or(false);
  return hosting;
}

}  // namespace

std::vector<HostSettings> host_settings(std::span<const std::string> components, HostRules rules,
                                        const HostRequest& request) {
  add_rules(request, components, rules.rules);
  std::vector<HostSettings> settings = rules.settings(components);
  for (HostSettings& of_component : settings) {
    if (of_component.remote) of_component.remote->interrupted = request.interrupted;
  }
  return settings;
}

std::vector<std::optional<Hosting>> choose_hostings(
    std::span<const core::ComponentDeclaration> components, const core::StepPolicyType& policy,
    std::span<const HostSettings> settings) {
  std::vector<core::ComponentDeclaration> declared(components.begin(), components.end());
  std::vector<std::optional<Hosting>> hostings(declared.size());
  std::vector<core::SnapshotProcess> processes;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    warn_of_impossible_snapshots(declared[i], settings[i]);
    processes.push_back(snapshot_process(*declared[i].description, settings[i]));
    if (!settings[i].process.value_or(false)) continue;
    hostings[i] = make_hosting(text(settings[i].where), *declared[i].description, settings[i]);
    declared[i].has_snapshots = hostings[i]->options.takes_snapshots;
  }
  for (const std::size_t i : core::missing_snapshots(declared, policy, processes)) {
    const char* reason = policy.controls_error
                             ? "steps that were too long are undone, and it cannot save its state"
                             : "it may return early, as others may, and cannot save its state";
    if (!hostings[i]) {
      spdlog::info("unit '{}' has a process of its own, whose snapshots roll it back: {}",
                   declared[i].name, reason);
      hostings[i] = make_hosting("for its snapshots", *declared[i].description, settings[i]);
    }
    hostings[i]->snapshots = fmt::format("yes: {}", reason);
    hostings[i]->options.takes_snapshots = true;
  }
  return hostings;
}

void check_unit_timeout(const HostRequest& request,
                        std::span<const std::optional<Hosting>> hostings) {
  const bool has_process = std::any_of(hostings.begin(), hostings.end(),
                                       [](const auto& hosting) { return hosting.has_value(); });
  if (request.unit_timeout.empty() || has_process) return;
  core::fail_input({},
                   fmt::format("--unit-timeout {}: no unit has a process of its own, and no other "
                               "can be stopped",
                               request.unit_timeout),
                   "use --isolate as well, or --isolate=COMPONENT");
}

}  // namespace stride::scenario
