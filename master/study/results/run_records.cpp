#include "master/study/results/run_records.h"

#include <exception>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/replacement.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/engine/run/step_policies/unlimited_steps.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/demand.h"
#include "master/observe/recorders/run_json.h"
#include "master/study/results/checkpoint_states.h"
#include "master/study/results/report_page.h"

namespace stride::results {
namespace {

std::vector<recorders::CoverageSummary> coverage_summaries(const coverage::Report& report) {
  std::vector<recorders::CoverageSummary> summaries;
  for (const coverage::GroupReport& group : report.groups) {
    summaries.push_back({group.component, group.percentage(), group.goal});
  }
  return summaries;
}

}  // namespace

RunRecords::RunRecords(const RecordedSubject& subject, core::Simulation& simulation,
                       Beginning beginning)
    : subject_(subject),
      simulation_(simulation),
      recorders_(subject_.loaded.system(), subject_.options.stop, subject_.target, beginning),
      checks_(subject_.loaded.checks()),
      coverage_(subject_.loaded.coverage()) {
  recorders_.add_to(simulation_);
  if (!checks_.is_empty()) simulation_.add_observer(checks_, checks_.signals());
  if (coverage_.is_empty()) return;
  coverage_.follow(simulation_);
  simulation_.add_observer(coverage_, coverage_.signals());
}

std::filesystem::path RunRecords::announce() const {
  const auto& [folder, files] = subject_.target;
  std::filesystem::path file = folder / files.statistics;
  if (files.statistics.empty() || core::Replacement::is_at_once(file)) return {};
  try {
    write_run_file(std::nullopt, false);
  } catch (const core::Error&) {  // what is wrong with the disk is an error at the end
  }
  return file;
}

void RunRecords::add_to(checkpoint::Checkpoint& checkpoint) {
  if (!checks_.is_empty()) add_state(checkpoint, "checks", checks_);
  if (has_coverage()) add_state(checkpoint, "coverage", coverage_);
  recorders_.add_to(checkpoint);
}

void RunRecords::restore_checks(const checkpoint::Checkpoint& checkpoint) {
  if (!checks_.is_empty()) restore_state(checkpoint, "checks", checks_);
  if (has_coverage()) restore_state(checkpoint, "coverage", coverage_);
}

void RunRecords::restore(const checkpoint::Checkpoint& checkpoint) {
  restore_checks(checkpoint);
  recorders_.restore(checkpoint);
  recorders_.go_on();
}

void RunRecords::continue_in_copies(std::vector<core::Intervention> further) {
  recorders_.continue_in_copies(subject_.target);
  further_ = std::move(further);
}

void RunRecords::collect_verdicts(bool is_complete) {
  const auto of_units = simulation_.verdicts();
  verdicts_.assign(of_units.begin(), of_units.end());
  const Time reached = simulation_.statistics().reached;
  for (core::Verdict& verdict : checks_.verdicts({reached, is_complete})) {
    verdicts_.push_back(std::move(verdict));
  }
  if (subject_.loaded.demands().empty()) return;
  for (core::Verdict& verdict :
       coverage::verdicts(subject_.loaded.demands(), coverage(), reached, is_complete)) {
    verdicts_.push_back(std::move(verdict));
  }
}

bool RunRecords::is_complete() const {
  const core::RunStatistics& statistics = simulation_.statistics();
  const Time stop = subject_.options.stop;
  const bool is_cut_short = stop < subject_.loaded.scenario().stop.value_or(stop);
  return statistics.end == core::RunEnd::EndedByUnit ||
         (statistics.end == core::RunEnd::Completed && !is_cut_short);
}

coverage::Report RunRecords::coverage() const {
  return coverage_.report(scenario::stem(subject_.loaded.scenario().path));
}

void RunRecords::write_files(std::optional<std::string>& error) const {
  std::exception_ptr failure;
  try {
    write_coverage_file();
    write_run_file(error, true);
  } catch (const std::exception& mistake) {
    failure = std::current_exception();
    if (!error) error = mistake.what();
  }
  if (failure) std::rethrow_exception(failure);
}

void RunRecords::write_coverage_file() const {
  const auto& [folder, files] = subject_.target;
  if (!has_coverage() || files.coverage.empty()) return;
  coverage::write_coverage(folder / files.coverage, coverage());
}

void RunRecords::write_run_file(const std::optional<std::string>& error, bool is_over) const {
  const auto& [folder, files] = subject_.target;
  if (files.statistics.empty()) return;
  core::RunOptions options = subject_.options;
  options.interventions.insert(options.interventions.end(), further_.begin(), further_.end());
  std::vector<recorders::CoverageSummary> summaries;
  if (is_over && has_coverage()) summaries = coverage_summaries(coverage());
  recorders::write_run_json(folder / files.statistics, {.scenario = subject_.loaded.scenario().path,
                                                        .system = subject_.loaded.system(),
                                                        .options = options,
                                                        .provenance = subject_.provenance,
                                                        .statistics = simulation_.statistics(),
                                                        .verdicts = verdicts_,
                                                        .error = error,
                                                        .is_over = is_over,
                                                        .files = files,
                                                        .plots = subject_.loaded.plots(),
                                                        .coverage = summaries});
}

std::filesystem::path RunRecords::write_page() const {
  const auto& [folder, files] = subject_.target;
  if (files.report.empty()) return {};
  write_report(folder, files, folder / files.report);
  return folder / files.report;
}

void RunRecords::warn_of_units() const {
  subject_.loaded.warn_of_other_steps();
  warn_of_late_events();
  warn_of_inexact_repetitions();
}

/// A unit that neither announces its events nor returns early for them has them where steps end.
void RunRecords::warn_of_late_events() const {
  const core::System& system = subject_.loaded.system();
  if (!core::has_unlimited_steps(system, subject_.options)) return;
  const std::span<const core::UnitStatistics> units = simulation_.statistics().units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i].unannounced_events == 0) continue;
    spdlog::warn(
        "unit '{}' had events at the ends of its steps which it had not announced ({}), and "
        "nothing but events ends a step here, so they may be late; <stride:Step maximum=\"…\"/> "
        "(--max-step) ends steps, or says with a long one that this is meant",
        system.components()[i].name, core::counted(units[i].unannounced_events, "time"));
  }
}

/// What follows from such a unit's rollback is not what it would be had its state been saved there.
void RunRecords::warn_of_inexact_repetitions() const {
  const core::System& system = subject_.loaded.system();
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

}  // namespace stride::results
