#include "master/front/cli/campaign/cases/case_pool.h"

#include <utility>

namespace stride::cli {

void CasePool::start(std::uint64_t index, const std::function<std::string()>& work,
                     const isolation::ChildOptions& options) {
  const auto begin = Clock::now();
  running_.push_back({index, begin, std::time(nullptr), isolation::Child(work, options)});
}

std::optional<CasePool::Ended> CasePool::collect(std::chrono::milliseconds patience) {
  const auto end = Clock::now() + patience;
  while (!is_empty()) {
    if (auto ended = take_ended()) return ended;
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (rest.count() <= 0) break;
    isolation::Child::await_any(children(), rest);
  }
  return std::nullopt;
}

CasePool::Ended CasePool::run_alone(std::uint64_t index, const std::function<std::string()>& work) {
  start(index, work);
  std::optional<Ended> ended;
  while (!ended) ended = collect(std::chrono::hours(1));
  return std::move(*ended);
}

void CasePool::adopt_orphans() {
  isolation::adopt_orphans();
  adopts_orphans_ = true;
}

std::vector<const isolation::Child*> CasePool::children() const {
  std::vector<const isolation::Child*> children;
  for (const Running& running : running_) children.push_back(&running.child);
  return children;
}

std::optional<CasePool::Ended> CasePool::take_ended() {
  for (auto running = running_.begin(); running != running_.end(); ++running) {
    auto outcome = running->child.wait({});
    if (!outcome) continue;
    Ended ended{running->index, std::move(*outcome), Clock::now() - running->begin, running->began};
    running_.erase(running);
    const bool is_good = ended.outcome.end == isolation::ChildOutcome::End::Answered;
    if (adopts_orphans_ && !is_good) isolation::Child::end_others(children());
    return ended;
  }
  return std::nullopt;
}

}  // namespace stride::cli
