#include "master/front/cli/run/branches.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/message_text.h"
#include "master/base/parse_option.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"

namespace stride::cli {
namespace {

using End = isolation::ChildOutcome::End;

constexpr int kMostJobs = 1024;

/// Of a branch, for the end of its results, where it is interrupted.
constexpr std::chrono::seconds kGrace{5};

BranchRequest parse_branch(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon + 1 == text.size()) {
    core::fail_input({}, fmt::format("--branch {}: expected SECONDS:FILE", text),
                     "name the instant at which the branches begin, and the file that lists them");
  }
  const auto instant = [&](const std::string&) { return core::parse_time(text.substr(0, colon)); };
  return {core::parse_option("--branch", text, instant), text.substr(colon + 1)};
}

}  // namespace

void add_branch_options(CLI::App& command, BranchOptions& options) {
  command
      .add_option_function<std::string>(
          "--branch", [&](const std::string& text) { options.request = parse_branch(text); },
          "Run further futures, which begin at this simulated time with the interventions that the "
          "file lists, beside the run itself")
      ->type_name("SECONDS:FILE");
  command
      .add_option("--jobs", options.jobs,
                  "How many branches run at the same time; otherwise as many as there are cores")
      ->type_name("N")
      ->check(CLI::Range(1, kMostJobs));
}

Branches::Branches(std::vector<Branch> branches, const BranchOptions& options,
                   const volatile std::sig_atomic_t* interrupted)
    : time_(options.request ? options.request->time : Time{}),
      branches_(std::move(branches)),
      jobs_(options.jobs != 0 ? options.jobs : std::max(std::thread::hardware_concurrency(), 1U)),
      interrupted_(interrupted),
      failures_(branches_.size()) {}

std::optional<core::Pause> Branches::next(Time /*now*/) {
  if (has_forked_) return std::nullopt;
  return core::Pause{.time = time_, .before = true};
}

void Branches::on_pause(Time now) {
  has_forked_ = true;
  are_programs_ = work_.prepare(now);
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    while (running_.size() >= jobs_) collect(std::chrono::milliseconds(20));
    const auto work = [&] {
      work_.rest(branches_[i]);
      return std::string();
    };
    if (*interrupted_ != 0) {
      failures_[i] = "it was interrupted before it began";
      continue;
    }
    running_.push_back(
        {i, isolation::Child(work, {.limit = {}, .interrupted = interrupted_, .grace = kGrace})});
  }
  while (!running_.empty()) collect(std::chrono::milliseconds(100));
  work_.conclude();
}

/// Those that have ended by then.
bool Branches::collect(std::chrono::milliseconds patience) {
  for (auto running = running_.begin(); running != running_.end(); ++running) {
    const auto outcome = running->child.wait(patience / static_cast<int>(running_.size()));
    if (!outcome) continue;
    note_end(running->branch, *outcome);
    running_.erase(running);
    return true;
  }
  return false;
}

void Branches::note_end(std::size_t branch, const isolation::ChildOutcome& outcome) {
  std::optional<std::string>& failure = failures_[branch];
  switch (outcome.end) {
    case End::Answered:
      break;
    case End::Threw:
      failure = outcome.text;
      break;
    case End::Interrupted:
    case End::TimedOut:
    case End::Unkept:  // they have no keeper
      failure = "it was interrupted";
      break;
    case End::Exited:
      if (outcome.code == 0 && are_programs_) break;
      failure = last_error_in(outcome.printed);
      if (failure) break;
      failure = work_.explain(
          branches_[branch],
          fmt::format("something in it has ended its process, with code {}", outcome.code));
      break;
    case End::Killed:
      failure = work_.explain(branches_[branch], fmt::format("its process was killed by {}",
                                                             isolation::signal_name(outcome.code)));
  }
}

std::string Branches::text() const {
  if (!has_forked_) return "";
  Table table({{"branch"}, {"outcome"}, {"because", Table::Align::Left, true}});
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    table.add({branches_[i].name, failures_[i] ? "FAILED" : "passed",
               core::first_line(failures_[i].value_or(""))});
  }
  return fmt::format("\nBranches from {} s on\n{}", core::to_text(time_), table.text());
}

void Branches::require_all() const {
  if (branches_.empty()) return;
  if (!has_forked_) {
    core::fail_run({}, fmt::format("the run ended before {} s, where its branches begin",
                                   core::to_text(time_)));
  }
  const auto is_failed = [](const std::optional<std::string>& failure) { return bool(failure); };
  const auto failed = std::ranges::count_if(failures_, is_failed);
  if (failed == 0) return;
  std::string text = fmt::format("{} of {} {} failed", failed,
                                 core::counted(branches_.size(), "branch", "branches"),
                                 failed == 1 ? "has" : "have");
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    if (!failures_[i]) continue;
    text += fmt::format("\n  {}: {}", branches_[i].name, core::first_line(*failures_[i]));
  }
  core::fail_run({}, text);
}

}  // namespace stride::cli
