#include "master/cli/scenario_options.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::cli {
namespace {

/// "jacobi|gauss-seidel"
template <class Choices>
std::string alternatives(const Choices& choices) {
  std::vector<std::string> words;
  for (const auto choice : choices) words.emplace_back(name(choice));
  return fmt::format("{}", fmt::join(words, "|"));
}

/// An option whose text the setter takes.
CLI::Option* add_choice(CLI::App& command, const std::string& name, io::StepChoice& choice,
                        void (io::StepChoice::*set)(std::string_view), const std::string& help) {
  return command.add_option_function<std::string>(
      name,
      [&choice, name, set](const std::string& text) {
        try {
          (choice.*set)(text);
        } catch (const std::invalid_argument& mistake) {
          core::fail_input({}, fmt::format("{} {}: {}", name, text, mistake.what()));
        }
      },
      help);
}

void add_step_options(CLI::App& command, io::StepChoice& choice) {
  using io::StepChoice;
  add_choice(command, "--step", choice, &StepChoice::set_size,
             "Length of the communication steps; of the first one where the error controls them")
      ->type_name("SECONDS");
  add_choice(command, "--policy", choice, &StepChoice::set_policy, "What decides on the steps")
      ->type_name(alternatives(core::kStepPolicies));
  add_choice(command, "--max-step", choice, &StepChoice::set_maximum, "No step is longer")
      ->type_name("SECONDS");
  add_choice(command, "--min-step", choice, &StepChoice::set_minimum,
             "No shorter one is tried after a rejection")
      ->type_name("SECONDS");
  add_choice(command, "--relative-tolerance", choice, &StepChoice::set_relative_tolerance,
             "Of the inputs, where their error controls the steps")
      ->type_name("NUMBER");
  add_choice(command, "--absolute-tolerance", choice, &StepChoice::set_absolute_tolerance,
             "Likewise, in the unit of the output that feeds the input")
      ->type_name("NUMBER");
  add_choice(
      command, "--coupling", choice, &StepChoice::set_coupling,
      "What a unit sees of the others during a step: what they were at its begin, or, of those "
      "that have stepped before it, where they are")
      ->type_name(alternatives(core::kCouplings));
  add_choice(command, "--extrapolation", choice, &StepChoice::set_extrapolation,
             "How inputs go on during a step")
      ->type_name(alternatives(core::kExtrapolations));
}

void add_host_options(CLI::App& command, HostRequest& request) {
  // a flag, so that what follows a blank is the scenario; without a value it is "true"
  command
      .add_flag("--isolate", request.isolated,
                "A process of its own for each unit, or as --isolate=COMPONENT, with a glob, for "
                "some; may be given several times")
      ->transform([](const std::string& value) { return value == "true" ? "*" : value; });
  command
      .add_option(
          "--unit-timeout", request.unit_timeout,
          "How long a call of a unit with a process of its own may take; goes before what the "
          "scenario says")
      ->type_name("SECONDS");
  command.add_flag(
      "--no-sandbox", request.no_sandbox,
      "Let units with processes of their own do whatever you may; goes before what the scenario "
      "says");
}

}  // namespace

void add_scenario_options(CLI::App& command, ScenarioRequest& request) {
  command
      .add_option("FILE", request.scenario,
                  "The scenario: an SSP system file (.ssd) or package (.ssp)")
      ->required()
      ->type_name("");
  command.add_option("--stop", request.stop, "Simulated time at which to end")
      ->type_name("SECONDS");
  add_step_options(command, request.step);
  command.add_flag("--no-idle-skip", request.no_idle_skip,
                   "Call every unit in every step, also those that promise to be idle");
  command
      .add_option("--max-skip", request.max_skip,
                  "For how long an idle unit is left alone at most; 1 if neither this nor the "
                  "scenario says it")
      ->type_name("SECONDS");
  command.add_flag("--no-checks", request.no_checks,
                   "Do not judge by the scenario's checks, as for a run that is to be another");
  add_host_options(command, request.hosts);
  command
      .add_option("--set", request.sets,
                  "Start value of a parameter or input; may be given several times")
      ->type_name("COMPONENT.VARIABLE=VALUE")
      ->allow_extra_args(false);
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

}  // namespace stride::cli
