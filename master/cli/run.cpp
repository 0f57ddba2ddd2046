// stride run: a scenario from its start to its end.
#include <cstdlib>
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
#include "master/checks/checks.h"
#include "master/cli/commands.h"
#include "master/cli/interruption.h"
#include "master/cli/progress.h"
#include "master/cli/report_page.h"
#include "master/cli/scenario_options.h"
#include "master/cli/summary.h"
#include "master/cli/test_report.h"
#include "master/cli/verdicts.h"
#include "master/recorders/activity_recorder.h"
#include "master/recorders/csv_recorder.h"
#include "master/recorders/event_recorder.h"
#include "master/recorders/results_folder.h"
#include "master/recorders/run_json.h"
#include "master/recorders/vcd_recorder.h"
#include "master/scenario/film.h"
#include "master/scenario/loaded_scenario.h"

namespace stride::cli {
namespace {

constexpr int kMostThreads = 1024;

struct RunArguments {
  ScenarioRequest scenario;
  std::filesystem::path out;
  std::vector<std::string> captures;  ///< "component=FILE"
  std::filesystem::path junit;        ///< empty: none
  std::size_t threads = 1;
  std::optional<ProgressStyle> progress;
  bool no_trace = false;
  bool no_report = false;
  bool open = false;  ///< the report
  bool quiet = false;
};

/// The recorders that a scenario asks for.
struct Recorders {
  std::optional<io::CsvRecorder> signals;
  std::optional<io::EventRecorder> events;
  std::optional<io::VcdRecorder> trace;
  std::optional<io::ActivityRecorder> activity;

  Recorders(const core::System& system, const io::ResultFiles& files,
            const std::filesystem::path& folder) {
    if (!files.signals.empty()) signals.emplace(system, folder / files.signals);
    if (!files.events.empty()) events.emplace(system, folder / files.events);
    if (!files.trace.empty()) trace.emplace(system, folder / files.trace);
    if (!files.activity.empty()) activity.emplace(system, folder / files.activity);
  }

  void add_to(core::Simulation& simulation) {
    if (signals) simulation.add_observer(*signals);
    if (events) simulation.add_observer(*events);
    if (trace) simulation.add_observer(*trace);
    if (activity) simulation.add_observer(*activity);
  }
};

std::filesystem::path make_folder(const RunArguments& arguments, const io::Scenario& scenario) {
  std::filesystem::path folder = arguments.out.empty()
                                     ? std::filesystem::path("results") / io::stem(scenario.path)
                                     : arguments.out;
  io::make_results_folder(folder);
  io::remove_results(folder, scenario.annotation.results);
  // where units put the files that they write themselves
  ::setenv("STRIDE_RESULTS", std::filesystem::absolute(folder).c_str(), 1);
  return folder;
}

io::ResultFiles chosen_files(const RunArguments& arguments, const io::Scenario& scenario) {
  io::ResultFiles files = scenario.annotation.results;
  if (arguments.no_trace) files.trace.clear();
  if (arguments.no_report || !has_reports()) files.report.clear();
  if (arguments.open && files.report.empty()) {
    core::fail_input({}, "--open: this run writes no report",
                     "leave --open out, or let the run write its report");
  }
  return files;
}

core::RunOptions run_options(const RunArguments& arguments, const LoadedScenario& loaded) {
  core::RunOptions options = loaded.options();
  options.threads.count = arguments.threads;
  options.interrupted = &Interruption::flag();
  return options;
}

ProgressStyle progress_style(const RunArguments& arguments) {
  return arguments.progress.value_or(arguments.quiet ? ProgressStyle::None : ProgressStyle::Auto);
}

std::vector<capture::CaptureRequest> captures(const RunArguments& arguments) {
  std::vector<capture::CaptureRequest> captures;
  for (const std::string& text : arguments.captures) {
    auto [component, file] = split_option("--capture", text, "COMPONENT=FILE");
    if (file.empty()) core::fail_input({}, fmt::format("--capture {}: no file is named", text));
    captures.push_back({std::move(component), std::move(file)});
  }
  return captures;
}

/// A simulation with all that watches it.
class RecordedRun {
 public:
  /// Both must outlive it.
  RecordedRun(const RunArguments& arguments, TestReport& report)
      : request_(arguments),
        report_(report),
        loaded_(arguments.scenario),
        files_(chosen_files(arguments, loaded_.scenario())),
        folder_(make_folder(arguments, loaded_.scenario())),
        options_(run_options(arguments, loaded_)),
        capture_(loaded_.system(), loaded_.scenario().name, options_, captures(arguments)),
        simulation_(loaded_.system(), captured_units(), options_),
        recorders_(loaded_.system(), files_, folder_),
        checks_(loaded_.checks()),
        summary_(loaded_.system()),
        progress_(progress_style(arguments), options_.start, options_.stop, simulation_) {
    capture_.follow(simulation_);
    recorders_.add_to(simulation_);
    if (!checks_.is_empty()) simulation_.add_observer(checks_, checks_.signals());
    if (!capture_.is_empty()) simulation_.add_observer(capture_);
    if (!arguments.quiet) simulation_.add_observer(summary_);
    simulation_.add_observer(progress_);
  }

  /// Throws core::Error (Run) if it fails or is interrupted, and also if a verdict on it is bad.
  void run() {
    try {
      simulation_.run();
    } catch (const std::exception& failure) {
      progress_.end("failed");
      // the first failure is the one to tell
      warn_of_failure([&] { capture_.end(fmt::format("failed: {}", failure.what())); });
      take_verdicts(false);
      warn_of_failure([&] { write_statistics(failure.what()); });
      warn_of_failure([&] { report(); });
      warn_of_verdicts();
      throw;
    }
    const core::RunEnd end = simulation_.statistics().end;
    progress_.end(name(end));
    capture_.end(name(end));
    take_verdicts(end == core::RunEnd::EndedByUnit ||
                  (end == core::RunEnd::Completed && !is_cut_short()));
    write_statistics(std::nullopt);
    conclude();
  }

 private:
  std::vector<std::unique_ptr<core::Unit>> captured_units() {
    auto units = loaded_.instantiate(folder_);
    capture_.wrap(units);
    return units;
  }

  /// A report that cannot be written does not hide how the run ended.
  void conclude() {
    std::exception_ptr failure;
    try {
      report();
    } catch (const std::exception&) {
      failure = std::current_exception();
    }
    const auto tell = [&] {
      if (failure) std::rethrow_exception(failure);
    };
    if (!request_.quiet) print();
    const bool is_good = simulation_.statistics().end != core::RunEnd::Interrupted &&
                         failures_text(verdicts_).empty();
    if (!is_good) warn_of_failure(tell);
    require_end();
    require_passed(verdicts_);
    tell();
  }

  template <class Work>
  static void warn_of_failure(Work&& work) {
    try {
      work();
    } catch (const std::exception& failure) {
      spdlog::warn("{}", failure.what());
    }
  }

  /// By --stop, before what the scenario demands of all of it.
  bool is_cut_short() const { return options_.stop < loaded_.scenario().stop.value_or(Time{}); }

  void take_verdicts(bool is_complete) {
    const auto of_units = simulation_.verdicts();
    verdicts_.assign(of_units.begin(), of_units.end());
    for (core::Verdict& verdict :
         checks_.verdicts({simulation_.statistics().reached, is_complete})) {
      verdicts_.push_back(std::move(verdict));
    }
  }

  /// In a run that has not come to its end, which is told of first.
  void warn_of_verdicts() const {
    const std::string failures = failures_text(verdicts_);
    if (!failures.empty())
      spdlog::warn("checks have failed before the end of the run:{}", failures);
  }

  void write_statistics(const std::optional<std::string>& error) {
    report_.write(options_, simulation_.statistics(), verdicts_, error);
    if (files_.statistics.empty()) return;
    io::write_run_json(folder_ / files_.statistics, {.scenario = loaded_.scenario().path,
                                                     .system = loaded_.system(),
                                                     .options = options_,
                                                     .statistics = simulation_.statistics(),
                                                     .verdicts = verdicts_,
                                                     .error = error,
                                                     .files = files_,
                                                     .plots = loaded_.plots()});
  }

  void report() const {
    if (files_.report.empty()) return;
    write_report(folder_, files_, folder_ / files_.report);
    if (request_.open) warn_of_failure([&] { open_in_browser(folder_ / files_.report); });
  }

  void require_end() const {
    const core::RunStatistics& statistics = simulation_.statistics();
    if (statistics.end != core::RunEnd::Interrupted) return;
    warn_of_verdicts();
    core::fail_run({{}, {}, {}, statistics.reached},
                   "the run was interrupted; its results up to there are complete");
  }

  void print() const {
    fmt::print("\n{}{}\nResults in {}:", summary_.text(simulation_.statistics()),
               verdict_table(verdicts_), folder_.string());
    for (const auto& [what, member] : io::kResultFiles) {
      if (!(files_.*member).empty()) fmt::print(" {}", files_.*member);
    }
    fmt::print("{}\n", std::filesystem::exists(folder_ / io::kFilmFolder) ? " film/" : "");
  }

  Interruption interruption_;
  const RunArguments& request_;
  TestReport& report_;
  LoadedScenario loaded_;
  io::ResultFiles files_;
  std::filesystem::path folder_;
  core::RunOptions options_;
  capture::Capture capture_;
  core::Simulation simulation_;
  Recorders recorders_;
  checks::Checks checks_;
  std::vector<core::Verdict> verdicts_;
  Summary summary_;
  Progress progress_;
};

void run(const RunArguments& arguments) {
  TestReport report(arguments.junit, arguments.scenario.scenario);
  try {
    RecordedRun(arguments, report).run();
  } catch (const std::exception& failure) {
    if (!report.is_written()) report.write(failure.what());
    throw;
  }
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run a scenario and record what happens");
  const auto arguments = std::make_shared<RunArguments>();
  add_scenario_options(*command, arguments->scenario);
  command
      ->add_option("--out,-o", arguments->out,
                   "Results folder; otherwise results/ and the scenario's name")
      ->type_name("FOLDER");
  command
      ->add_option("--threads", arguments->threads,
                   "Step units on up to N threads where that is faster; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads));
  command
      ->add_option("--capture", arguments->captures,
                   "Write all that a component receives into a file, to be played to it alone; may "
                   "be given several times")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  // a flag, so that what follows a blank is the scenario; without a value it is "true"
  command
      ->add_flag("--film", arguments->scenario.film,
                 "Pictures of the MuJoCo worlds in film/, 0.1 s of simulated time from one to the "
                 "next, or as in --film=SECONDS")
      ->transform([](const std::string& value) { return value == "true" ? kFilmAsItIs : value; });
  command
      ->add_option("--junit", arguments->junit,
                   "Write a test report in the XML of JUnit, with a test case for the run, each "
                   "check and each unit's verdict")
      ->type_name("FILE");
  command->add_flag("--no-trace", arguments->no_trace, "Write no signals.vcd");
  command
      ->add_option_function<std::string>(
          "--progress",
          [arguments](const std::string& text) { arguments->progress = read_progress_style(text); },
          "How to show how far the run is: by itself (on a terminal a line that is rewritten, "
          "elsewhere a line now and then), in plain lines, in an object a line for programs, or "
          "not at all")
      ->type_name("auto|plain|json|none");
  command->add_flag("--no-report", arguments->no_report, "Write no report.html");
  command->add_flag("--open", arguments->open, "Open the report in a browser when the run is over");
  command->add_flag("--quiet,-q", arguments->quiet, "Print nothing but errors");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace stride::cli
