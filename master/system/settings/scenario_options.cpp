#include "master/system/settings/scenario_options.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/parse_option.h"
#include "master/system/declaration/scenario_path.h"
#include "master/system/ssp/parameters.h"

namespace stride::settings {
namespace {

constexpr int kMostThreads = 1024;

/// "jacobi|gauss-seidel"
template <class Choices>
std::string alternatives(const Choices& choices) {
  std::vector<std::string> words;
  for (const auto choice : choices) words.emplace_back(name(choice));
  return fmt::format("{}", fmt::join(words, "|"));
}

/// An option whose text the setter takes.
CLI::Option* add_setting(CLI::App& command, const std::string& name,
                         scenario::StepSettings& settings,
                         void (scenario::StepSettings::*set)(std::string_view),
                         const std::string& help) {
  return command.add_option_function<std::string>(
      name,
      [&settings, name, set](const std::string& text) {
        core::parse_option(name, text, [&](std::string_view value) { (settings.*set)(value); });
      },
      help);
}

void add_step_options(CLI::App& command, scenario::StepSettings& settings) {
  using scenario::StepSettings;
  command
      .add_option_function<std::vector<std::string>>(
          "--step",
          [&settings](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              core::parse_option("--step", text,
                                 [&](std::string_view value) { settings.set_step(value); });
            }
          },
          "Communication step size; that of the first step with error control; or the step of some "
          "components alone, COMPONENT a glob; may be given several times")
      ->type_name("[COMPONENT=]SECONDS")
      ->allow_extra_args(false);
  add_setting(command, "--policy", settings, &StepSettings::set_policy,
              "How the next communication point is chosen")
      ->type_name(alternatives(core::kStepPolicies));
  add_setting(command, "--max-step", settings, &StepSettings::set_maximum,
              "Upper limit of the step size")
      ->type_name("SECONDS");
  add_setting(command, "--min-step", settings, &StepSettings::set_minimum,
              "Lower limit of the step size after a rejected step")
      ->type_name("SECONDS");
  add_setting(command, "--relative-tolerance", settings, &StepSettings::set_relative_tolerance,
              "Relative tolerance of the inputs, with error control")
      ->type_name("NUMBER");
  add_setting(
      command, "--absolute-tolerance", settings, &StepSettings::set_absolute_tolerance,
      "Absolute tolerance of the inputs, in the unit of measure of the output that feeds the input")
      ->type_name("NUMBER");
  add_setting(
      command, "--coupling", settings, &StepSettings::set_coupling,
      "Inputs of a unit during a step: the outputs at its start, or, from units that have stepped "
      "before it, those at its end")
      ->type_name(alternatives(core::kCouplings));
  add_setting(command, "--extrapolation", settings, &StepSettings::set_extrapolation,
              "How inputs are extrapolated during a step")
      ->type_name(alternatives(core::kExtrapolations));
}

void add_host_options(CLI::App& command, scenario::HostRequest& request) {
  // a flag, so that what follows a blank is the scenario; without a value it is "true"
  command
      .add_flag("--isolate", request.hosted,
                "Run each unit in a process of its own, or with --isolate=COMPONENT, a glob, some "
                "units; may be given several times")
      ->transform([](const std::string& value) { return value == "true" ? "*" : value; });
  command
      .add_option("--at", request.places,
                  "Run the matching units on another machine, ssh://user@machine, or behind a "
                  "command, exec:COMMAND; may be given several times")
      ->type_name("COMPONENT=PLACE")
      ->allow_extra_args(false);
  command
      .add_option("--unit-timeout", request.unit_timeout,
                  "Time limit of a call of a unit in a process of its own; overrides the scenario")
      ->type_name("SECONDS");
  command.add_flag("--no-sandbox", request.no_sandbox,
                   "Run units in processes of their own without a sandbox; overrides the scenario");
}

struct ParameterFiles {
  std::filesystem::path set, mapping;
};

/// "FILE.ssv:MAPPING.ssm", unless a file has this name.
ParameterFiles parameter_files(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || core::path_exists(text)) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::vector<ssp::ParameterValue> read_parameters(scenario::ScenarioRequest& request,
                                                 const ParameterFiles& files,
                                                 std::vector<std::string>& warnings) {
  request.parameter_files.push_back(files.set);
  std::vector<ssp::ParameterValue> values = ssp::read_parameter_set(files.set, warnings);
  if (files.mapping.empty()) return values;
  request.parameter_files.push_back(files.mapping);
  return ssp::map_parameters(files.mapping, values, warnings);
}

/// A value for what is not there is a mistake, as it is of --set.
void add_parameters(scenario::ScenarioRequest& request, const std::vector<std::string>& texts) {
  std::size_t count = 0;
  for (const std::string& text : texts) {
    std::vector<std::string> warnings;
    ++count;
    for (ssp::ParameterValue& value : read_parameters(request, parameter_files(text), warnings)) {
      value.is_required = true;
      value.binding = count;
      request.parameters.push_back(std::move(value));
    }
    for (const std::string& warning : warnings) spdlog::warn("{}", core::message_text(warning));
  }
}

}  // namespace

void add_intervention_options(CLI::App& command, scenario::ScenarioRequest& request) {
  const auto add = [&](const char* option, std::vector<std::string>& texts, const char* form,
                       const std::string& help) {
    command.add_option(option, texts, help + "; may be given several times")
        ->type_name(form)
        ->allow_extra_args(false);
  };
  add("--set-at", request.set_at, "COMPONENT.VARIABLE=VALUE@SECONDS",
      "Value that a tunable parameter, or an input without a source, gets in the middle of the "
      "run");
  add("--force", request.forces, "COMPONENT.VARIABLE[=VALUE]@SECONDS..[SECONDS]",
      "Value of a connected input for some time, whatever its source gives; without a value it is "
      "held at what it has");
  add("--drop", request.drops, "COMPONENT.VARIABLE@SECONDS..[SECONDS]",
      "Time for which an input, or an input clock, receives no messages");
  add("--delay", request.delays, "COMPONENT.VARIABLE=SECONDS@SECONDS..[SECONDS]",
      "How much later an input, or an input clock, receives the messages of some time");
  add("--corrupt", request.corruptions,
      "COMPONENT.VARIABLE[=BITS[,HEADER[,SEED]]]@SECONDS..[SECONDS]",
      "How many bits are inverted in each message that an input receives in some time, 1 if left "
      "out, how many first bytes are left alone, and the seed that chooses the bits");
}

void add_scenario_argument(CLI::App& command, std::filesystem::path& scenario,
                           const std::string& kinds) {
  command
      .add_option_function<std::string>(
          "SCENARIO",
          [&scenario](const std::string& text) {
            scenario = scenario::named_scenario(text).value_or(text);
          },
          fmt::format("{}, or the name of a scenario that comes with stride", kinds))
      ->required()
      ->type_name("");
}

void add_scenario_options(CLI::App& command, scenario::ScenarioRequest& request) {
  add_scenario_argument(
      command, request.scenario,
      "An SSP system file (.ssd) or package (.ssp), an FMU (.fmu) or a table (.csv, "
      ".parquet, .mcap) alone");
  command.add_option("--start", request.start, "Simulated time at which to begin")
      ->type_name("SECONDS");
  command.add_option("--stop", request.stop, "Simulated time at which to end")
      ->type_name("SECONDS");
  add_step_options(command, request.step);
  command.add_flag("--no-idle-skip", request.no_idle_skip,
                   "Step every unit in every step, also while it promises to be idle");
  command
      .add_option("--max-skip", request.max_skip,
                  "Longest time for which an idle unit is suspended; 1 if the scenario has none")
      ->type_name("SECONDS");
  command.add_flag("--no-checks", request.no_checks, "Ignore the scenario's checks");
  command.add_flag("--no-coverage", request.no_coverage,
                   "Ignore the scenario's coverage, and checks of it");
  add_host_options(command, request.hosts);
  command
      .add_option_function<std::vector<std::string>>(
          "--parameters",
          [&request](const std::vector<std::string>& texts) { add_parameters(request, texts); },
          "Parameter set (.ssv) whose values replace those of the scenario; FILE.ssv:MAPPING.ssm "
          "applies a parameter mapping to it; may be given several times")
      ->type_name("FILE.ssv")
      ->allow_extra_args(false);
  command
      .add_option("--set", request.sets,
                  "Start value of a parameter or input; may be given several times")
      ->type_name("COMPONENT.VARIABLE=VALUE")
      ->allow_extra_args(false);
  add_intervention_options(command, request);
  command
      .add_option("--swap", request.swaps,
                  "Another unit for a component; may be given several times")
      ->type_name("COMPONENT=FILE.fmu")
      ->allow_extra_args(false);
  command
      .add_option(
          "--signals", request.signals,
          "Which variables to record, instead of the scenario's choice, such as 'sensor.*'; "
          "may be given several times")
      ->type_name("GLOB")
      ->allow_extra_args(false);
}

void add_observation_options(CLI::App& command, scenario::ScenarioRequest& request) {
  command
      .add_option("--coverage", request.coverage,
                  "Count which values and messages a component is given, as the scenario may ask "
                  "itself; may be given several times")
      ->type_name("COMPONENT")
      ->allow_extra_args(false);
  // a flag, so that what follows a blank is the scenario; the value of a flag without one is
  // "true", kUnspecifiedInterval
  command.add_flag("--film", request.film,
                   "Pictures of the MuJoCo worlds in units/COMPONENT/film/, every 0.1 s of "
                   "simulated time, or as in --film=SECONDS");
  command.add_flag(
      "--scene", request.scene,
      "Scenes of the MuJoCo worlds in units/COMPONENT/world.glb (glTF), with their poses "
      "every 0.1 s of simulated time, or as in --scene=SECONDS");
}

void add_thread_option(CLI::App& command, std::size_t& threads) {
  command
      .add_option("--threads", threads,
                  "Step units on up to N threads where that is faster; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads));
}

}  // namespace stride::settings
