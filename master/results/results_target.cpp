#include "master/results/results_target.h"

#include "master/recorders/run_json.h"
#include "master/results/report_page.h"
#include "master/util/input_file.h"

namespace stride::results {

void add_error(const ResultsTarget& target, const std::string& error, std::optional<Time> reached) {
  const auto& [folder, files] = target;
  const std::filesystem::path run_file = folder / files.statistics;
  if (files.statistics.empty() || !core::is_file(run_file)) return;
  if (!recorders::add_error(run_file, error, reached) || files.report.empty()) return;
  write_report(folder, files, folder / files.report);
}

}  // namespace stride::results
