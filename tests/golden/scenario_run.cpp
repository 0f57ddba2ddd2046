#include "tests/golden/scenario_run.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stride::tests {
namespace fs = std::filesystem;

std::set<std::string> golden_scenarios() {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(fs::path(STRIDE_SOURCE_DIR) / "scenarios")) {
    if (fs::exists(entry.path() / "golden")) found.insert(entry.path().filename().string());
  }
  return found;
}

fs::path scenario_folder(const std::string& scenario) {
  return fs::path(STRIDE_SOURCE_DIR) / "scenarios" / scenario;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

Arguments without_judge(const std::string& scenario) {
  const std::string text = text_of(scenario_folder(scenario) / (scenario + ".ssd"));
  if (text.find("ground_truth.fmu") == std::string::npos) return {};
  return {"--set", "ground_truth.minimum_measurements=0"};
}

ScenarioRun::ScenarioRun(const std::string& scenario, const Arguments& further) {
  std::string name = (fs::temp_directory_path() / "stride-scenario-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  fs::path file = scenario;
  if (file.extension() != ".ssd") file = scenario_folder(scenario) / (scenario + ".ssd");
  Arguments arguments{"run", file.string(), "--out", name, "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  const Outcome outcome = run_program(arguments);
  if (outcome.exit_code != 0) {
    fs::remove_all(folder_);
    throw std::runtime_error("the run failed: " + outcome.err);
  }
  signals_ = std::make_unique<Csv>(folder_ / "signals.csv");
  events_ = std::make_unique<Csv>(folder_ / "events.csv");
}

ScenarioRun::~ScenarioRun() { fs::remove_all(folder_); }

double ScenarioRun::at(const std::string& time, const std::string& signal) const {
  return signals().number(signals().row_at(time), signals().column(signal));
}

Extremes ScenarioRun::between(const std::string& from, const std::string& to,
                              const std::string& signal) const {
  const std::size_t column = signals().column(signal);
  Extremes extremes{HUGE_VAL, -HUGE_VAL};
  for (std::size_t row = signals().row_at(from); row <= signals().row_at(to); ++row) {
    const double value = signals().number(row, column);
    extremes = {std::min(extremes.least, value), std::max(extremes.most, value)};
  }
  return extremes;
}

std::vector<std::string> ScenarioRun::fields(std::size_t field, const std::string& component,
                                             const std::string& variable,
                                             const std::string& direction) const {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < events().size(); ++i) {
    const auto& row = events().row(i);
    if (row[2] == component && row[3] == variable && row[4] == direction) {
      found.push_back(row[field]);
    }
  }
  return found;
}

std::vector<std::string> ScenarioRun::instants(const std::string& component,
                                               const std::string& variable,
                                               const std::string& direction) const {
  return fields(0, component, variable, direction);
}

std::vector<std::string> ScenarioRun::payloads(const std::string& component,
                                               const std::string& variable,
                                               const std::string& direction) const {
  return fields(5, component, variable, direction);
}

std::string golden_differences(const std::string& scenario, const ScenarioRun& run) {
  const fs::path golden = scenario_folder(scenario) / "golden";
  const Outcome outcome =
      run_program({"compare", run.file("").string(), golden.string(), "--golden"});
  return outcome.exit_code == 0 ? "" : "\n" + outcome.out + outcome.err;
}

}  // namespace stride::tests
