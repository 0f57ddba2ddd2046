#include "master/front/cli/campaign/cases/case_run.h"

#include <algorithm>
#include <exception>
#include <optional>

#include <fmt/format.h>

#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/run/branch_runs.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/results/provenance.h"
#include "master/study/results/report_page.h"
#include "master/system/plan/instances.h"

namespace stride::cli {
namespace {

using campaign::CaseResult;

/// That of the first failure, and how many there are.
std::string failure_text(const std::vector<core::Verdict>& verdicts) {
  std::string text;
  std::size_t count = 0;
  for (const core::Verdict& verdict : verdicts) {
    if (verdict.passed != false || ++count > 1) continue;
    const std::string reason = core::reason(verdict);
    text = reason.empty() ? verdict.name : fmt::format("{}: {}", verdict.name, reason);
  }
  return count > 1 ? fmt::format("{} (and {} more)", text, count - 1) : text;
}

std::unique_ptr<recorders::UnitFolders> unit_folders_in(const std::filesystem::path& results,
                                                        const scenario::RunPlan& loaded) {
  if (results.empty()) return nullptr;
  return std::make_unique<recorders::UnitFolders>(results, loaded.component_names());
}

}  // namespace

CaseRun::EndOfUnits::~EndOfUnits() {
  core::SpareFiles::release_all();
  process.restore();
  limit_end();
}

CaseRun::CaseRun(const scenario::ScenarioRequest& request,
                 const std::vector<campaign::Aggregate>& aggregates, const CaseResults& results)
    : loaded_(request),
      target_(target_of(results, loaded_)),
      provenance_(provenance(results, loaded_)),
      aggregates_(aggregates, loaded_.system()),
      options_(run_options()),
      capture_(capture_of(results)),
      unit_folders_(unit_folders_in(target_.folder, loaded_)),
      recorded_({loaded_, options_, provenance_, target_, display_, capture_, no_tests_},
                instantiate()) {
  if (!aggregates.empty()) recorded_.add_observer(aggregates_, aggregates_.signals());
}

results::ResultsTarget CaseRun::target_of(const CaseResults& results,
                                          const scenario::RunPlan& loaded) {
  if (results.folder.empty()) return {{}, results::no_files()};
  results::ResultsTarget target{results.folder, results::possible_files(loaded)};
  if (!results.has_report) target.files.report.clear();
  recorders::make_results_folder(target.folder);
  recorders::check_name_lengths(target.folder, target.files);
  return target;
}

recorders::Provenance CaseRun::provenance(const CaseResults& results,
                                          const scenario::RunPlan& loaded) {
  if (results.folder.empty()) return {};
  return results::provenance_of(loaded, results.command, results.digests);
}

core::RunOptions CaseRun::run_options() const {
  core::RunOptions options = results::options_for(loaded_, target_.files);
  const auto& signals = aggregates_.signals();
  options.watched.insert(options.watched.end(), signals.begin(), signals.end());
  options.interrupted = &Interruption::flag();
  return options;
}

capture::Capture CaseRun::capture_of(const CaseResults& results) const {
  std::vector<capture::CaptureRequest> requests;
  for (const std::string& component : results.captured) {
    requests.push_back({component, results.stimuli / capture::stimuli_file_name(component)});
  }
  if (!requests.empty()) recorders::make_results_folder(results.stimuli);
  return {loaded_.system(), loaded_.scenario().name, options_, requests};
}

std::vector<std::unique_ptr<core::Unit>> CaseRun::instantiate() {
  auto units = scenario::instantiate(loaded_, target_.folder, &Interruption::flag());
  capture_.wrap(units, options_);
  return units;
}

CaseResult CaseRun::run() {
  return result_of([&] { recorded_.run(); });
}

bool CaseRun::prepare_rest() {
  if (!can_fork(loaded_, target_.folder)) return false;
  recorded_.flush();
  return true;
}

CaseResult CaseRun::run_rest(std::span<const scenario::InterventionDeclaration> interventions,
                             Time from, const CaseResults& results) {
  target_ = target_of(results, loaded_);
  provenance_.commands = {results.command};
  return result_of([&] {
    recorded_.run_rest(loaded_.interventions_of_branch(interventions, from), results.stimuli);
  });
}

template <class Go>
CaseResult CaseRun::result_of(Go&& go) {
  std::optional<std::string> failure;
  try {
    go();
  } catch (const core::TakenFileError& taken) {
    end_with(taken.what());
  } catch (const std::exception& error) {
    if (core::is_of_environment(error)) throw;
    failure = in_words(error);
  }
  CaseResult result{.verdicts = campaign::case_verdicts(recorded_.verdicts()),
                    .aggregates = aggregates_.values(),
                    .reached = to_seconds(recorded_.statistics().reached)};
  if (!loaded_.coverage().empty()) {
    const coverage::Report covered = recorded_.coverage();
    result.coverage = {covered.definition, covered_bins(covered)};
  }
  if (!failure) return result;
  const std::string failed = recorded_.failure() ? "" : failure_text(recorded_.verdicts());
  result.outcome = failed.empty() ? campaign::Outcome::Error : campaign::Outcome::Failed;
  result.reason = failed.empty() ? *failure : failed;
  return result;
}

bool CaseRun::was_interrupted() const {
  return recorded_.statistics().end == core::RunEnd::Interrupted;
}

}  // namespace stride::cli
