#include "master/front/cli/run/run_arguments.h"

#include <CLI/CLI.hpp>

#include "master/base/error.h"
#include "master/front/cli/run/live/real_time.h"
#include "master/system/declaration/scenario.h"
#include "master/system/settings/scenario_options.h"

namespace stride::cli {
namespace {

void add_recording_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--out,--output,-o", arguments.out,
                  "Results folder; otherwise results/ and the scenario's name")
      ->type_name("FOLDER");
  command
      .add_option("--capture", arguments.captures,
                  "Write all inputs of a component to a file that can be replayed to it alone; may "
                  "be given several times")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  settings::add_observation_options(command, arguments.scenario);
  command.add_flag("--no-report", arguments.no_report, "Write no report.html");
  command.add_flag("--no-trace", arguments.no_trace, "Write no signals.vcd");
}

}  // namespace

std::filesystem::path results_folder(const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return std::filesystem::path("results") / scenario::stem(arguments.scenario.scenario);
}

void add_thread_and_junit_options(CLI::App& command, RunArguments& arguments) {
  settings::add_thread_option(command, arguments.threads);
  command
      .add_option_function<std::string>(
          "--junit",
          [&](const std::string& file) {
            if (file.empty()) core::fail_input({}, "--junit: no file is named");
            arguments.junit = file;
          },
          "Write a test report in the XML of JUnit, with a test case for the run, each "
          "check and each unit's verdict")
      ->type_name("FILE");
}

void add_display_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--progress",
          [&](const std::string& text) { arguments.progress = read_progress_style(text); },
          "How to show progress: automatically (on a terminal a line that is rewritten, elsewhere "
          "a line now and then), in plain lines, in JSON objects for programs, or not at all")
      ->type_name("auto|plain|json|none");
  command
      .add_option_function<std::string>(
          "--realtime",
          [&](const std::string& text) { arguments.real_time = parse_real_time_factor(text); },
          "Let the run wait for the wall clock where it is ahead of it; 1 is real time, 2 twice as "
          "fast")
      ->type_name("FACTOR");
  // a flag, so that what follows a blank is the scenario
  command.add_flag("--live", arguments.live,
                   "Serve the report to browsers on this machine while the run goes on, at a free "
                   "port unless one is named");
  command.add_flag(
      "--open", arguments.open,
      "Open the report in a browser when the run is over; with --live, when it begins");
  command.add_flag("--quiet,-q", arguments.quiet, "Print nothing but warnings and errors");
}

void add_run_options(CLI::App& command, RunArguments& arguments) {
  settings::add_scenario_options(command, arguments.scenario);
  add_recording_options(command, arguments);
  add_thread_and_junit_options(command, arguments);
  add_checkpoint_options(command, arguments.checkpoints);
  add_branch_options(command, arguments.branches);
  add_display_options(command, arguments);
}

}  // namespace stride::cli
