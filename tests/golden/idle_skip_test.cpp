// With and without idle skipping every scenario shows the same: the same messages at the same
// instants, and values that differ by no more than the units' tolerances allow for.
#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

const Arguments kIdleStop{};  // the scenario's own

/// In SI units, by the ends of signals' names: what the units' tolerances (see their READMEs) and
/// what follows from them may come to.
const std::map<std::string, double> kBounds = {
    {".position", 2e-4}, {".velocity", 2e-3}, {"distance", 5e-4}, {"temperature", 2e-3}};
/// Of all others, of the signal's greatest value.
constexpr double kShare = 1e-3;

double bound(const std::string& title, const std::vector<double>& values) {
  const std::string name = title.substr(0, title.find(" ["));
  for (const auto& [end, value] : kBounds) {
    if (name.size() >= end.size() && name.substr(name.size() - end.size()) == end) return value;
  }
  double greatest = 0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  return kShare * greatest;
}

/// At the instants that a run with skipping has, which are some of all.
double greatest_difference(const Csv& skipping, const Csv& full, const std::string& title) {
  const std::vector<double> times = full.numbers("time");
  const std::vector<double> expected = full.numbers(title);
  const std::vector<double> own_times = skipping.numbers("time");
  const std::vector<double> found = skipping.numbers(title);
  double greatest = 0;
  for (std::size_t i = 0, k = 0; i < found.size(); ++i) {
    while (k + 1 < times.size() && times[k] < own_times[i]) ++k;
    // an instant may have several rows, an event within it; the last one is what it settled to
    const bool is_last = i + 1 == found.size() || own_times[i + 1] > own_times[i];
    if (!is_last) continue;
    while (k + 1 < times.size() && times[k + 1] == own_times[i]) ++k;
    REQUIRE(times[k] == own_times[i]);
    greatest = std::max(greatest, std::abs(found[i] - expected[k]));
  }
  return greatest;
}

ScenarioRun run(const std::string& scenario, const Arguments& further) {
  Arguments arguments{"--no-trace"};
  for (const Arguments& some : {kIdleStop, further, without_judge(scenario)}) {
    arguments.insert(arguments.end(), some.begin(), some.end());
  }
  return ScenarioRun(scenario, arguments);
}

}  // namespace

TEST_CASE("idle skipping changes no message, and values within their tolerances") {
  const std::string scenario = GENERATE("nfc_approach", "nfc_far", "nfc_jitter", "nfc_brownout",
                                        "nfc_two_tags", "rf_approach");
  const ScenarioRun full = run(scenario, {"--no-idle-skip"});
  for (const char* max_skip : {"0.01", "10"}) {
    INFO(scenario << " with --max-skip " << max_skip);
    const ScenarioRun skipping = run(scenario, {"--max-skip", max_skip});
    CHECK(text_of(skipping.file("events.csv")) == text_of(full.file("events.csv")));
    for (const std::string& title : full.signals().titles()) {
      if (title == "time") continue;
      INFO(title);
      CHECK(greatest_difference(skipping.signals(), full.signals(), title) <=
            bound(title, full.signals().numbers(title)));
    }
  }
}
