// What `stride run --junit` leaves for continuous integration.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_TEST_REPORT_H
#define STRIDE_MASTER_FRONT_CLI_RUN_TEST_REPORT_H

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/context/statistics.h"
#include "master/engine/run/verdict.h"
#include "master/observe/recorders/junit.h"

namespace stride::cli {

/// The file exists from the beginning, and states at first that the run has not ended, so a killed
/// run is not taken for a good one; a pipe or a device gets one report, at the end.
class TestReport {
 public:
  /// Throws core::Error if the file cannot be written. Without a file it does nothing, as do the
  /// functions below.
  TestReport(std::filesystem::path file, const std::filesystem::path& scenario);

  /// The run is over; `error` is the reason if it has not come to its end.
  void write(const core::RunOptions& options, const core::RunStatistics& statistics,
             std::span<const core::Verdict> verdicts, const std::optional<std::string>& error);
  /// For a run that did not begin, or whose report was not written.
  void write(const std::string& error);
  bool is_written() const { return is_written_; }
  /// Something has failed after the end of the run. An earlier error stays.
  void write_late(const std::string& error);

 private:
  std::chrono::nanoseconds elapsed() const { return std::chrono::steady_clock::now() - began_; }
  void put() const;

  std::filesystem::path file_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  recorders::JunitReport report_;
  std::vector<core::Verdict> verdicts_;
  bool is_written_ = false;
  std::optional<core::OutputFile> pipe_;  ///< open, so that its reader waits for the report
};

}  // namespace stride::cli

#endif
