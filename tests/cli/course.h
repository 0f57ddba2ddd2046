// What runs that are the same have in common.
#ifndef STRIDE_TESTS_CLI_COURSE_H
#define STRIDE_TESTS_CLI_COURSE_H

#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/failures.h"

namespace stride::tests {

/// What run.json says of a run's course, without what it has cost.
inline nlohmann::json course(nlohmann::json run) {
  static const std::set<std::string> kCosts{
      "wall_time",           "calls",     "saves",   "repeated_steps", "measured_steps", "scenario",
      "uncertainties",       "resumed",   "threads", "parallel_steps", "host",           "phases",
      "phase_uncertainties", "provenance"};
  if (run.is_array()) {
    for (auto& item : run) item = course(item);
    return run;
  }
  if (!run.is_object()) return run;
  nlohmann::json kept;
  for (const auto& [key, value] : run.items()) {
    if (kCosts.count(key) == 0) kept[key] = course(value);
  }
  return kept;
}

inline constexpr const char* kTraces[] = {"signals.csv", "events.csv", "signals.vcd",
                                          "activity.csv"};

inline void check_same_traces(const fs::path& one, const fs::path& other) {
  CAPTURE(other.string());
  for (const char* const file : kTraces) {
    CAPTURE(file);
    const bool is_same = read(one / file) == read(other / file);
    CHECK(is_same);
  }
}

inline void check_same_results(const fs::path& one, const fs::path& other) {
  check_same_traces(one, other);
  CHECK(course(nlohmann::json::parse(read(one / "run.json"))) ==
        course(nlohmann::json::parse(read(other / "run.json"))));
}

}  // namespace stride::tests

#endif
