#include "master/system/plan/run_steps.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/message_text.h"
#include "master/base/time_text.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/engine/run/step_policies/unlimited_steps.h"
#include "master/system/scenario/component_steps.h"
#include "master/system/scenario/default_step.h"

namespace stride::scenario {
namespace {

/// Those of the request replace those of the scenario.
ComponentSteps set_component_steps(const ResolvedSystem& resolved, const StepSettings& request) {
  const std::vector<std::string> names = resolved.selection_names();
  auto steps = request.component_steps(names);
  const auto own = resolved.scenario.annotation.step.component_steps(names);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i]) steps[i] = own[i];
  }
  return steps;
}

/// A unit that takes steps of its internal size only cannot have others.
void check_internal_step(const core::ComponentDeclaration& component, const core::Interval& step) {
  const auto& internal = component.description->fixed_internal_step;
  const bool is_rigid = !component.description->can_vary_step;
  if (!is_rigid || !internal || step.is_multiple_of(*internal)) return;
  core::fail_input({component.where, component.name, {}, {}},
                   fmt::format("its step of {} s is not a multiple of its unit's fixed internal "
                               "step of {} s, and the unit takes steps of one size only",
                               core::to_text(step), core::to_text(*internal)),
                   fmt::format("use --step {}={}, or <stride:Step components=\"{}\" size=\"{}\"/>",
                               component.name, core::to_text(*internal), component.name,
                               core::to_text(*internal)));
}

void warn_of_early_returns(const core::ComponentDeclaration& component,
                           const core::Interval& step) {
  if (!component.may_return_early()) return;
  spdlog::warn(
      "{}its unit may return early, so it is called at the points of the others, too, and its own "
      "step of {} s is its longest one; <stride:EarlyReturn components=\"{}\" "
      "allowed=\"false\"/> lets it make whole steps only",
      core::to_text({component.where, component.name, {}, {}}), core::to_text(step),
      component.name);
}

ComponentSteps own_steps(const ResolvedSystem& resolved, const ComponentSteps& set,
                         const core::RunOptions& options, bool is_size_set) {
  const auto& components = resolved.components();
  ComponentSteps steps = choose_component_steps(components, set, options, is_size_set);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!steps[i]) continue;
    check_internal_step(components[i], *steps[i]);
    if (set[i]) warn_of_early_returns(components[i], *steps[i]);
  }
  return steps;
}

bool takes_run_step(const core::ComponentDeclaration& component) {
  return !component.description->can_vary_step;
}

/// Of the command line, whose options have a purpose; a scenario may limit steps that are longer.
void check_requested_sizes(const StepSettings& request, const core::StepOptions& step) {
  const bool is_requested = request.size || request.maximum;
  if (!is_requested || !step.maximum || *step.maximum >= step.size) return;
  const std::string size = core::to_text(step.size), maximum = core::to_text(*step.maximum);
  if (request.size && request.maximum) {
    core::fail_input({}, fmt::format("--step {} is longer than --max-step {}", size, maximum),
                     "leave one of them out");
  }
  spdlog::warn(
      "no step is as long as the step size of {} s: --max-step, or <stride:Step "
      "maximum=\"…\"/>, ends it after {} s",
      size, maximum);
}

/// Options of the command line that the policy of the run has no use for.
void check_requested(const ResolvedSystem& resolved, const StepSettings& request,
                     const core::StepOptions& step) {
  const core::StepPolicyType& policy = *step.policy;
  check_requested_sizes(request, step);
  const bool has_size = policy.has_grid || policy.controls_error ||
                        std::ranges::any_of(resolved.components(), takes_run_step);
  if (request.size && !has_size) {
    const std::string size = core::to_text(*request.size);
    const std::string text =
        fmt::format("--step {}: with the policy '{}' steps end at events, so none has this size",
                    size, policy.name);
    const std::string hint = fmt::format("limit the steps by --max-step {}, or use --policy {}",
                                         size, core::kFixedSteps.name);
    if (request.policy) core::fail_input({}, text, hint);
    spdlog::warn("{}; {}", text, hint);
  }
  const bool has_tolerance = request.relative_tolerance || request.absolute_tolerance;
  if (!has_tolerance || policy.controls_error) return;
  core::fail_input(
      {},
      fmt::format("{}: the policy '{}' does not control the error",
                  request.relative_tolerance ? "--relative-tolerance" : "--absolute-tolerance",
                  policy.name),
      fmt::format("leave it out, or use --policy {}", core::kErrorControlledSteps.name));
}

class StepCheck {
 public:
  StepCheck(const core::System& system, const ResolvedSystem& resolved, bool has_stop,
            const core::RunOptions& options, UnitLog& log)
      : system_(system),
        resolved_(resolved),
        has_stop_(has_stop),
        options_(options),
        log_(log),
        grids_(resolved.components(), options),
        stop_(options.stop) {}

  Time run();

 private:
  void warn_of_many_steps() const;
  void end_with_whole_steps();
  void warn_of_last_own_steps() const;
  void warn_of_internal_steps() const;
  void warn_of_unlimited_steps() const;

  const core::System& system_;
  const ResolvedSystem& resolved_;
  bool has_stop_;
  const core::RunOptions& options_;
  UnitLog& log_;
  StepGrids grids_;
  Time stop_;
};

Time StepCheck::run() {
  core::check_step_policy(system_, options_);
  if (core::has_unlimited_steps(system_, options_)) warn_of_unlimited_steps();
  if (options_.step.policy->has_grid) {
    warn_of_many_steps();
    end_with_whole_steps();
    warn_of_internal_steps();
  }
  warn_of_last_own_steps();
  return stop_;
}

void StepCheck::warn_of_many_steps() const {
  constexpr std::uint64_t kMany = 10'000'000;
  const std::uint64_t steps = grids_.grid().index_at(stop_);
  if (steps <= kMany || !has_stop_) return;
  spdlog::warn(
      "up to {} steps of {} s are made, with a row of the results each; a longer step, "
      "--step SECONDS or <stride:Step size=\"…\"/>, makes fewer",
      steps, core::to_text(options_.step.size));
}

/// A run with units that takes steps of one size only ends with the last whole one.
void StepCheck::end_with_whole_steps() {
  if (!has_stop_ || grids_.grid().ends_at(stop_)) return;
  std::size_t rigid = 0;
  const auto is_bound = [&](std::size_t i) {
    return !resolved_.fmus[i]->description()->can_vary_step &&
           grids_.step_of(i) == options_.step.size;
  };
  while (rigid < resolved_.fmus.size() && !is_bound(rigid)) ++rigid;
  if (rigid == resolved_.fmus.size()) return;
  const core::ComponentDeclaration& component = resolved_.components()[rigid];
  const core::Context context{component.where, component.name, {}, {}};
  const std::string reason = fmt::format(
      "the unit takes steps of one size only, and the run to {} s is not a whole number of steps "
      "of {} s",
      core::to_text(stop_), core::to_text(options_.step.size));
  const Time last = grids_.grid().last_point(stop_);
  if (last == options_.start) {
    core::fail_input(context, reason,
                     fmt::format("stop at a multiple of them, at {} s or later",
                                 core::to_text(grids_.grid().point(1))));
  }
  stop_ = last;
  spdlog::warn("{}", core::message_text(core::to_text(context) + reason +
                                        fmt::format(": the run ends at {} s, with the last whole "
                                                    "one",
                                                    core::to_text(stop_))));
}

/// A component that takes steps of one size only has made its last one before the end of the run.
void StepCheck::warn_of_last_own_steps() const {
  for (std::size_t i = 0; i < resolved_.fmus.size(); ++i) {
    const core::Component& component = system_.components()[i];
    if (component.description->can_vary_step || !component.keeps_own_step()) continue;
    const core::Grid grid = grids_.grid_of(i);
    if (grid.ends_at(stop_)) continue;
    const Time last = grid.last_point(stop_);
    const core::Context context{resolved_.components()[i].where, component.name, {}, {}};
    const std::string reason =
        fmt::format("the unit takes steps of one size only, {} s, none of which ends at {} s",
                    core::to_text(grids_.step_of(i)), core::to_text(stop_));
    if (last == options_.start) {
      core::fail_input(context, reason,
                       fmt::format("stop at a multiple of them, at {} s or later",
                                   core::to_text(grid.point(1))));
    }
    spdlog::warn("{}{}: its last one ends at {} s, and its outputs hold from there on",
                 core::to_text(context), reason, core::to_text(last));
  }
}

void StepCheck::warn_of_internal_steps() const {
  for (std::size_t i = 0; i < resolved_.fmus.size(); ++i) {
    const auto& internal = resolved_.fmus[i]->description()->fixed_internal_step;
    if (!internal || grids_.step_of(i).is_multiple_of(*internal)) continue;
    log_.write(resolved_.components()[i].name, importer::Status::Warning, "stride",
               fmt::format("its internal step of {} s is not part of the communication step of "
                           "{} s, so it is not always where the others are",
                           core::to_text(*internal), core::to_text(grids_.step_of(i))));
  }
}

void StepCheck::warn_of_unlimited_steps() const {
  constexpr std::size_t kMostNames = 5;
  const std::vector<std::string> names = core::connections_without_events(system_);
  if (names.empty()) return;
  spdlog::warn(
      "values travel at events only, since nothing else ends a step, so what these outputs do "
      "meanwhile is missed: {}; <stride:Step maximum=\"…\"/> (--max-step) ends steps, or says "
      "with a long one that this is meant",
      core::abridged(names, kMostNames));
}

}  // namespace

ComponentSteps choose_steps(const ResolvedSystem& resolved, const StepSettings& request,
                            const PlannedTimes& times, core::RunOptions& options) {
  const auto set = set_component_steps(resolved, request);
  const bool are_all_set =
      std::ranges::all_of(set, [](const auto& step) { return step.has_value(); });
  std::optional<core::Interval> unit_step;
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    if (set[i] && !are_all_set) continue;
    const auto step = set[i] ? set[i] : declared_step(*resolved.fmus[i]->description());
    if (step) unit_step = std::min(unit_step.value_or(*step), *step);
  }
  options.step.size = unit_step.value_or(default_step(times.declared_length));
  const auto& vendor = resolved.scenario.vendor_step;
  const bool has_own_step = resolved.scenario.annotation.step.size || request.size;
  if (vendor && !has_own_step) {
    options.step.size = vendor->size;
    spdlog::warn(
        "{}the step is {} s, as {} of another tool has it; <stride:Step size=\"…\"/> "
        "or --step sets another one",
        core::to_text({.where = vendor->where}), core::to_text(vendor->size), vendor->tag);
  }
  resolved.scenario.annotation.step.apply(options);
  request.apply(options);
  check_requested(resolved, request, options.step);
  if (options.step.maximum && *options.step.maximum < options.step.minimum) {
    core::fail_input(
        resolved.of_file(),
        fmt::format("the maximum step of {} s is below the minimum of {} s",
                    core::to_text(*options.step.maximum), core::to_text(options.step.minimum)));
  }
  const core::StepOptions& step = options.step;
  if (step.policy->controls_error && step.relative_tolerance == 0 && step.absolute_tolerance == 0) {
    core::fail_input(resolved.of_file(), "both tolerances are 0, so no step is good enough",
                     "give a relative or an absolute tolerance above 0");
  }
  return own_steps(resolved, set, options, has_own_step || vendor);
}

Time check_steps(const core::System& system, const ResolvedSystem& resolved, bool has_stop,
                 const core::RunOptions& options, UnitLog& log) {
  return StepCheck(system, resolved, has_stop, options, log).run();
}

void warn_of_other_steps(const ResolvedSystem& resolved, const core::RunOptions& options,
                         UnitLog& log) {
  if (!options.step.policy->has_grid) return;
  const StepGrids grids(resolved.components(), options);
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    const core::UnitDescription& unit = *resolved.fmus[i]->description();
    if (unit.can_vary_step || !unit.default_step || *unit.default_step == grids.step_of(i)) {
      continue;
    }
    const std::string step = core::to_text(*unit.default_step);
    log.write(
        resolved.components()[i].name, importer::Status::Warning, "stride",
        fmt::format("it takes steps of one size only, and its DefaultExperiment has {} s, "
                    "but its steps are of {} s; if its times or values are wrong then, use "
                    "--step {}={}",
                    step, core::to_text(grids.step_of(i)), resolved.components()[i].name, step));
  }
}

}  // namespace stride::scenario
