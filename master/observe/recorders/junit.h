#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_JUNIT_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_JUNIT_H

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/engine/run/verdict.h"

namespace stride::recorders {

/// What continuous integration needs of a run.
struct JunitReport {
  std::string suite;  ///< the scenario's name
  std::string host;   ///< where it ran
  std::chrono::system_clock::time_point began{};
  std::chrono::nanoseconds wall_time{};
  std::vector<std::pair<std::string, std::string>> properties{};
  std::optional<std::string> error{};  ///< why it has not come to its end, if it has not
  std::span<const core::Verdict> verdicts{};
};

/// A test report in the XML of JUnit, as continuous integration reads it: a test suite with a test
/// case for the run itself and one for each verdict. An undecided one is skipped. Throws
/// core::Error if it cannot be written.
void write_junit(const std::filesystem::path& file, const JunitReport& report);

}  // namespace stride::recorders

#endif
