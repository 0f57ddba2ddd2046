#include "master/observe/coverage/tally.h"

#include <algorithm>
#include <utility>

namespace stride::coverage {

Tally::Tally(const PointDefinition& definition)
    : definition_(definition), declared_(definition.bins.size()) {
  for (const DeclaredBin& bin : definition.bins) add(bin.name, bin.is_ignored);
}

/// Two declared bins may have one name, such as two items of one number: the first one counts.
void Tally::add(std::string name, bool is_ignored) {
  const auto place = std::ranges::upper_bound(
      by_name_, name, {}, [&](std::size_t i) -> const std::string& { return bins_[i].name; });
  by_name_.insert(place, bins_.size());
  bins_.push_back({std::move(name), is_ignored});
}

std::size_t Tally::find_or_add(std::string_view name) {
  const auto named = [&](std::size_t i) -> std::string_view { return bins_[i].name; };
  const auto place = std::ranges::lower_bound(by_name_, name, {}, named);
  if (place != by_name_.end() && named(*place) == name) return *place;
  if (bins_.size() - declared_ >= kMostOpenBins && name != kFurther) return find_or_add(kFurther);
  std::string added(name);
  const bool is_ignored = definition_.ignores(added);
  add(std::move(added), is_ignored);
  return bins_.size() - 1;
}

void Tally::persist(core::StateArchive& state) {
  std::vector<std::string> names;
  for (std::size_t i = declared_; i < bins_.size(); ++i) names.push_back(bins_[i].name);
  state.values(names);
  if (state.is_reading()) {
    for (const std::string& name : names) {
      const std::size_t size = bins_.size();
      if (find_or_add(name) != size) state.fail("a bin of coverage is there twice");
    }
  }
  state.fixed(bins_, [&](Bin& bin) {
    state.value(bin.count);
    state.value(bin.first);
  });
}

void persist_bin(core::StateArchive& state, std::size_t& bin, std::size_t size) {
  std::uint64_t number = bin;
  state.value(number);
  bin = number;
  if (bin != kNoBin && bin >= size) state.fail("there is no such bin of coverage");
}

}  // namespace stride::coverage
