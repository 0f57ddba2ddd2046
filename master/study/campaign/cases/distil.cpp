#include "master/study/campaign/cases/distil.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <queue>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/observe/coverage/told_apart.h"

namespace stride::campaign {
namespace {

using coverage::PointDefinition;

/// Items are numbered.
class Cover {
 public:
  Cover(std::span<const DistilCandidate> candidates, const Wanted& wanted)
      : candidates_(candidates) {
    for (const DistilCandidate& candidate : candidates) {
      auto& items = items_.emplace_back();
      for (const auto& [item, count] : candidate.items) {
        const std::size_t number = numbers_.try_emplace(item, numbers_.size()).first->second;
        if (number == wanted_.size()) {
          const auto often = wanted.find(item);
          wanted_.push_back(often == wanted.end() ? 1 : often->second);
        }
        items.push_back({number, std::min(count, wanted_[number])});
      }
    }
    had_.resize(numbers_.size());
    want_what_there_is();
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
  struct Item {
    std::size_t number;
    std::uint64_t count;  ///< not more than is wanted
  };
  /// How many of a candidate's items were missing when that was counted last. What is missing only
  /// becomes less, so one that is still before the next is the best of all.
  struct Gain {
    std::uint64_t count;
    std::size_t place;
  };

  /// What all candidates together have less often is wanted once.
  void want_what_there_is() {
    std::vector<std::uint64_t> all(wanted_.size());
    for (const auto& items : items_) {
      for (const auto& [number, count] : items) {
        all[number] += std::min(count, wanted_[number] - all[number]);
      }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] < wanted_[i]) wanted_[i] = 1;
    }
    for (auto& items : items_) {
      for (auto& [number, count] : items) count = std::min(count, wanted_[number]);
    }
  }

  bool is_behind(const Gain& a, const Gain& b) const {
    if (a.count != b.count) return a.count < b.count;
    return candidates_[a.place].index > candidates_[b.place].index;
  }

  std::uint64_t count_missing(std::size_t place) const {
    std::uint64_t missing = 0;
    for (const auto& [number, count] : items_[place]) {
      if (had_[number] < wanted_[number])
        missing += std::min(count, wanted_[number] - had_[number]);
    }
    return missing;
  }

  /// A chosen one without which there is too little of this.
  bool is_needed(const Item& item) const {
    return had_[item.number] - item.count < wanted_[item.number];
  }

  void choose() {
    const auto behind = [&](const Gain& a, const Gain& b) { return is_behind(a, b); };
    std::priority_queue<Gain, std::vector<Gain>, decltype(behind)> queue(behind);
    for (std::size_t i = 0; i < items_.size(); ++i) queue.push({count_missing(i), i});
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
      for (const auto& [number, count] : items_[best.place]) had_[number] += count;
    }
  }

  void drop_redundant() {
    for (std::size_t i = chosen_.size(); i-- > 0;) {
      const auto& items = items_[chosen_[i]];
      if (std::ranges::any_of(items, [&](const Item& item) { return is_needed(item); })) continue;
      for (const auto& [number, count] : items) had_[number] -= count;
      chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  DistilledCase distilled(std::size_t place) const {
    DistilledCase made{candidates_[place].index};
    std::size_t i = 0;
    for (const auto& [item, count] : candidates_[place].items) {
      if (is_needed(items_[place][i++])) made.alone.insert(item);
    }
    return made;
  }

  std::span<const DistilCandidate> candidates_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::vector<Item>> items_;  ///< by the place of the candidate
  std::vector<std::uint64_t> wanted_;
  std::vector<std::uint64_t> had_;   ///< of all chosen ones
  std::vector<std::size_t> chosen_;  ///< places
};

}  // namespace

std::vector<DistilledCase> distil(std::span<const DistilCandidate> candidates,
                                  const Wanted& wanted) {
  return Cover(candidates, wanted).find();
}

std::string ending_of(const CaseResult& result) {
  std::set<std::string> failed;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (verdict.passed == false) failed.insert("'" + verdict.name + "'");
  }
  if (failed.empty()) return name(result.outcome);
  return fmt::format("{} by {}", name(result.outcome), fmt::join(failed, ", "));
}

const coverage::GroupDefinition* CountedBins::group_in(
    const CaseDefinitions::Definitions& all) const {
  const auto group = std::ranges::find(all, component_, &coverage::GroupDefinition::name);
  return group == all.end() ? nullptr : &*group;
}

std::string CountedBins::title(const coverage::GroupDefinition& group,
                               const coverage::PointDefinition& point) const {
  const coverage::GroupDefinition* const usual = group_in(definitions_.of_scenario());
  if (usual == nullptr || usual == &group) return point.name;
  const auto same = std::ranges::find(usual->points, point.name, &PointDefinition::name);
  const std::string definition = hash(group, point);
  if (same == usual->points.end() || hash(*usual, *same) == definition) return point.name;
  return coverage::label(point.name, definition);
}

std::map<std::string, std::uint64_t> CountedBins::of(const CaseResult& result,
                                                     std::uint64_t index) {
  std::map<std::string, std::uint64_t> bins;
  const auto* const definitions =
      result.coverage ? definitions_.of(*result.coverage, index) : nullptr;
  const auto* const group = definitions != nullptr ? group_in(*definitions) : nullptr;
  if (group == nullptr) return bins;
  for (const coverage::CoveredGroup& covered : result.coverage->bins) {
    if (covered.component != component_) continue;
    for (const coverage::CoveredPoint& of_point : covered.points) {
      const auto point = std::ranges::find(group->points, of_point.name, &PointDefinition::name);
      if (point == group->points.end()) continue;
      const std::string before = title(*group, *point) + ": ";
      for (const coverage::CoveredBin& bin : of_point.bins) {
        if (!point->counts(bin.name)) continue;
        bins[before + bin.name] = bin.count;
        if (point->at_least > 1) wanted_[before + bin.name] = point->at_least;
      }
    }
  }
  return bins;
}

}  // namespace stride::campaign
