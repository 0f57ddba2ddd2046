#include "master/study/results/results_target.h"

#include "master/base/files/input_file.h"
#include "master/observe/recorders/run_json.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/report_page.h"

namespace stride::results {

recorders::ResultFiles possible_files(const scenario::RunPlan& loaded) {
  recorders::ResultFiles files = loaded.scenario().annotation.results;
  if (loaded.coverage().empty()) files.coverage.clear();
  if (!has_reports()) files.report.clear();
  return files;
}

core::RunOptions options_for(const scenario::RunPlan& loaded, const recorders::ResultFiles& files) {
  core::RunOptions options = loaded.options();
  if (files.signals.empty() && files.trace.empty()) options.recorded.clear();
  return options;
}

void make_folder(const ResultsTarget& target, const scenario::RunPlan& loaded) {
  refuse_results(target.folder, loaded.scenario().annotation.results, inputs_of(loaded));
  recorders::make_results_folder(target.folder);
  recorders::check_name_lengths(target.folder, target.files);
}

void add_error(const ResultsTarget& target, const std::string& error, std::optional<Time> reached) {
  const auto& [folder, files] = target;
  const std::filesystem::path run_file = folder / files.statistics;
  if (files.statistics.empty() || !core::is_file(run_file)) return;
  if (!recorders::add_error(run_file, error, reached) || files.report.empty()) return;
  write_report(folder, files, folder / files.report);
}

}  // namespace stride::results
