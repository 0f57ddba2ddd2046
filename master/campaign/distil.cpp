#include "master/campaign/distil.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <queue>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::campaign {
namespace {

/// Items are numbered.
class Cover {
 public:
  explicit Cover(std::span<const DistilCandidate> candidates) : candidates_(candidates) {
    for (const DistilCandidate& candidate : candidates) {
      auto& items = items_.emplace_back();
      for (const std::string& item : candidate.items) {
        items.push_back(numbers_.try_emplace(item, numbers_.size()).first->second);
      }
    }
    covered_.resize(numbers_.size());
  }

  std::vector<DistilledCase> find() {
    choose();
    std::ranges::sort(chosen_, {}, [&](std::size_t place) { return candidates_[place].index; });
    drop_redundant();
    std::vector<DistilledCase> found;
    for (const std::size_t place : chosen_) found.push_back(distilled(place));
    return found;
  }

 private:
  /// How many of a candidate's items were missing when that was counted last. What is missing only
  /// becomes less, so one that is still before the next is the best of all.
  struct Gain {
    std::size_t count;
    std::size_t place;
  };

  bool is_behind(const Gain& a, const Gain& b) const {
    if (a.count != b.count) return a.count < b.count;
    return candidates_[a.place].index > candidates_[b.place].index;
  }

  std::size_t count_missing(std::size_t place) const {
    return static_cast<std::size_t>(
        std::ranges::count(items_[place], 0U, [&](std::size_t item) { return covered_[item]; }));
  }

  void choose() {
    const auto behind = [&](const Gain& a, const Gain& b) { return is_behind(a, b); };
    std::priority_queue<Gain, std::vector<Gain>, decltype(behind)> queue(behind);
    for (std::size_t i = 0; i < items_.size(); ++i) queue.push({items_[i].size(), i});
    while (!queue.empty()) {
      Gain best = queue.top();
      queue.pop();
      best.count = count_missing(best.place);
      if (best.count == 0) continue;
      if (!queue.empty() && is_behind(best, queue.top())) {
        queue.push(best);
        continue;
      }
      chosen_.push_back(best.place);
      for (const std::size_t item : items_[best.place]) ++covered_[item];
    }
  }

  void drop_redundant() {
    for (std::size_t i = chosen_.size(); i-- > 0;) {
      const auto& items = items_[chosen_[i]];
      if (std::ranges::any_of(items, [&](std::size_t item) { return covered_[item] < 2; }))
        continue;
      for (const std::size_t item : items) --covered_[item];
      chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  DistilledCase distilled(std::size_t place) const {
    DistilledCase made{candidates_[place].index};
    for (const std::string& item : candidates_[place].items) {
      if (covered_[numbers_.at(item)] == 1) made.alone.insert(item);
    }
    return made;
  }

  std::span<const DistilCandidate> candidates_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::vector<std::size_t>> items_;  ///< by the place of the candidate
  std::vector<unsigned> covered_;                ///< by how many chosen ones
  std::vector<std::size_t> chosen_;              ///< places
};

}  // namespace

std::vector<DistilledCase> distil(std::span<const DistilCandidate> candidates) {
  return Cover(candidates).find();
}

std::string ending_of(const CaseResult& result) {
  std::set<std::string> failed;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (verdict.passed == false) failed.insert("'" + verdict.name + "'");
  }
  if (failed.empty()) return name(result.outcome);
  return fmt::format("{} by {}", name(result.outcome), fmt::join(failed, ", "));
}

CountedBins::CountedBins(std::string component, std::span<const coverage::GroupDefinition> coverage)
    : component_(std::move(component)),
      coverage_(coverage),
      definition_(coverage::hash(coverage)) {}

std::set<std::string> CountedBins::of(const CaseResult& result) const {
  std::set<std::string> bins;
  if (!result.coverage) return bins;
  const bool is_known = result.coverage->definition == definition_;
  for (const coverage::CoveredGroup& group : result.coverage->bins) {
    if (group.component != component_) continue;
    for (const coverage::CoveredPoint& point : group.points) {
      for (const coverage::CoveredBin& bin : point.bins) {
        if (!is_known || counts(point.name, bin.name)) bins.insert(point.name + ": " + bin.name);
      }
    }
  }
  return bins;
}

bool CountedBins::counts(const std::string& point, const std::string& bin) const {
  const auto group = std::ranges::find(coverage_, component_, &coverage::GroupDefinition::name);
  return std::ranges::find(group->points, point, &coverage::PointDefinition::name)->counts(bin);
}

}  // namespace stride::campaign
