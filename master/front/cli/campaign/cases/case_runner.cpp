#include "master/front/cli/campaign/cases/case_runner.h"

#include <algorithm>
#include <csignal>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/child_process/keeper.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/process/deadline.h"
#include "master/base/process/host_name.h"
#include "master/front/cli/campaign/cases/case_run.h"
#include "master/front/cli/program/command_line.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/machine_lack.h"
#include "master/front/cli/program/output.h"
#include "master/loader/fmu/fmu.h"
#include "master/observe/capture/capture.h"
#include "master/observe/capture/unended_stimuli.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/provenance.h"
#include "master/study/results/report_page.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;
using campaign::CaseResult;
using campaign::Outcome;
using End = isolation::ChildOutcome::End;

struct EndOfCase {
  ~EndOfCase() { end_guarding(); }
};

/// To the process that has started this one.
void tell_of_crash(const std::string& error) {
  const std::string line = fmt::format("\n{}{}\n", kErrorMark, error);
  (void)!::write(STDERR_FILENO, line.data(), line.size());
}

CaseResult crashed(const isolation::ChildOutcome& outcome) {
  std::optional<std::string> reason = last_error_in(outcome.printed);
  if (!reason) {
    reason = outcome.end == End::Killed
                 ? fmt::format("its process was killed by {}", isolation::signal_name(outcome.code))
                 : fmt::format("its process ended with the exit code {}", outcome.code);
  }
  return {.outcome = Outcome::Crashed, .reason = std::move(*reason)};
}

/// Whoever ends a job of a cluster signals its processes one by one, and this one may be the last:
/// what became of a case that had lost one of its processes would be taken for its own error.
void await_end_of_job() {
  constexpr timespec kPatience{.tv_sec = 0, .tv_nsec = 50'000'000};
  if (Interruption::flag() == 0) ::nanosleep(&kPatience, nullptr);  // a signal ends it
}

/// It may have been a signal from outside; others are of the case's own making.
bool may_be_killed_from_outside(const isolation::ChildOutcome& outcome) {
  return outcome.end == End::Unkept ||
         (outcome.end == End::Killed &&
          (outcome.code == SIGKILL || outcome.code == SIGTERM || outcome.code == SIGHUP));
}

/// For conclude(), by way of an exception: what a case lacks is not its own fault.
[[noreturn]] void fail_lacking(const std::exception& lack) {
  throw std::runtime_error(in_words(lack));
}

void add_libraries(core::FileStamps& libraries, const importer::Fmu& fmu) {
  if (fmu.folder().empty()) return libraries.add(fmu.path());
  std::error_code none;
  for (fs::recursive_directory_iterator entry(fmu.folder() / "binaries", none), end;
       !none && entry != end; entry.increment(none)) {
    if (core::is_file(entry->path())) libraries.add(entry->path());
  }
}

void add_files(core::FileStamps& files, const scenario::RunPlan& loaded) {
  for (const results::KeptPath& input : results::inputs_of(loaded)) {
    if (core::is_file(input.path)) files.add(input.path);
  }
  for (const auto& fmu : loaded.fmus()) {
    const fs::path folder = fmu->folder().empty() ? fmu->resources() : fmu->folder();
    if (core::is_folder(folder)) files.add(folder);
  }
}

bool is_complete(const CaseResult& result) {
  return result.outcome == Outcome::Passed || result.outcome == Outcome::Failed;
}

}  // namespace

CaseRunner::CaseRunner(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                       const campaign::CaseScratch& scratch)
    : plan_(plan), scenario_(scenario), scratch_(scratch), digests_(scenario.digests()) {
  ssp::Files& files = *scenario.loaded().scenario().files;
  for (const fs::path& document : std::set(files.documents())) {
    if (core::is_file(document)) files.read_ahead(document);
  }
  results::provenance_of(scenario.loaded(), {}, digests_);
  add_files(files_, scenario.loaded());
  for (const auto& [path, fmu] : *scenario.units()) add_libraries(libraries_, *fmu);
  for (const auto& alternative : scenario.alternatives()) {
    results::provenance_of(alternative.loaded, {}, digests_);
    add_files(files_, alternative.loaded);
  }
}

bool CaseRunner::has_hosts() const {
  return std::ranges::any_of(scenario_.loaded().hostings(),
                             [](const auto& hosting) { return hosting.has_value(); });
}

std::string CaseRunner::run(std::uint64_t index) const {
  const EndOfCase end;
  bool was_interrupted = false;
  const CaseResult result = simulate(index, was_interrupted);
  if (result.outcome == Outcome::Error && has_hosts()) {
    await_end_of_job();
    was_interrupted |= Interruption::flag() != 0;
  }
  return was_interrupted ? "" : campaign::record_line(plan_, plan_.at(index), result);
}

scenario::ScenarioRequest CaseRunner::request(std::uint64_t index) const {
  scenario::ScenarioRequest request = plan_.request(plan_.at(index));
  request.files = scenario_.loaded().scenario().files;
  request.units = scenario_.units();
  return request;
}

CaseResults CaseRunner::results(std::uint64_t index) const {
  const campaign::Keep& keep = plan_.campaign().keep;
  CaseResults results{.folder = keep.may_be_kept(index) ? scratch_.results(index) : fs::path(),
                      .has_report = keep.are_kept_anyway(index),
                      .command = {plan_.words(plan_.at(index)), command_line().folder},
                      .digests = digests_,
                      .stimuli = scratch_.stimuli(index)};
  for (const auto& [component, where] : plan_.campaign().captures) {
    results.captured.push_back(component);
  }
  return results;
}

CaseResult CaseRunner::simulate(std::uint64_t index, bool& was_interrupted) const {
  CrashGuard guard(tell_of_crash);
  try {
    CaseRun run(request(index), plan_.campaign().aggregates, results(index));
    const CrashGuard::Scope scope(guard, [&](const std::string& error) {
      tell_of_crash(error);
      run.abandon(error);
    });
    CaseResult result = run.run();
    was_interrupted = run.was_interrupted();
    return result;
  } catch (const std::exception& mistake) {
    if (core::is_of_environment(mistake)) fail_lacking(mistake);
    return {.outcome = Outcome::Error, .reason = in_words(mistake)};
  }
}

// ---- Several from a common beginning ----

namespace {

/// Ends the run of the beginning. It is no std::exception, so nothing takes it for a failure.
struct EndOfBeginning {};

/// Where the beginning ends.
class Fork final : public core::RunControl {
 public:
  Fork(Time time, std::function<void()> work) : time_(time), work_(std::move(work)) {}

  std::optional<core::Pause> next(Time /*now*/) override {
    if (is_over_) return std::nullopt;
    return core::Pause{.time = time_, .before = true};
  }
  void on_pause(Time /*now*/) override {
    is_over_ = true;
    work_();
    throw EndOfBeginning();
  }

 private:
  Time time_;
  std::function<void()> work_;
  bool is_over_ = false;  ///< in forks, too
};

}  // namespace

std::string CaseRunner::run_together(const campaign::SharedBeginning& shared, std::size_t jobs,
                                     const isolation::ChildOptions& options) const {
  const EndOfCase end;
  const CrashGuard guard;
  const auto began = std::chrono::steady_clock::now();
  std::optional<core::Deadline> deadline(options.limit);
  const std::uint64_t first = shared.cases.front();
  CaseResults results = this->results(first);
  if (!results.folder.empty()) results.folder = scratch_.file(fmt::format("beginning_{}", first));
  results.stimuli = scratch_.file(fmt::format("beginning_{}.stimuli", first));
  scenario::ScenarioRequest request = this->request(first);
  request.interventions.clear();
  try {
    CaseRun run(request, plan_.campaign().aggregates, results);
    Fork fork(shared.until, [&] {
      deadline.reset();
      if (!run.prepare_rest() || isolation::is_keeper_limited()) return;
      // the beginning is a part of each
      const auto beginning = std::chrono::steady_clock::now() - began;
      isolation::ChildOptions rest = options;
      if (rest.limit)
        *rest.limit -= std::chrono::duration_cast<std::chrono::milliseconds>(beginning);
      CasePool pool(jobs, rest);
      const auto collect = [&] {
        auto ended = pool.collect(std::chrono::milliseconds(100));
        if (!ended) return;
        ended->wall_time += beginning;
        if (!is_doubtful(*ended)) conclude(*ended);
      };
      for (const std::uint64_t index : shared.cases) {
        while (pool.is_full()) collect();
        if (Interruption::flag() != 0) break;
        pool.start(index, [&, index] { return simulate_rest(index, shared, run); });
      }
      while (!pool.is_empty()) collect();
    });
    run.set_control(fork);
    run.run();
  } catch (const EndOfBeginning&) {
  } catch (const std::exception&) {  // each case says it for itself
  }
  std::error_code ignored;  // they go with the folder that they are in
  fs::remove_all(results.folder, ignored);
  fs::remove_all(results.stimuli, ignored);
  return "";
}

std::string CaseRunner::simulate_rest(std::uint64_t index, const campaign::SharedBeginning& shared,
                                      CaseRun& run) const {
  const EndOfCase end;
  const CrashGuard guard([&](const std::string& error) {
    tell_of_crash(error);
    run.abandon(error);
  });
  CaseResult result;
  try {
    const auto interventions = plan_.request(plan_.at(index)).interventions;
    result = run.run_rest(interventions, shared.until, results(index));
  } catch (const std::exception& mistake) {
    if (core::is_of_environment(mistake)) fail_lacking(mistake);
    result = {.outcome = Outcome::Error, .reason = in_words(mistake)};
  }
  return run.was_interrupted() ? "" : campaign::record_line(plan_, plan_.at(index), result);
}

std::optional<CaseResult> CaseRunner::result_of(const CasePool::Ended& ended) const {
  const isolation::ChildOutcome& outcome = ended.outcome;
  switch (outcome.end) {
    case End::Answered:
      return campaign::parse_record(plan_, ended.index, outcome.text);
    case End::Threw:
      return CaseResult{.outcome = Outcome::Error, .reason = outcome.text};
    case End::TimedOut:
      return CaseResult{.outcome = Outcome::TimedOut,
                        .reason = fmt::format("it took longer than {} s of wall time",
                                              plan_.campaign().wall_time_limit.value_or(0))};
    case End::Interrupted:
      return std::nullopt;
    case End::Unkept:
      return CaseResult{
          .outcome = Outcome::Crashed,
          .reason =
              "the process that watches over it was ended or limited, by a unit or from outside"};
    case End::Exited:
    case End::Killed:
      break;
  }
  return crashed(outcome);
}

bool CaseRunner::is_doubtful(const CasePool::Ended& ended) const {
  const auto result = result_of(ended);
  if (!result || is_complete(*result)) return false;
  const bool may_be_killed = may_be_killed_from_outside(ended.outcome);
  if (may_be_killed) await_end_of_job();
  if (!may_be_killed && ended.outcome.end != End::Threw && !scratch_.why_unusable()) return false;
  scratch_.drop_all(ended.index);
  return true;
}

std::optional<CaseResult> CaseRunner::conclude(const CasePool::Ended& ended) const {
  std::optional<CaseResult> result = result_of(ended);
  if (!result || (!is_complete(*result) && Interruption::flag() != 0)) {
    scratch_.drop_all(ended.index);
    return std::nullopt;
  }
  require_libraries(ended.index);
  if (!is_complete(*result)) require_circumstances(ended, *result);
  result->wall_time = ended.wall_time.count();
  result->began = results::utc_text(ended.began);
  result->host = core::host_name();
  result->reason = with_lasting_paths(ended.index, std::move(result->reason));
  const bool is_wanted =
      plan_.campaign().keep.are_kept_anyway(ended.index) || result->outcome != Outcome::Passed;
  result->has_results = is_wanted && core::is_folder(scratch_.results(ended.index));
  if (result->has_results) {
    try {
      complete_results(ended.index, *result);
    } catch (const std::exception& failure) {
      if (core::is_of_environment(failure)) {
        fail_case(ended.index, "its results cannot be completed", in_words(failure), "make room");
      }
      print_warnings({{in_words(failure)}});
    }
    scratch_.keep_results(ended.index);
  } else {
    scratch_.drop_results(ended.index);
  }
  conclude_stimuli(ended.index, *result);
  scratch_.write(ended.index, campaign::record_line(plan_, plan_.at(ended.index), *result));
  return result;
}

void CaseRunner::fail_case(std::uint64_t index, const std::string& why, const std::string& because,
                           const std::string& hint) {
  core::fail_run(
      {}, fmt::format("{}, so case {} is not done: {}", why, index, core::first_line(because)),
      hint + ", and run the campaign again: it goes on");
}

/// A case with another one may pass, too.
void CaseRunner::require_libraries(std::uint64_t index) const {
  if (const auto file = libraries_.changed()) {
    fail_case(index, fmt::format("'{}' is not what it was when the campaign began", file->string()),
              "it may have loaded another library", "leave the file alone");
  }
}

/// What a record says is a function of the plan only if these are as they should be.
void CaseRunner::require_circumstances(const CasePool::Ended& ended,
                                       const CaseResult& result) const {
  const bool lacked_something = ended.outcome.end == End::Threw;
  const auto fail = [&](const std::string& why, const std::string& hint) {
    fail_case(ended.index, why, result.reason, hint);
  };
  if (lacked_something) scratch_.drop_all(ended.index);
  auto reason = scratch_.why_unusable(lacked_something);
  if (reason && !lacked_something) {
    scratch_.drop_all(ended.index);
    reason = scratch_.why_unusable();
  }
  if (reason) fail(*reason, "mend that");
  if (const auto file = files_.changed()) {
    fail(fmt::format("'{}' is not what it was when the campaign began", file->string()),
         "put it back");
  }
  if (!(isolation::ProcessLimits() == limits_)) {
    fail("some unit has changed the limits of the campaign's own process",
         "leave that unit out, or run it in a process of its own (<stride:Host>)");
  }
  if (!lacked_something) return;
  if (const auto lack = find_machine_lack()) fail(lack->what, lack->hint);
  if (has_units_elsewhere()) fail("a machine of one of its units is lost", "see to it");
}

bool CaseRunner::has_units_elsewhere() const {
  return std::ranges::any_of(scenario_.loaded().hostings(),
                             [](const auto& hosting) { return hosting && hosting->remote; });
}

/// What the process of the case could not do itself.
void CaseRunner::complete_results(std::uint64_t index, const CaseResult& result) const {
  const results::ResultsTarget target{scratch_.results(index),
                                      scenario_.loaded().scenario().annotation.results};
  const auto& [folder, files] = target;
  const bool has_ended = result.outcome == Outcome::Failed || result.outcome == Outcome::Passed;
  if (!has_ended)
    results::add_error(target, result.reason,
                       result.reached ? std::nullopt : std::optional(Time{}));
  if (!results::has_reports() || files.report.empty() || core::is_file(folder / files.report))
    return;
  if (core::is_file(folder / files.statistics))
    results::write_report(folder, files, folder / files.report);
}

/// Files that a process could not end are ended here; one that has no step is none.
void CaseRunner::conclude_stimuli(std::uint64_t index, const CaseResult& result) const {
  if (plan_.campaign().captures.empty()) return;
  const fs::path folder = scratch_.stimuli(index);
  const std::string ending = fmt::format("failed: {}", core::first_line(result.reason));
  bool has_any = false;
  std::error_code none;
  for (const auto& [component, where] : plan_.campaign().captures) {
    const fs::path file = folder / capture::stimuli_file_name(component);
    if (!core::is_file(file)) continue;
    if (capture::end_stimuli(file, ending)) {
      has_any = true;
    } else {
      fs::remove(file, none);
    }
  }
  if (has_any) {
    scratch_.keep_stimuli(index);
  } else {
    scratch_.drop_stimuli(index);
  }
}

/// Its results are elsewhere while a case runs, and that is not to be seen.
std::string CaseRunner::with_lasting_paths(std::uint64_t index, std::string text) const {
  const std::string fresh = scratch_.results(index).string();
  const std::string lasting = scratch_.results_name(index).string();
  for (std::size_t at = 0; (at = text.find(fresh, at)) != std::string::npos;) {
    text.replace(at, fresh.size(), lasting);
    at += lasting.size();
  }
  return text;
}

}  // namespace stride::cli
