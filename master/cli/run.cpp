// stride run: a scenario from its start to its end.
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/capture/capture.h"
#include "master/cli/commands.h"
#include "master/cli/loaded_scenario.h"
#include "master/cli/progress.h"
#include "master/cli/scenario_options.h"
#include "master/cli/summary.h"
#include "master/cli/verdicts.h"
#include "master/io/csv_recorder.h"
#include "master/io/event_recorder.h"
#include "master/io/results_folder.h"
#include "master/io/run_json.h"
#include "master/io/vcd_recorder.h"

namespace stride::cli {
namespace {

constexpr int kMostThreads = 1024;

struct Request {
  ScenarioRequest scenario;
  std::filesystem::path out;
  std::vector<std::string> captures;  ///< "component=FILE"
  std::size_t threads = 1;
  bool no_trace = false;
  bool quiet = false;
};

/// The recorders that a scenario asks for.
struct Recorders {
  std::optional<io::CsvRecorder> signals;
  std::optional<io::EventRecorder> events;
  std::optional<io::VcdRecorder> trace;

  Recorders(const core::System& system, const io::ResultFiles& files,
            const std::filesystem::path& folder) {
    if (!files.signals.empty()) signals.emplace(system, folder / files.signals);
    if (!files.events.empty()) events.emplace(system, folder / files.events);
    if (!files.trace.empty()) trace.emplace(system, folder / files.trace);
  }

  void add_to(core::Simulation& simulation) {
    if (signals) simulation.add_observer(*signals);
    if (events) simulation.add_observer(*events);
    if (trace) simulation.add_observer(*trace);
  }
};

void print_results(const std::filesystem::path& folder, const io::ResultFiles& files) {
  fmt::print("\nResults in {}:", folder.string());
  for (const std::string& file : {files.signals, files.events, files.trace, files.statistics}) {
    if (!file.empty()) fmt::print(" {}", file);
  }
  fmt::print("\n");
}

std::vector<capture::Request> captures(const Request& request) {
  std::vector<capture::Request> captures;
  for (const std::string& text : request.captures) {
    auto [component, file] = split_option("--capture", text, "COMPONENT=FILE");
    if (file.empty()) core::fail_input({}, fmt::format("--capture {}: no file is named", text));
    captures.push_back({std::move(component), std::move(file)});
  }
  return captures;
}

void run(const Request& request) {
  const LoadedScenario loaded(request.scenario);
  const io::Scenario& scenario = loaded.scenario();
  io::ResultFiles files = scenario.annotation.results;
  if (request.no_trace) files.trace.clear();
  const std::filesystem::path folder =
      request.out.empty() ? std::filesystem::path("results") / scenario.stem() : request.out;
  io::make_results_folder(folder);

  core::RunOptions options = loaded.options();
  options.threads.count = request.threads;
  capture::Capture capture(loaded.system(), scenario.name, options, captures(request));
  auto units = loaded.instantiate();
  capture.wrap(units);
  core::Simulation simulation(loaded.system(), std::move(units), options);
  capture.follow(simulation);
  Recorders recorders(loaded.system(), files, folder);
  recorders.add_to(simulation);
  if (!capture.is_empty()) simulation.add_observer(capture);
  Summary summary(loaded.system());
  Progress progress(options.start, options.stop);
  if (!request.quiet) {
    simulation.add_observer(summary);
    simulation.add_observer(progress);
  }
  Interruption interruption;
  simulation.add_observer(interruption);

  const auto write_statistics = [&](const std::optional<std::string>& error) {
    if (files.statistics.empty()) return;
    io::write_run_json(folder / files.statistics, scenario.path, loaded.system(), options,
                       simulation.statistics(), simulation.verdicts(), error);
  };
  try {
    simulation.run();
  } catch (const std::exception& failure) {
    const auto attempt = [](auto&& work) {
      try {
        work();
      } catch (const std::exception& second) {  // the first one is the one to tell
        spdlog::warn("{}", second.what());
      }
    };
    attempt([&] { capture.end(fmt::format("failed: {}", failure.what())); });
    attempt([&] { write_statistics(failure.what()); });
    throw;
  }
  capture.end(simulation.statistics().terminated_by_unit ? "ended by a unit" : "completed");
  write_statistics(std::nullopt);
  if (!request.quiet) {
    fmt::print("\n{}{}", summary.text(simulation.statistics()),
               verdict_table(loaded.system(), simulation.verdicts()));
    print_results(folder, files);
  }
  require_passed(loaded.system(), simulation.verdicts());
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run a scenario and record what happens");
  const auto request = std::make_shared<Request>();
  add_scenario_options(*command, request->scenario);
  command
      ->add_option("--out,-o", request->out,
                   "Results folder; otherwise results/ and the scenario's name")
      ->type_name("FOLDER");
  command
      ->add_option("--threads", request->threads,
                   "Step units on up to N threads where that is faster; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads));
  command
      ->add_option("--capture", request->captures,
                   "Write all that a component receives into a file, to be played to it alone; may "
                   "be given several times")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  command->add_flag("--no-trace", request->no_trace, "Write no signals.vcd");
  command->add_flag("--quiet,-q", request->quiet, "Print nothing but errors");
  command->callback([request] { run(*request); });
}

}  // namespace stride::cli
