#include "master/study/results/report_page.h"

#include "master/report/page.h"
#include "master/report/report.h"

namespace stride::results {

bool has_reports() { return !report::page().empty(); }

std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const recorders::ResultFiles& files,
                                      const std::filesystem::path& report) {
  const report::Results results = report::read_results(folder, files);
  report::write_report(report, results, STRIDE_VERSION);
  return results.notes;
}

std::string live_report(const std::filesystem::path& folder, const recorders::ResultFiles& files,
                        bool is_over) {
  using report::RunState;
  const RunState state = is_over ? RunState::Over : RunState::GoingOn;
  return report::live_report(report::read_results(folder, files, {}, state), STRIDE_VERSION);
}

}  // namespace stride::results
