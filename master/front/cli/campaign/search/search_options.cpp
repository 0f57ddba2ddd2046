#include "master/front/cli/campaign/search/search_options.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "master/front/cli/campaign/cases/case_options.h"

namespace stride::cli {
namespace {

constexpr std::uint64_t kMostRuns = 100'000;
constexpr std::uint64_t kMostSeed = 1'000'000'000;

void add_request_options(CLI::App& command, search::Request& request) {
  command
      .add_option("--runs", request.runs,
                  "How many cases are run at most, the scenario itself included; 200 otherwise. A "
                  "search goes on with more of them, where it was")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, kMostRuns));
  command
      .add_option_function<std::string>(
          "--method",
          [&request](const std::string& text) {
            for (const search::Method method : search::kMethods) {
              if (text == search::name(method)) return void(request.method = method);
            }
            throw CLI::ValidationError("--method",
                                       "'" + text + "' is none of cma-es, de and random");
          },
          "How it searches: by adaptation of a covariance matrix (the default), by differential "
          "evolution, or at random, to compare with")
      ->type_name("cma-es|de|random");
  command.add_option("--seed", request.seed, "Of the search's random numbers; 1 otherwise")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{0}, kMostSeed));
  command
      .add_option("--check", request.check,
                  "Minimise the margin of this check alone, and take nothing else for a failure; "
                  "otherwise the least of all")
      ->type_name("NAME")
      ->check([](const std::string& text) { return text.empty() ? "its name is empty" : ""; });
  command.add_flag("--all", request.finds_all,
                   "Go on behind the first failure, and look for others");
}

/// For a cluster, and for other runners.
void add_runner_options(CLI::App& command, SearchArguments& arguments) {
  CLI::Option* const on = add_cluster_options(command, arguments.cluster, "as many as --jobs");
  on->description(
      "Run the cases of each generation on a cluster with this workload manager, as an array of "
      "jobs, and wait for it");
  CLI::Option* const dry =
      command.add_flag("--dry-run", arguments.is_dry,
                       "Print the script of the jobs of the present generation; submit and write "
                       "nothing");
  dry->needs(on);
  CLI::Option* const range =
      add_cases_option(command, arguments.range,
                       "Run those of these cases of the present generation that have no record, "
                       "and make no table: for other runners, which may run several such parts "
                       "at the same time")
          ->excludes(on);
  command
      .add_flag("--next", arguments.lists_next,
                "Print which cases of the present generation have no record, each in a line, and "
                "run nothing; none if the search is over")
      ->excludes(on)
      ->excludes(range);
}

}  // namespace

void add_search_options(CLI::App& command, SearchArguments& arguments) {
  add_campaign_options(command, arguments.campaign);
  command.get_option("--out")->description(
      "Folder of the search; otherwise campaigns/ and the name of FILE with .search");
  add_request_options(command, arguments.request);
  add_jobs_option(command, arguments.jobs)
      ->description(
          "How many cases run at the same time; otherwise as many as there are cores. On a "
          "cluster, how many of a job, which gets as many processors; 1 otherwise");
  add_runner_options(command, arguments);
  add_progress_options(command, arguments.progress, arguments.quiet);
}

std::size_t cases_side_by_side(const SearchArguments& arguments) {
  return std::max<std::size_t>(arguments.jobs, 1);
}

std::vector<std::string> part_words(const SearchArguments& arguments,
                                    const std::filesystem::path& folder) {
  const search::Request& request = arguments.request;
  std::vector<std::string> words{"campaign",
                                 "search",
                                 arguments.campaign.file.string(),
                                 "--out",
                                 folder.string(),
                                 "--method",
                                 search::name(request.method),
                                 "--seed",
                                 std::to_string(request.seed),
                                 "--runs",
                                 std::to_string(request.runs)};
  if (!request.check.empty()) words.push_back("--check=" + request.check);
  if (request.finds_all) words.emplace_back("--all");
  words.insert(words.end(), {"--jobs", std::to_string(cases_side_by_side(arguments)), "--cases"});
  return words;
}

}  // namespace stride::cli
