#include "master/cli/test_report.h"

#include <climits>
#include <utility>

#include <unistd.h>

#include "master/scenario/scenario.h"
#include "master/util/error.h"
#include "master/util/replacement.h"
#include "master/util/time_text.h"

namespace stride::cli {
namespace {

std::string host_name() {
  char name[HOST_NAME_MAX + 1] = {};
  return ::gethostname(name, HOST_NAME_MAX) == 0 ? name : "localhost";
}

}  // namespace

TestReport::TestReport(std::filesystem::path file, const std::filesystem::path& scenario)
    : file_(std::move(file)) {
  if (file_.empty()) return;
  std::error_code ignored;  // without the folder the file cannot be made, which is an error then
  std::filesystem::create_directories(file_.parent_path(), ignored);
  report_.suite = scenario::stem(scenario);
  report_.host = host_name();
  report_.began = std::chrono::system_clock::now();
  report_.properties = {{"scenario", scenario.string()}, {"stride", STRIDE_VERSION}};
  report_.error = "the run has not ended";
  if (std::filesystem::is_fifo(file_, ignored)) pipe_.emplace(file_);
  if (!core::Replacement::is_at_once(file_)) put();
}

void TestReport::write(const core::RunOptions& options, const core::RunStatistics& statistics,
                       std::span<const core::Verdict> verdicts,
                       const std::optional<std::string>& error) {
  is_written_ = true;
  report_.wall_time = elapsed();
  report_.properties.emplace_back("start", core::to_text(options.start));
  report_.properties.emplace_back("stop", core::to_text(options.stop));
  report_.properties.emplace_back("reached", core::to_text(statistics.reached));
  report_.properties.emplace_back("outcome", error ? "failed" : core::name(statistics.end));
  report_.error = error;
  if (!error && statistics.end == core::RunEnd::Interrupted) {
    report_.error = "the run was interrupted at " + core::to_text(statistics.reached) + " s";
  }
  verdicts_.assign(verdicts.begin(), verdicts.end());
  report_.verdicts = verdicts_;
  put();
}

void TestReport::write(const std::string& error) {
  is_written_ = true;
  report_.wall_time = elapsed();
  report_.error = error;
  put();
}

void TestReport::write_late(const std::string& error) {
  if (!is_written_ || !report_.error) write(error);
}

void TestReport::put() const {
  if (!file_.empty()) recorders::write_junit(file_, report_);
}

}  // namespace stride::cli
