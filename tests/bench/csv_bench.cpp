// Nanoseconds per row of signals.csv with 1, 10 and 100 signals: CsvRecorder beside a plain loop
// that writes the same bytes with fmt and fwrite.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "master/observe/recorders/csv_recorder.h"
#include "tests/bench/stopwatch.h"

namespace {

using namespace stride;
using namespace stride::bench;

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr int kValues = 500'000;  // per measured run, whatever the number of signals

/// A folder for the files of one benchmark.
class Folder {
 public:
  Folder() {
    path_ = (std::filesystem::temp_directory_path() / "stride-csv-bench-XXXXXX").string();
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

core::System system_of(std::size_t signals) {
  auto description = std::make_shared<core::UnitDescription>();
  description->model_name = "source";
  for (std::size_t k = 0; k < signals; ++k) {
    core::Variable variable;
    variable.name = fmt::format("y{}", k);
    variable.reference = static_cast<core::ValueReference>(k);
    variable.causality = core::Causality::Output;
    description->variables.push_back(variable);
  }
  core::SystemDeclaration declaration;
  declaration.components.push_back({"a", description, {}, {}});
  return core::System(declaration);
}

/// Numbers with all their 15 to 17 digits, as a simulation gives them.
const std::vector<double>& samples() {
  static const std::vector<double> values = [] {
    std::vector<double> made(1 << 12);
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = 1.5 + std::sin(static_cast<double>(i));
    return made;
  }();
  return values;
}

void fill(std::span<double> values, int row) {
  const std::vector<double>& from = samples();
  std::size_t at = static_cast<std::size_t>(row);
  for (double& value : values) value = from[at++ % from.size()];
}

double write_with_stride(const core::System& system, int rows, const std::string& file) {
  const std::size_t count = system.components()[0].description->variables.size();
  core::ValueBlock block(core::ValueType::Float64, count);
  std::vector<core::Signal> signals;
  for (std::size_t k = 0; k < count; ++k) signals.push_back({{0, k}, &block, k});
  recorders::CsvRecorder recorder(system, file);
  recorder.on_start(signals);
  const auto began = Wall::now();
  for (int row = 0; row < rows; ++row) {
    fill(block.numbers<double>(), row);
    recorder.on_communication_point(Time(row * kStep));
  }
  recorder.on_finish();
  return seconds_since(began);
}

double write_by_hand(std::size_t count, int rows, const std::string& file) {
  std::vector<double> values(count);
  std::FILE* const stream = std::fopen(file.c_str(), "wb");
  if (stream == nullptr) throw std::runtime_error("cannot create " + file);
  fmt::memory_buffer line;
  const auto write_line = [&] {
    line.push_back('\n');
    std::fwrite(line.data(), 1, line.size(), stream);
    line.clear();
  };
  fmt::format_to(std::back_inserter(line), "time");
  for (std::size_t k = 0; k < count; ++k) fmt::format_to(std::back_inserter(line), ",a.y{}", k);
  write_line();
  const auto began = Wall::now();
  for (int row = 0; row < rows; ++row) {
    fill(values, row);
    fmt::format_to(std::back_inserter(line), "{}", to_seconds(row * kStep));
    for (const double value : values) fmt::format_to(std::back_inserter(line), ",{}", value);
    write_line();
  }
  std::fclose(stream);
  return seconds_since(began);
}

std::string content(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void csv(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const int rows = kValues / static_cast<int>(count);
  const core::System system = system_of(count);
  const Folder folder;
  double stride_seconds = 0;
  double hand_seconds = 0;
  for (auto _ : state) {
    const double mine = write_with_stride(system, rows, folder / "stride.csv");
    hand_seconds += write_by_hand(count, rows, folder / "hand.csv");
    stride_seconds += mine;
    state.SetIterationTime(mine);
  }
  if (content(folder / "stride.csv") != content(folder / "hand.csv")) {
    return state.SkipWithError("the two files differ");
  }
  const double all_rows = static_cast<double>(state.iterations()) * rows;
  state.counters["stride_ns"] = 1e9 * stride_seconds / all_rows;
  state.counters["by_hand_ns"] = 1e9 * hand_seconds / all_rows;
  state.counters["ratio"] = stride_seconds / hand_seconds;
}

BENCHMARK(csv)->Arg(1)->Arg(10)->Arg(100)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
