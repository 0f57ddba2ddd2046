// stride coverage: what runs and campaigns have covered together.
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/front/cli/coverage/coverage_table.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/output.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/merge.h"
#include "master/observe/coverage/ucis.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/results/output_paths.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct CoverageArguments {
  std::vector<fs::path> paths;
  fs::path out, ucis;  ///< empty: none
  bool missing = false;
};

/// The file itself, or that of a folder.
fs::path coverage_file(const fs::path& path) {
  if (!core::is_folder(path)) return path;
  const fs::path file = path / coverage::kCoverageFile;
  if (core::is_file(file)) return file;
  core::fail_input({.where = {path.string(), 0}},
                   fmt::format("there is no {} in this folder", coverage::kCoverageFile),
                   "name the results of a run with coverage, or a campaign whose table was made");
}

/// What is named twice would count twice.
void require_different(const std::vector<fs::path>& files) {
  std::map<fs::path, const fs::path*> known;
  for (const fs::path& file : files) {
    const auto [first, is_new] = known.emplace(recorders::resolved(file), &file);
    if (is_new) continue;
    core::fail_input({.where = {file.string(), 0}},
                     fmt::format("this is {}, too, and would count twice", first->second->string()),
                     "name it once");
  }
}

struct Merged {
  coverage::Report report;
  FilesOfPoints where;
};

Merged merged(const std::vector<fs::path>& files) {
  constexpr std::size_t kMostNames = 3;
  Merged merged;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> having;
  for (const fs::path& file : files) {
    const coverage::Report report = coverage::read_coverage(file);
    for (const coverage::GroupReport& group : report.groups) {
      for (const coverage::PointReport& point : group.points) {
        having[{group.component, point.definition}].push_back(file.string());
      }
    }
    try {
      coverage::merge(merged.report, report);
    } catch (const std::invalid_argument& mistake) {
      core::fail_input({.where = {file.string(), 0}}, mistake.what(),
                       "one of the files is not as stride has written it");
    }
  }
  if (files.size() == 1) return merged;
  for (const auto& [point, all] : having) merged.where[point] = core::abridged(all, kMostNames);
  return merged;
}

/// It has to say when it was written.
void write_ucis(const fs::path& file, const coverage::Report& report,
                const std::vector<fs::path>& files) {
  const std::string now = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(std::time(nullptr)));
  core::Replacement output(file);
  output.file().write(coverage::ucis_document(report, {files, STRIDE_VERSION, now}));
  output.commit();
}

void show_coverage(const CoverageArguments& arguments) {
  std::vector<fs::path> files;
  std::vector<results::KeptPath> inputs;
  for (const fs::path& path : arguments.paths) {
    files.push_back(coverage_file(path));
    inputs.push_back({files.back(), "a coverage that is read"});
  }
  std::vector<results::OutputPath> outputs;
  if (!arguments.out.empty()) outputs.push_back({"--out " + arguments.out.string(), arguments.out});
  if (!arguments.ucis.empty()) {
    outputs.push_back({"--ucis " + arguments.ucis.string(), arguments.ucis});
  }
  results::refuse_kept_paths(outputs, inputs);
  require_different(files);
  const auto& [report, where] = merged(files);
  if (!arguments.out.empty()) coverage::write_coverage(arguments.out, report);
  if (!arguments.ucis.empty()) write_ucis(arguments.ucis, report, files);
  print_text("{}{}{}", coverage_table(report), told_apart_table(report, where),
             arguments.missing ? missing_table(report) : "");
}

}  // namespace

void add_coverage(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("coverage", "Show what runs and campaigns have covered together");
  const auto arguments = std::make_shared<CoverageArguments>();
  command
      ->add_option("PATH", arguments->paths, "Results of runs, campaigns, or files coverage.json")
      ->required()
      ->type_name("");
  command->add_option("--out,--output,-o", arguments->out, "Write the merged coverage to this file")
      ->type_name("FILE");
  command
      ->add_option("--ucis", arguments->ucis,
                   "Write it to this file in the XML of Accellera's UCIS, for coverage tools")
      ->type_name("FILE");
  command->add_flag("--missing", arguments->missing, "List the bins that are not covered yet");
  command->callback([arguments] { show_coverage(*arguments); });
}

}  // namespace stride::cli
