// stride compare: two results side by side.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/parse_option.h"
#include "master/base/text/number_text.h"
#include "master/base/time_text.h"
#include "master/front/cli/compare/comparison_table.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/exit.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/run/result_folders.h"
#include "master/report/results.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/compare/comparison_json.h"
#include "master/study/compare/comparison_page.h"
#include "master/study/results/output_paths.h"

namespace stride::cli {
namespace {

struct CompareArguments {
  std::filesystem::path a, b;
  std::string absolute = "0", relative = "0";
  std::optional<std::string> time_tolerance;  ///< empty: none
  std::vector<std::string> tolerances;
  std::vector<std::string> only, ignored;
  std::filesystem::path json;  ///< empty: none
  std::filesystem::path page;  ///< likewise
  bool is_golden = false;
};

compare::Settings settings_of(const CompareArguments& arguments) {
  compare::Settings settings{
      .only = arguments.only, .ignored = arguments.ignored, .is_golden = arguments.is_golden};
  settings.tolerance = {
      core::parse_option("--absolute", arguments.absolute, core::parse_at_least_zero),
      core::parse_option("--relative", arguments.relative, core::parse_at_least_zero)};
  if (arguments.time_tolerance) {
    settings.time_tolerance =
        core::parse_option("--time-tolerance", *arguments.time_tolerance, core::parse_seconds);
  }
  for (const std::string& text : arguments.tolerances) {
    settings.tolerances.push_back(compare::parse_tolerance(text));
  }
  return settings;
}

/// A campaign is many runs.
void refuse_campaign(const std::filesystem::path& folder) {
  for (const char* file : {campaign::kPlanDescription, campaign::kSearchDescription}) {
    if (!core::path_exists(folder / file)) continue;
    core::fail_input({.where = {folder.string(), 0}}, "this is a folder of many runs",
                     "compare the results of one case with each other: stride compare "
                     "A/cases/000/000017 B/cases/000/000017");
  }
}

std::vector<results::OutputPath> output_paths(const CompareArguments& arguments) {
  std::vector<results::OutputPath> paths;
  const auto add = [&](const char* option, const std::filesystem::path& file) {
    if (!file.empty()) paths.push_back({fmt::format("{} {}", option, file.string()), file});
  };
  add("--json", arguments.json);
  add("--html", arguments.page);
  return paths;
}

void check_output_paths(const CompareArguments& arguments) {
  const std::vector<results::OutputPath> outputs = output_paths(arguments);
  results::refuse_shared_paths(outputs);
  for (const std::filesystem::path& folder : {arguments.a, arguments.b}) {
    for (const results::OutputPath& output : outputs) refuse_result_folders(folder, output);
    results::refuse_kept_paths(outputs,
                               results::kept_results(folder, report::result_files(folder)));
  }
}

/// 1 would say that they differ.
void write_files(const CompareArguments& arguments, const compare::Comparison& comparison,
                 const compare::Settings& settings) {
  try {
    if (!arguments.json.empty()) compare::write_comparison(arguments.json, comparison, settings);
    if (!arguments.page.empty()) {
      compare::write_comparison_page(arguments.page, comparison, settings, STRIDE_VERSION);
    }
  } catch (const core::Error& failure) {
    throw core::Error(core::Error::Kind::Input, failure.context(), failure.message(),
                      failure.hint());
  }
}

void compare_folders(const CompareArguments& arguments) {
  refuse_campaign(arguments.a);
  refuse_campaign(arguments.b);
  const compare::Settings settings = settings_of(arguments);
  check_output_paths(arguments);
  const compare::Comparison comparison =
      compare::compare_results(arguments.a, arguments.b, settings);
  print_warnings(comparison.notes);
  write_files(arguments, comparison, settings);
  print_text("{}", comparison_text(comparison));
  if (!comparison.differences.empty()) throw CLI::RuntimeError(kRunFailed);
}

}  // namespace

void add_compare(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("compare", "Show where two results differ first, and in what");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("A", arguments->a, "The results of a run")->required()->type_name("FOLDER");
  command
      ->add_option("B", arguments->b,
                   "Those to compare them with, to which relative differences are")
      ->required()
      ->type_name("FOLDER");
  command
      ->add_option("--absolute", arguments->absolute,
                   "Reals may differ by so much, in their units of measure; 0 otherwise")
      ->type_name("NUMBER");
  command
      ->add_option("--relative", arguments->relative,
                   "Reals may differ by so much of the value in B in addition; 0 otherwise")
      ->type_name("NUMBER");
  command
      ->add_option("--tolerance", arguments->tolerances,
                   "Likewise of the matching signals, instead; may be given several times")
      ->type_name("SIGNAL=ABSOLUTE[,RELATIVE]")
      ->allow_extra_args(false);
  command
      ->add_option("--time-tolerance", arguments->time_tolerance,
                   "Instants may differ by so much, and signals are compared as curves, at the "
                   "instants of both runs; 0 for runs that step differently")
      ->type_name("SECONDS");
  command
      ->add_option("--only", arguments->only,
                   "Compare the matching signals and messages alone; may be given several times")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  command
      ->add_option("--ignore", arguments->ignored,
                   "Leave the matching signals and messages out; may be given several times")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  command->add_flag("--golden", arguments->is_golden,
                    "B is kept as a reference: compare what it has, at its instants, within its "
                    "tolerances.csv");
  command->add_option("--json", arguments->json, "Write all differences to this file")
      ->type_name("FILE");
  command
      ->add_option("--html", arguments->page,
                   "Write a page with all differences, and the curves of both over each other")
      ->type_name("FILE");
  command->footer("Exit codes: 0 they are equal, 1 they differ, 2 the input was wrong.");
  command->callback([arguments] { compare_folders(*arguments); });
}

}  // namespace stride::cli
