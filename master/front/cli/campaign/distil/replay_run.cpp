#include "master/front/cli/campaign/distil/replay_run.h"

#include <exception>

#include <fmt/format.h>

#include "master/base/child_process/child.h"
#include "master/base/error.h"
#include "master/base/files/file_digests.h"
#include "master/front/cli/campaign/cases/case_run.h"
#include "master/front/cli/program/command_line.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"

namespace stride::cli {
namespace {

struct EndOfReplay {
  ~EndOfReplay() { end_guarding(); }
};

/// In the child: why it has not passed; empty if it has.
std::string replay_in_child(const ReplayRun& replay) {
  const EndOfReplay end;
  CrashGuard guard([](const std::string& error) { print_error(error); });
  core::FileDigests digests;
  try {
    scenario::ScenarioRequest request;
    request.scenario = replay.scenario;
    CaseRun run(request, {},
                {.folder = replay.results,
                 .command = {{"run", replay.scenario.string()}, command_line().folder},
                 .digests = digests,
                 .stimuli = replay.stimuli,
                 .captured = {replay.device}});
    const CrashGuard::Scope scope(guard, [&](const std::string& error) {
      print_error(error);
      run.abandon(error);
    });
    return run.run().reason;
  } catch (const std::exception& mistake) {
    if (core::is_of_environment(mistake)) throw;
    return in_words(mistake);
  }
}

}  // namespace

std::optional<std::string> run_replay(const ReplayRun& replay) {
  using End = isolation::ChildOutcome::End;
  const isolation::ChildOutcome outcome =
      isolation::run_in_child([&] { return replay_in_child(replay); },
                              {.interrupted = &Interruption::flag(), .has_keeper = true});
  if (outcome.end == End::Interrupted || Interruption::flag() != 0) {
    core::fail_run({}, "distilling was interrupted, so there is no suite");
  }
  if (outcome.end == End::Threw) {
    core::fail_run({.where = {replay.scenario.string(), 0}}, outcome.text);
  }
  if (outcome.end != End::Answered) {
    return last_error_in(outcome.printed).value_or("its process was ended");
  }
  if (outcome.text.empty()) return std::nullopt;
  return outcome.text;
}

}  // namespace stride::cli
