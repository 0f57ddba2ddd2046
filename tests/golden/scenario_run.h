// One run of a scenario of this project, and how it compares with the golden results beside it.
#ifndef STRIDE_TESTS_GOLDEN_SCENARIO_RUN_H
#define STRIDE_TESTS_GOLDEN_SCENARIO_RUN_H

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/cli/results.h"

namespace stride::tests {

std::filesystem::path scenario_folder(const std::string& scenario);
/// All in scenarios/ that have golden results, so that nothing is to be fetched for them.
std::set<std::string> golden_scenarios();
std::string text_of(const std::filesystem::path& file);

struct Extremes {
  double least, most;
};

/// The options for a run of the scenario that is too short for its judge, where it has one.
Arguments without_judge(const std::string& scenario);

/// The results are in a folder that goes with the object.
class ScenarioRun {
 public:
  /// `scenario`: the name of a folder in scenarios/, or the path of a .ssd. Throws
  /// std::runtime_error, with the output of the program, if it fails.
  explicit ScenarioRun(const std::string& scenario, const Arguments& further = {});
  ~ScenarioRun();
  ScenarioRun(const ScenarioRun&) = delete;
  ScenarioRun& operator=(const ScenarioRun&) = delete;

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const Csv& signals() const { return *signals_; }
  const Csv& events() const { return *events_; }

  double at(const std::string& time, const std::string& signal) const;
  /// Over the communication points of an interval, its ends included.
  Extremes between(const std::string& from, const std::string& to, const std::string& signal) const;
  /// When a component sent or received on a variable, as the file writes the instants.
  std::vector<std::string> instants(const std::string& component, const std::string& variable,
                                    const std::string& direction) const;
  /// What a component sent or received on a variable.
  std::vector<std::string> payloads(const std::string& component, const std::string& variable,
                                    const std::string& direction) const;

 private:
  std::vector<std::string> fields(std::size_t field, const std::string& component,
                                  const std::string& variable, const std::string& direction) const;

  std::filesystem::path folder_;
  std::unique_ptr<Csv> signals_;
  std::unique_ptr<Csv> events_;
};

/// What `stride compare --golden` prints of a run of this scenario and its golden results; empty if
/// they are equal. Messages are compared exactly, signals within tolerances.csv, at the instants
/// that the golden file has.
std::string golden_differences(const std::string& scenario, const ScenarioRun& run);

}  // namespace stride::tests

#endif
