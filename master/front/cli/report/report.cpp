// stride report: the page of a run, from its results folder.
#include <filesystem>
#include <memory>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/run/result_folders.h"
#include "master/front/cli/terminal/browser.h"
#include "master/report/results.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/report_page.h"

namespace stride::cli {
namespace {

struct ReportArguments {
  std::filesystem::path folder;
  std::filesystem::path out;
  bool open = false;
};

/// The page of the run may be replaced, and no other file of its results.
void check_output_path(const ReportArguments& arguments, recorders::ResultFiles files) {
  const results::OutputPath output{"--output " + arguments.out.string(), arguments.out};
  files.report.clear();
  refuse_result_folders(arguments.folder, output);
  results::refuse_kept_paths({&output, 1}, results::kept_results(arguments.folder, files));
}

/// The name comes from run.json, which may be anything.
void check_page(const std::filesystem::path& folder, const std::string& name,
                recorders::ResultFiles files) {
  const results::OutputPath page{fmt::format("files.report of run.json, '{}'", name),
                                 folder / name};
  files.report.clear();
  results::refuse_kept_paths({&page, 1}, results::kept_results(folder, files));
  constexpr std::string_view kBegin = "<!DOCTYPE html";
  if (!core::is_file(page.file) || core::head_of(page.file, kBegin.size()) == kBegin) return;
  core::fail_input({.where = {page.file.string(), 0}},
                   "this is no page, and would be replaced by the report",
                   "write the report elsewhere, with --output");
}

void make_report(const ReportArguments& arguments) {
  const recorders::ResultFiles files = report::result_files(arguments.folder);
  const std::string& name = files.report.empty() ? recorders::ResultFiles().report : files.report;
  const std::filesystem::path file =
      arguments.out.empty() ? arguments.folder / name : arguments.out;
  if (arguments.out.empty()) {
    check_page(arguments.folder, name, files);
  } else {
    check_output_path(arguments, files);
  }
  for (const std::string& note : results::write_report(arguments.folder, files, file)) {
    spdlog::warn("{}", note);
  }
  print_text("Report in {}\n", file.string());
  if (arguments.open) open_in_browser(file);
}

}  // namespace

void add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Make the page of a run");
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("FOLDER", arguments->folder, "The results of a run")
      ->required()
      ->type_name("");
  command->add_option("--output,--out,-o", arguments->out, "Write there instead of into the folder")
      ->type_name("FILE");
  command->add_flag("--open", arguments->open, "Open the page in a browser");
  command->callback([arguments] { make_report(*arguments); });
}

}  // namespace stride::cli
