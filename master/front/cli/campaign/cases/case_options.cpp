#include "master/front/cli/campaign/cases/case_options.h"

#include <algorithm>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

namespace stride::cli {

CLI::Option* add_jobs_option(CLI::App& command, std::size_t& jobs) {
  return command
      .add_option("--jobs", jobs,
                  "How many cases run at the same time; otherwise as many as there are cores")
      ->type_name("N")
      ->check(CLI::Range(1, kMostCaseJobs));
}

std::size_t jobs_or_cores(std::size_t jobs) {
  if (jobs != 0) return jobs;
  return std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

void add_progress_options(CLI::App& command, std::optional<ProgressStyle>& progress, bool& quiet) {
  command
      .add_option_function<std::string>(
          "--progress",
          [&progress](const std::string& text) { progress = read_progress_style(text); },
          "How to show progress: automatically (on a terminal a line that is rewritten, elsewhere "
          "a line now and then), in plain lines, in JSON objects for programs, or not at all")
      ->type_name("auto|plain|json|none");
  command.add_flag("--quiet,-q", quiet, "Print nothing but warnings and errors");
}

ProgressStyle chosen_style(const std::optional<ProgressStyle>& progress, bool quiet) {
  return progress.value_or(quiet ? ProgressStyle::None : ProgressStyle::Auto);
}

}  // namespace stride::cli
