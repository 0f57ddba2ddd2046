#include "master/study/campaign/shared_beginnings.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

#include <fmt/format.h>

namespace stride::campaign {
namespace {

/// All that decides a run but its interventions.
std::string beginning_of(const scenario::ScenarioRequest& request) {
  std::string text;
  for (const std::string& swap : request.swaps) text += fmt::format("{}:{}", swap.size(), swap);
  for (const auto& parameter : request.parameters) {
    text += fmt::format("{}:{}={}:{}", parameter.name.size(), parameter.name,
                        parameter.value.size(), parameter.value);
  }
  return text;
}

Time first_intervention(const scenario::ScenarioRequest& request, Time stop) {
  Time first = stop;
  for (const auto& declared : request.interventions) first = std::min(first, declared.from);
  return first;
}

class Groups {
 public:
  Groups(const Plan& plan, const scenario::RunTimes& times) : plan_(plan), times_(times) {}

  void add(std::uint64_t index) {
    const scenario::ScenarioRequest request = plan_.request(plan_.at(index));
    const Time until = first_intervention(request, times_.stop);
    if (until <= times_.start) return add_alone(index);
    std::string key = beginning_of(request);
    key += plan_.campaign().keep.may_be_kept(index) ? "+" : "-";
    const auto [place, is_new] = by_beginning_.try_emplace(std::move(key), found_.size());
    if (is_new) return add_alone(index, until);
    SharedBeginning& group = found_[place->second];
    group.until = std::min(group.until, until);
    group.cases.push_back(index);
  }
  void add_alone(std::uint64_t index, Time until = {}) { found_.push_back({until, {index}}); }

  std::vector<SharedBeginning> take() { return std::move(found_); }

 private:
  const Plan& plan_;
  const scenario::RunTimes& times_;
  std::vector<SharedBeginning> found_;
  std::map<std::string, std::size_t> by_beginning_;
};

}  // namespace

std::vector<SharedBeginning> shared_beginnings(const Plan& plan,
                                               std::span<const std::uint64_t> cases,
                                               const scenario::RunTimes& times) {
  Groups groups(plan, times);
  const bool may_share = !plan.campaign().interventions.empty();
  for (const std::uint64_t index : cases) {
    if (may_share) {
      groups.add(index);
    } else {
      groups.add_alone(index);
    }
  }
  return groups.take();
}

}  // namespace stride::campaign
