#include "master/cli/recorded_run.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/algorithm/step_policies/unlimited_steps.h"
#include "master/cli/coverage_table.h"
#include "master/cli/crash_guard.h"
#include "master/cli/end_note.h"
#include "master/cli/output.h"
#include "master/cli/provenance.h"
#include "master/cli/report_page.h"
#include "master/cli/table.h"
#include "master/coverage/coverage_json.h"
#include "master/coverage/demand.h"
#include "master/recorders/results_folder.h"
#include "master/recorders/run_json.h"
#include "master/recorders/unit_folders.h"
#include "master/util/error.h"
#include "master/util/input_file.h"
#include "master/util/output_file.h"
#include "master/util/process/spare_files.h"
#include "master/util/replacement.h"
#include "master/util/state_archive.h"
#include "master/util/time_text.h"

namespace stride::cli {
namespace {

/// The state of all but units and observers.
constexpr const char* kSimulation = "simulation";

/// Calls write(), which writes of a run that is over: whatever is wrong with a file then, it is not
/// the input that is.
template <class Write>
void as_run_failure(Write&& write) {
  try {
    write();
  } catch (const core::Error& failure) {
    if (failure.kind() == core::Error::Kind::Run) throw;
    throw core::Error(core::Error::Kind::Run, failure.context(), failure.message(), failure.hint());
  }
}

/// Of an object with persist().
template <class Object>
void add_state(checkpoint::Checkpoint& checkpoint, const std::string& name, Object& object) {
  core::StateArchive state;
  object.persist(state);
  checkpoint.states[name] = state.bytes();
}

template <class Object>
void restore_state(const checkpoint::Checkpoint& checkpoint, const std::string& name,
                   Object& object) {
  core::StateArchive state(state_of(checkpoint, name));
  object.persist(state);
  state.end();
}

/// "unit 'X'" if there is only one.
std::string unit_without_host(const scenario::LoadedScenario& loaded) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < loaded.hostings().size(); ++i) {
    if (!loaded.hostings()[i]) names.push_back(loaded.system().components()[i].name);
  }
  return names.size() == 1 ? fmt::format("unit '{}'", names.front())
                           : "one of the units without a host";
}

// ---- Verdicts ----

const char* word(std::optional<bool> passed) {
  if (!passed) return "undecided";
  return *passed ? "passed" : "FAILED";
}

/// A table with its title, of the units and of the scenario's checks; empty if there are none.
std::string verdict_table(std::span<const core::Verdict> verdicts) {
  if (verdicts.empty()) return "";
  const bool has_times = std::ranges::any_of(
      verdicts, [](const core::Verdict& verdict) { return verdict.time.has_value(); });
  const bool has_margins = std::ranges::any_of(
      verdicts, [](const core::Verdict& verdict) { return verdict.margin.has_value(); });
  std::vector<Table::Column> columns{{"by"}, {"verdict"}};
  if (has_margins) columns.push_back({"margin", Table::Align::Right});
  if (has_times) columns.push_back({"first failure [s]", Table::Align::Right});
  columns.push_back({"because"});
  Table table(columns);
  for (const core::Verdict& verdict : verdicts) {
    std::vector<std::string> row{verdict.name, word(verdict.passed)};
    if (has_margins) row.push_back(verdict.margin ? core::brief_text(*verdict.margin) : "");
    if (has_times) row.push_back(verdict.time ? core::to_text(*verdict.time) : "");
    row.push_back(verdict.text);
    table.add(std::move(row));
  }
  return "\nVerdicts\n" + table.text();
}

/// A line for each bad verdict, with its first instant and the values there.
std::string failures_text(std::span<const core::Verdict> verdicts) {
  std::string text;
  for (const core::Verdict& verdict : verdicts) {
    if (verdict.passed != false) continue;
    const std::string reason = core::reason(verdict);
    text += "\n  " + core::to_text(core::Context{verdict.where, {}, {}, {}}) + verdict.name;
    if (!reason.empty()) text += ": " + reason;
  }
  return text;
}

/// Throws core::Error (Run) that names each bad verdict.
void require_passed(std::span<const core::Verdict> verdicts) {
  const auto failed = std::ranges::count(verdicts, std::optional(false), &core::Verdict::passed);
  if (failed == 0) return;
  core::fail_run({}, fmt::format("the run is complete, and has failed by {} of {}{}", failed,
                                 verdicts.size() == 1 ? "1 verdict"
                                                      : fmt::format("{} verdicts", verdicts.size()),
                                 failures_text(verdicts)));
}

}  // namespace

void add_error(const ResultsTarget& results, const std::string& error,
               std::optional<Time> reached) {
  const auto& [folder, files] = results;
  const std::filesystem::path run_file = folder / files.statistics;
  if (files.statistics.empty() || !core::is_file(run_file)) return;
  if (!recorders::add_error(run_file, error, reached) || files.report.empty()) return;
  write_report(folder, files, folder / files.report);
}

Recorders::Recorders(const core::System& system, const ResultsTarget& results) {
  const auto& [folder, files] = results;
  if (!files.signals.empty()) signals_.emplace(system, folder / files.signals);
  if (!files.events.empty()) events_.emplace(system, folder / files.events);
  if (!files.trace.empty()) trace_.emplace(system, folder / files.trace);
  if (!files.activity.empty()) activity_.emplace(system, folder / files.activity);
}

Recorders::Recorders(const core::System& system, const ResultsTarget& results,
                     const Resumption& resumption) {
  using Existing = core::OutputFile::Existing;
  const auto& [folder, files] = results;
  const Existing signals = resumption.has_other_signals ? Existing::Emptied : Existing::Kept;
  if (!files.signals.empty()) signals_.emplace(system, folder / files.signals, signals);
  if (!files.events.empty()) events_.emplace(system, folder / files.events, Existing::Kept);
  if (!files.trace.empty()) trace_.emplace(system, folder / files.trace, signals);
  if (!files.activity.empty()) activity_.emplace(system, folder / files.activity, Existing::Kept);
}

template <class Visit>
void Recorders::visit(Visit&& visit) {
  if (signals_) visit("signals", *signals_, &recorders::ResultFiles::signals);
  if (events_) visit("events", *events_, &recorders::ResultFiles::events);
  if (trace_) visit("trace", *trace_, &recorders::ResultFiles::trace);
  if (activity_) visit("activity", *activity_, &recorders::ResultFiles::activity);
}

void Recorders::add_to(core::Simulation& simulation) {
  visit([&](const char*, auto& recorder, auto) { simulation.add_observer(recorder); });
}

void Recorders::add_to(checkpoint::Checkpoint& checkpoint) {
  visit([&](const char* name, auto& recorder, auto) { add_state(checkpoint, name, recorder); });
}

void Recorders::restore(const checkpoint::Checkpoint& checkpoint) {
  visit([&](const char* name, auto& recorder, auto) {
    if (recorder.file().is_untouched()) restore_state(checkpoint, name, recorder);
  });
}

void Recorders::go_on() {
  visit([](const char*, auto& recorder, auto) { recorder.file().go_on(); });
}

void Recorders::flush() {
  visit([](const char*, auto& recorder, auto) { recorder.file().flush(); });
}

void Recorders::continue_in_copies(const ResultsTarget& results) {
  visit([&](const char*, auto& recorder, auto file) {
    recorder.file().continue_in_copy(results.folder / results.files.*file);
  });
}

RecordedRun::RecordedRun(const RunSetup& setup, std::vector<std::unique_ptr<core::Unit>> units)
    : setup_(setup),
      simulation_(setup_.loaded.system(), std::move(units), setup_.options),
      has_begun_(!setup_.is_resumed),
      checks_(setup_.loaded.checks()),
      coverage_(setup_.loaded.coverage()),
      summary_(setup_.loaded.system(), setup_.loaded.options().recorded),
      progress_(setup_.display.progress, setup_.options.start, setup_.options.stop, simulation_) {
  setup_.capture.follow(simulation_);
  setup_.recorders.add_to(simulation_);
  if (!checks_.is_empty()) simulation_.add_observer(checks_, checks_.signals());
  if (!coverage_.is_empty()) {
    coverage_.follow(simulation_);
    simulation_.add_observer(coverage_, coverage_.signals());
  }
  if (!setup_.capture.is_empty()) simulation_.add_observer(setup_.capture);
  if (!setup_.display.quiet) simulation_.add_observer(summary_, summary_.signals());
  if (setup_.display.progress != ProgressStyle::None) simulation_.add_observer(progress_);
  if (has_begun_) announce();
}

/// So that a run which ends without a word is not taken for none, or for a good one.
void RecordedRun::announce() const {
  const auto& [folder, files] = setup_.results;
  const std::filesystem::path file = folder / files.statistics;
  if (files.statistics.empty() || core::Replacement::is_at_once(file)) return;
  try {
    write_run_file(std::nullopt, false);
  } catch (const core::Error&) {  // what is wrong with the disk is an error at the end
  }
  note_run_file(file);
}

void RecordedRun::run() {
  execute([&] { simulation_.run(); });
}

void RecordedRun::resume(const Resumption& resumption) {
  try {
    execute([&] {
      core::StateArchive state(state_of(resumption.from, kSimulation));
      simulation_.resume(state, [&] {
        state.end();
        restore(resumption);
      });
    });
  } catch (const core::BadState& mistake) {
    fail_checkpoint(resumption.file, mistake);
  }
}

/// What the observers have seen.
void RecordedRun::restore(const Resumption& resumption) {
  const checkpoint::Checkpoint& from = resumption.from;
  if (simulation_.statistics().reached != from.time) {
    throw core::BadState("its state is of another time than it says");
  }
  if (!checks_.is_empty()) restore_state(from, "checks", checks_);
  if (!coverage_.is_empty()) restore_state(from, "coverage", coverage_);
  if (!setup_.display.quiet) summary_.begin_late(from.time);
  if (from.states.contains("summary") && !setup_.display.quiet) {
    restore_state(from, "summary", summary_);
  }
  if (!setup_.capture.is_empty()) restore_state(from, "captures", setup_.capture);
  setup_.recorders.restore(from);
  setup_.recorders.go_on();
  setup_.capture.go_on();
  has_begun_ = true;
  announce();
}

void RecordedRun::flush() {
  setup_.recorders.flush();
  setup_.capture.flush();
}

void RecordedRun::run_rest(std::vector<core::Intervention> interventions,
                           const std::filesystem::path& stimuli) {
  has_test_report_ = false;
  setup_.recorders.continue_in_copies(setup_.results);
  setup_.capture.continue_in_copies(stimuli);
  further_ = interventions;
  simulation_.add_interventions(std::move(interventions));
  announce();
  execute([&] { simulation_.run_rest(); });
}

void RecordedRun::add_to(checkpoint::Checkpoint& checkpoint) {
  add_state(checkpoint, kSimulation, simulation_);
  if (!checks_.is_empty()) add_state(checkpoint, "checks", checks_);
  if (!coverage_.is_empty()) add_state(checkpoint, "coverage", coverage_);
  if (!setup_.display.quiet) add_state(checkpoint, "summary", summary_);
  if (!setup_.capture.is_empty()) add_state(checkpoint, "captures", setup_.capture);
  setup_.recorders.add_to(checkpoint);
}

template <class Go>
void RecordedRun::execute(Go&& go) {
  try {
    go();
    setup_.capture.end(name(simulation_.statistics().end));
  } catch (const core::TakenFileError&) {
    throw;  // the files of the end might be taken, too
  } catch (const std::exception& failure) {
    restore_process();
    conclude_failure(failure.what());
    throw;
  }
  restore_process();
  const core::RunEnd end = simulation_.statistics().end;
  progress_.end(name(end));
  warn_of_late_events();
  warn_of_inexact_repetitions();
  collect_verdicts(end == core::RunEnd::EndedByUnit ||
                   (end == core::RunEnd::Completed && !is_cut_short()));
  as_run_failure([&] {
    write_statistics(std::nullopt);
    conclude();
  });
}

void RecordedRun::abandon(const std::string& error) {
  core::SpareFiles::release_all();
  setup_.loaded.process().restore();
  simulation_.abandon();
  conclude_failure(error);
}

/// Files are written from here on, some of them named relative to the working folder.
void RecordedRun::restore_process() const {
  limit_end();
  core::SpareFiles::release_all();
  const std::vector<std::string> changes = setup_.loaded.process().restore();
  if (changes.empty()) return;
  spdlog::warn(
      "{} has changed {} in the course of the run, which all code in the process of stride shares; "
      "it is put back now, and would change nothing for others in a process of its own (--isolate)",
      unit_without_host(setup_.loaded), fmt::join(changes, ", "));
}

/// The failure of the run is the error to report, so later failures are warnings.
void RecordedRun::conclude_failure(const std::string& error) {
  failure_ = error;
  if (!has_begun_) return;
  progress_.end("failed");
  warn_of_failure([&] { setup_.capture.end(fmt::format("failed: {}", error)); });
  collect_verdicts(false);
  warn_of_failure([&] { write_statistics(error); });
  warn_of_failure([&] { write_page(); });
  warn_of_verdicts();
}

/// A report that cannot be written does not hide how the run ended.
void RecordedRun::conclude() {
  std::exception_ptr page_failure;
  try {
    write_page();
  } catch (const std::exception&) {
    page_failure = std::current_exception();
  }
  const auto rethrow_page_failure = [&] {
    if (page_failure) std::rethrow_exception(page_failure);
  };
  if (!setup_.display.quiet) print_summary();
  const bool is_good =
      simulation_.statistics().end != core::RunEnd::Interrupted && failures_text(verdicts_).empty();
  if (!is_good) warn_of_failure(rethrow_page_failure);
  require_end();
  require_passed(verdicts_);
  rethrow_page_failure();
}

/// By --stop, before what the scenario demands of all of it.
bool RecordedRun::is_cut_short() const {
  return setup_.options.stop < setup_.loaded.scenario().stop.value_or(Time{});
}

void RecordedRun::collect_verdicts(bool is_complete) {
  const auto of_units = simulation_.verdicts();
  verdicts_.assign(of_units.begin(), of_units.end());
  for (core::Verdict& verdict : checks_.verdicts({simulation_.statistics().reached, is_complete})) {
    verdicts_.push_back(std::move(verdict));
  }
  if (setup_.loaded.demands().empty()) return;
  for (core::Verdict& verdict : coverage::verdicts(setup_.loaded.demands(), coverage(),
                                                   simulation_.statistics().reached, is_complete)) {
    verdicts_.push_back(std::move(verdict));
  }
}

/// In a run that did not reach its end, which is the error to report.
void RecordedRun::warn_of_verdicts() const {
  const std::string failures = failures_text(verdicts_);
  if (!failures.empty()) spdlog::warn("checks have failed before the end of the run:{}", failures);
}

/// A unit that neither announces its events nor returns early for them has them where steps end.
void RecordedRun::warn_of_late_events() const {
  const core::System& system = setup_.loaded.system();
  if (!core::has_unlimited_steps(system, setup_.options)) return;
  const std::span<const core::UnitStatistics> units = simulation_.statistics().units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i].unannounced_events == 0) continue;
    spdlog::warn(
        "unit '{}' had events at the ends of its steps which it had not announced ({} times), and "
        "nothing but events ends a step here, so they may be late; <stride:Step maximum=\"…\"/> "
        "(--max-step) ends steps, or says with a long one that this is meant",
        system.components()[i].name, units[i].unannounced_events);
  }
}

/// What follows from such a unit's rollback is not what it would be had its state been saved there.
void RecordedRun::warn_of_inexact_repetitions() const {
  const core::System& system = setup_.loaded.system();
  const std::span<const core::UnitStatistics> units = simulation_.statistics().units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!units[i].inexact_repetition) continue;
    const core::InexactRepetition& seen = *units[i].inexact_repetition;
    const std::string& name = system.components()[i].name;
    spdlog::warn(
        "unit '{}' does not make the same step twice: when it was taken back, it repeated the "
        "steps since its state had been saved, and at {} s {}; its state was saved before each "
        "step "
        "from then on; <stride:StateSaving components=\"{}\" eachStep=\"true\"/> does so from the "
        "beginning",
        name, core::to_text(seen.time),
        seen.variable.empty() ? "a step ended otherwise"
                              : fmt::format("'{}' became {} where it had been {}", seen.variable,
                                            seen.second, seen.first),
        name);
  }
}

/// Where one of the two files cannot be written, the other one contains that.
void RecordedRun::write_statistics(std::optional<std::string> error) {
  std::exception_ptr failure;
  try {
    write_coverage_file();
    write_run_file(error);
  } catch (const std::exception& mistake) {
    failure = std::current_exception();
    if (!error) error = mistake.what();
  }
  if (has_test_report_) {
    setup_.test_report.write(setup_.options, simulation_.statistics(), verdicts_, error);
  }
  if (failure) std::rethrow_exception(failure);
}

void RecordedRun::write_coverage_file() const {
  const auto& [folder, files] = setup_.results;
  if (coverage_.is_empty() || files.coverage.empty()) return;
  coverage::write_coverage(folder / files.coverage, coverage());
}

void RecordedRun::write_run_file(const std::optional<std::string>& error, bool is_over) const {
  if (setup_.results.files.statistics.empty()) return;
  core::RunOptions options = setup_.options;
  options.interventions.insert(options.interventions.end(), further_.begin(), further_.end());
  std::vector<recorders::CoverageSummary> summaries;
  if (is_over && !coverage_.is_empty()) summaries = coverage_summaries(coverage());
  recorders::write_run_json(setup_.results.folder / setup_.results.files.statistics,
                            {.scenario = setup_.loaded.scenario().path,
                             .system = setup_.loaded.system(),
                             .options = options,
                             .provenance = setup_.provenance,
                             .statistics = simulation_.statistics(),
                             .verdicts = verdicts_,
                             .error = error,
                             .is_over = is_over,
                             .files = setup_.results.files,
                             .plots = setup_.loaded.plots(),
                             .coverage = summaries});
}

void RecordedRun::write_page() const {
  const auto& [folder, files] = setup_.results;
  if (files.report.empty()) return;
  write_report(folder, files, folder / files.report);
  if (setup_.display.open_report) warn_of_failure([&] { open_in_browser(folder / files.report); });
}

void RecordedRun::require_end() const {
  const core::RunStatistics& statistics = simulation_.statistics();
  if (statistics.end != core::RunEnd::Interrupted) return;
  warn_of_verdicts();
  const bool has_checkpoint =
      setup_.checkpoints != nullptr && !setup_.checkpoints->at_interruption().empty();
  core::fail_run({{}, {}, {}, statistics.reached},
                 "the run was interrupted; its results up to there are complete",
                 has_checkpoint ? fmt::format("it goes on with: stride resume {}",
                                              setup_.results.folder.string())
                                : "");
}

void RecordedRun::print_summary() const {
  const auto& [folder, files] = setup_.results;
  print_text("\n{}{}{}\nResults in {}:", summary_.text(simulation_.statistics()),
             coverage_.is_empty() ? "" : coverage_table(coverage()), verdict_table(verdicts_),
             folder.string());
  for (const auto& [what, member] : recorders::kResultFiles) {
    if (!(files.*member).empty()) print_text(" {}", files.*member);
  }
  if (recorders::has_unit_files(folder)) print_text(" {}/", recorders::kUnitsFolder);
  print_text("\n");
}

}  // namespace stride::cli
