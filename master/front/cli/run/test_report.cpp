#include "master/front/cli/run/test_report.h"

#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/replacement.h"
#include "master/base/process/host_name.h"
#include "master/base/time_text.h"
#include "master/system/declaration/scenario.h"

namespace stride::cli {
namespace {

/// What is no regular file is written at the end only, when it is too late for such an error.
void check_writable(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  std::string reason;
  if (std::filesystem::is_directory(status)) {
    reason = "this is a folder; expected a file to write to";
  } else if (std::filesystem::is_socket(status)) {
    reason = "this is a socket; expected a file to write to";
  } else if (::access(file.c_str(), W_OK) != 0) {
    reason = fmt::format("cannot write the file: {}", std::generic_category().message(errno));
  }
  if (reason.empty()) return;
  core::fail_input({.where = {file.string(), 0}}, reason, "name another file after --junit");
}

}  // namespace

TestReport::TestReport(std::filesystem::path file, const std::filesystem::path& scenario)
    : file_(std::move(file)) {
  if (file_.empty()) return;
  std::error_code ignored;  // without the folder the file cannot be made, which is an error then
  std::filesystem::create_directories(file_.parent_path(), ignored);
  report_.suite = scenario::stem(scenario);
  report_.host = core::host_name();
  report_.began = std::chrono::system_clock::now();
  report_.properties = {{"scenario", scenario.string()}, {"stride", STRIDE_VERSION}};
  report_.error = "the run has not ended";
  if (std::filesystem::is_fifo(file_, ignored)) pipe_.emplace(file_);
  if (core::Replacement::is_at_once(file_)) {
    check_writable(file_);
  } else {
    put();
  }
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
