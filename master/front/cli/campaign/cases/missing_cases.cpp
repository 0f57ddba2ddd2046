#include "master/front/cli/campaign/cases/missing_cases.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "master/front/cli/program/interruption.h"

namespace stride::cli {
namespace {

/// Those that are looked at together: among them some may share a beginning.
constexpr std::size_t kMostTogether = 1000;
constexpr std::chrono::milliseconds kPatience{100};

}  // namespace

isolation::ChildOptions case_options(const campaign::Campaign& campaign) {
  isolation::ChildOptions options{
      .limit = {}, .interrupted = &Interruption::flag(), .grace = {}, .has_keeper = true};
  if (campaign.wall_time_limit) {
    options.limit = std::chrono::milliseconds(std::llround(*campaign.wall_time_limit * 1000));
  }
  return options;
}

MissingCases::MissingCases(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                           const campaign::CaseFolder& cases, const campaign::CaseScratch& scratch,
                           const Options& options)
    : plan_(plan),
      scenario_(scenario),
      cases_(cases),
      options_(options),
      child_options_(case_options(plan.campaign())),
      runner_(plan, scenario, scratch),
      pool_(options.jobs, child_options_),
      totals_(totals_before()),
      progress_(options.progress, totals_) {
  pool_.adopt_orphans();
}

bool MissingCases::is_interrupted() { return Interruption::flag() != 0; }

campaign::CaseTotals MissingCases::totals_before() {
  campaign::CaseTotals totals{.cases = options_.range.size()};
  is_done_.resize(options_.range.size());
  for (std::uint64_t i = options_.range.first; i <= options_.range.last; ++i) {
    const auto record = cases_.read(i);
    if (!record) continue;
    is_done_[i - options_.range.first] = true;
    totals.add(record->result.outcome);
  }
  return totals;
}

void MissingCases::run() {
  std::vector<std::uint64_t> cases;
  for (std::uint64_t i = options_.range.first; i <= options_.range.last; ++i) {
    if (is_done_[i - options_.range.first]) continue;
    cases.push_back(i);
    if (cases.size() < kMostTogether) continue;
    run_some(cases);
    cases.clear();
  }
  run_some(cases);
  while (!pool_.is_empty() || (!left_over_.empty() && !is_interrupted())) await_room();
  run_doubtful();
  progress_.end(totals_, is_interrupted() ? "interrupted" : "completed");
}

void MissingCases::run_some(const std::vector<std::uint64_t>& cases) {
  const core::RunOptions& run = scenario_.loaded().options();
  std::vector<campaign::SharedBeginning> groups =
      shared_beginnings(plan_, cases, {run.start, run.stop});
  const std::size_t at_once = std::clamp<std::size_t>(groups.size(), 1, options_.jobs);
  for (campaign::SharedBeginning& group : groups) {
    while (pool_.is_full() && !is_interrupted()) await_room();
    if (is_interrupted()) return;
    std::erase_if(group.cases, [&](std::uint64_t index) { return is_done_elsewhere(index); });
    if (group.cases.size() > 1) {
      start_together(std::move(group), (options_.jobs + at_once - 1) / at_once);
    } else if (!group.cases.empty()) {
      start(group.cases.front());
    }
  }
}

/// By another process, since this one began.
bool MissingCases::is_done_elsewhere(std::uint64_t index) {
  const auto record = cases_.read(index);
  if (record) totals_.add(record->result.outcome);
  return record.has_value();
}

void MissingCases::start(std::uint64_t index) {
  pool_.start(index, [&] { return runner_.run(index); });
}

/// It has no limit of its own: each of its parts has one.
void MissingCases::start_together(campaign::SharedBeginning shared, std::size_t jobs) {
  isolation::ChildOptions options = child_options_;
  options.limit.reset();
  const std::uint64_t first = shared.cases.front();
  pool_.start(
      first, [&] { return runner_.run_together(shared, jobs, child_options_); }, options);
  together_.emplace(first, std::move(shared));
}

/// Each for the second time, and alone.
void MissingCases::run_doubtful() {
  std::ranges::sort(doubtful_);
  for (const std::uint64_t index : doubtful_) {
    if (is_interrupted()) return;
    if (is_done_elsewhere(index)) continue;
    conclude(pool_.run_alone(index, [&] { return runner_.run(index); }));
    progress_.show(totals_);
  }
}

/// Those that were left over come first.
void MissingCases::await_room() {
  if (!left_over_.empty() && !pool_.is_full() && !is_interrupted()) {
    start(left_over_.front());
    left_over_.pop_front();
    return;
  }
  collect();
}

void MissingCases::collect() {
  const auto ended = pool_.collect(kPatience);
  count_shared();
  if (ended && together_.contains(ended->index)) {
    end_together(ended->index);
  } else if (ended && runner_.is_doubtful(*ended)) {
    doubtful_.push_back(ended->index);
  } else if (ended) {
    conclude(*ended);
  }
  progress_.show(totals_);
}

void MissingCases::conclude(const CasePool::Ended& ended) {
  if (const auto result = runner_.conclude(ended)) totals_.add(result->outcome);
}

void MissingCases::count_shared() {
  for (auto& [first, shared] : together_) {
    std::erase_if(shared.cases, [&](std::uint64_t index) { return is_done_elsewhere(index); });
  }
}

void MissingCases::end_together(std::uint64_t first) {
  const auto place = together_.find(first);
  left_over_.insert(left_over_.end(), place->second.cases.begin(), place->second.cases.end());
  together_.erase(place);
}

}  // namespace stride::cli
