#include "master/front/cli/run/recorded_run.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/process/spare_files.h"
#include "master/base/state_archive.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/front/cli/coverage/coverage_table.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/end_note.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/browser.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/study/results/checkpoint_states.h"
#include "master/study/results/provenance.h"

namespace stride::cli {
namespace {

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

/// "unit 'X'" if there is only one.
std::string unit_without_host(const scenario::RunPlan& loaded) {
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
  core::fail_run({},
                 fmt::format("the run is complete, and has failed by {} of {}{}", failed,
                             core::counted(verdicts.size(), "verdict"), failures_text(verdicts)));
}

results::Beginning beginning(const Resumption* resumption) {
  using results::Beginning;
  if (resumption == nullptr) return Beginning::Empty;
  return resumption->has_other_signals ? Beginning::KeptButSignals : Beginning::Kept;
}

}  // namespace

RecordedRun::RecordedRun(const RunSetup& setup, std::vector<std::unique_ptr<core::Unit>> units)
    : setup_(setup),
      simulation_(setup_.loaded.system(), std::move(units), setup_.options),
      has_begun_(setup_.resumption == nullptr),
      records_({setup_.loaded, setup_.options, setup_.provenance, setup_.results}, simulation_,
               beginning(setup_.resumption)),
      summary_(setup_.loaded.system(), setup_.loaded.options().recorded),
      progress_(setup_.display.progress, setup_.options.start, setup_.options.stop, simulation_) {
  setup_.capture.follow(simulation_);
  if (!setup_.capture.is_empty()) simulation_.add_observer(setup_.capture);
  if (!setup_.display.quiet) simulation_.add_observer(summary_, summary_.signals());
  // its line comes before that of the progress, which is rewritten
  if (setup_.display.live != nullptr) add_live_report();
  if (setup_.display.progress != ProgressStyle::None) simulation_.add_observer(progress_);
  if (setup_.display.real_time) {
    real_time_.emplace(*setup_.display.real_time, *setup_.options.interrupted);
    real_time_->set_meanwhile([this] { flush(); });  // somebody looks on
    simulation_.add_observer(*real_time_);
  }
  if (has_begun_) announce();
}

void RecordedRun::announce() const {
  if (const auto file = records_.announce(); !file.empty()) note_run_file(file);
}

void RecordedRun::add_live_report() {
  live_.emplace(*setup_.display.live, setup_.results, [this] { flush(); });
  live_->set_ready([opens = setup_.display.open_report](const std::string& address) {
    put(stderr, fmt::format("The report while the run goes on: {}\n", address));
    if (opens) warn_of_failure([&] { open_address_in_browser(address); });
  });
  simulation_.add_observer(*live_);
}

void RecordedRun::run() {
  execute([&] { simulation_.run(); });
}

void RecordedRun::resume() {
  const Resumption& resumption = *setup_.resumption;
  try {
    execute([&] {
      results::go_on_from(
          resumption.from, simulation_,
          [&](core::StateArchive& state, const auto& started) {
            simulation_.resume(state, started);
          },
          [&] { restore(); });
    });
  } catch (const core::BadState& mistake) {
    results::fail_checkpoint(resumption.file, mistake);
  }
}

/// What the observers have seen.
void RecordedRun::restore() {
  const checkpoint::Checkpoint& from = setup_.resumption->from;
  if (!setup_.display.quiet) summary_.begin_late(from.time);
  if (from.states.contains("summary") && !setup_.display.quiet) {
    results::restore_state(from, "summary", summary_);
  }
  if (!setup_.capture.is_empty()) results::restore_state(from, "captures", setup_.capture);
  records_.restore(from);
  setup_.capture.go_on();
  has_begun_ = true;
  announce();
}

void RecordedRun::flush() {
  records_.flush();
  setup_.capture.flush();
}

void RecordedRun::run_rest(std::vector<core::Intervention> interventions,
                           const std::filesystem::path& stimuli) {
  has_test_report_ = false;
  records_.continue_in_copies(interventions);
  setup_.capture.continue_in_copies(stimuli);
  simulation_.add_interventions(std::move(interventions));
  if (real_time_) real_time_->restart();
  announce();
  execute([&] { simulation_.run_rest(); });
}

void RecordedRun::add_to(checkpoint::Checkpoint& checkpoint) {
  results::add_state(checkpoint, results::kSimulation, simulation_);
  records_.add_to(checkpoint);
  if (!setup_.display.quiet) results::add_state(checkpoint, "summary", summary_);
  if (!setup_.capture.is_empty()) results::add_state(checkpoint, "captures", setup_.capture);
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
  progress_.end(name(simulation_.statistics().end));
  records_.warn_of_units();
  records_.collect_verdicts(records_.is_complete());
  as_run_failure([&] {
    write_statistics(std::nullopt);
    conclude();
  });
}

void RecordedRun::abandon(const std::string& error) {
  core::SpareFiles::release_all();
  setup_.loaded.process()->restore();
  simulation_.abandon();
  conclude_failure(error);
}

/// Files are written from here on, some of them named relative to the working folder.
void RecordedRun::restore_process() const {
  limit_end();
  core::SpareFiles::release_all();
  const std::vector<std::string> changes = setup_.loaded.process()->restore();
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
  records_.collect_verdicts(false);
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
  tell_real_time();
  const bool is_good = simulation_.statistics().end != core::RunEnd::Interrupted &&
                       failures_text(verdicts()).empty();
  if (!is_good) warn_of_failure(rethrow_page_failure);
  require_end();
  require_passed(verdicts());
  rethrow_page_failure();
}

/// In a run that did not reach its end, which is the error to report.
void RecordedRun::warn_of_verdicts() const {
  const std::string failures = failures_text(verdicts());
  if (!failures.empty()) spdlog::warn("checks have failed before the end of the run:{}", failures);
}

/// The test report has what the other files could not be written for, too.
void RecordedRun::write_statistics(std::optional<std::string> error) {
  std::exception_ptr failure;
  try {
    records_.write_files(error);
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  if (has_test_report_) {
    setup_.test_report.write(setup_.options, simulation_.statistics(), verdicts(), error);
  }
  if (failure) std::rethrow_exception(failure);
}

void RecordedRun::write_page() const {
  const std::filesystem::path page = records_.write_page();
  if (page.empty() || !setup_.display.open_report) return;
  if (setup_.display.live != nullptr && setup_.display.live->has_started()) return;
  warn_of_failure([&] { open_in_browser(page); });
}

void RecordedRun::tell_real_time() const {
  if (!real_time_) return;
  if (real_time_->is_late()) {
    spdlog::warn("the run was slower than it should be by --realtime: {}", real_time_->text());
  } else if (!setup_.display.quiet) {
    print_text("{}\n", real_time_->text());
  }
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
             records_.has_coverage() ? coverage_table(coverage()) : "", verdict_table(verdicts()),
             folder.string());
  for (const auto& [what, member] : recorders::kResultFiles) {
    if (!(files.*member).empty()) print_text(" {}", files.*member);
  }
  if (recorders::has_unit_files(folder)) print_text(" {}/", recorders::kUnitsFolder);
  print_text("\n");
}

}  // namespace stride::cli
