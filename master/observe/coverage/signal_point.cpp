#include "master/observe/coverage/signal_point.h"

#include <algorithm>

namespace stride::coverage {
namespace {

/// The index of a bin of one part, in the key of a combination.
constexpr unsigned kKeyBits = 16;
static_assert(kMostParts * kKeyBits <= 64);
static_assert(kMostBins + kMostOpenBins + 8 < (1U << kKeyBits));

}  // namespace

void SignalPoint::count_change(Time time) {
  if (definition_.kind == Kind::Values) return tally_.visit(sampled_, time);
  const auto bin = std::get<Items>(*definition_.classes).transition_bin(counted_, sampled_);
  if (bin) tally_.visit(*bin, time);
}

void SignalPoint::persist(core::StateArchive& state) {
  tally_.persist(state);
  const std::size_t size = definition_.kind == Kind::Values
                               ? tally_.bins().size()
                               : std::get<Items>(*definition_.classes).size() + 1;
  persist_bin(state, sampled_, size);
  persist_bin(state, counted_, size);
}

CrossPoint::CrossPoint(const PointDefinition& definition, std::vector<const Point*> parts)
    : Point(definition), parts_(std::move(parts)) {
  for (const Point* const part : parts_) {
    if (!is_of_signal(part->definition().kind)) event_ = &part->definition().id;
  }
  if (!definition_.is_open) add_declared();
}

/// In the order of cross_bins().
void CrossPoint::add_declared() {
  std::vector<std::uint64_t> keys{0};
  for (const Point* const part : parts_) {
    std::vector<std::uint64_t> longer;
    for (const std::uint64_t key : keys) {
      const auto& bins = part->definition().bins;
      for (std::size_t i = 0; i < bins.size(); ++i) {
        if (!bins[i].is_ignored) longer.push_back((key << kKeyBits) | i);
      }
    }
    keys = std::move(longer);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) combinations_.push_back({keys[i], i});
}

std::size_t CrossPoint::find_or_add(std::uint64_t key) {
  const auto place = std::ranges::lower_bound(combinations_, key, {}, &Combination::key);
  if (place != combinations_.end() && place->key == key) return place->bin;
  name_.clear();
  for (const Point* const part : parts_) {
    append_crossed(name_, part->tally().bins()[part->latest()].name);
  }
  const std::size_t bin = tally_.find_or_add(name_);
  if (tally_.bins()[bin].name == name_) combinations_.insert(place, {key, bin});
  return bin;
}

/// Nothing where a part has no bin that counts.
std::optional<std::uint64_t> CrossPoint::latest_key() const {
  std::uint64_t key = 0;
  for (const Point* const part : parts_) {
    const std::size_t latest = part->latest();
    if (latest == kNoBin || part->tally().bins()[latest].is_ignored) return std::nullopt;
    key = (key << kKeyBits) | latest;
  }
  return key;
}

void CrossPoint::visit(Time time) {
  if (const auto key = latest_key()) tally_.visit(find_or_add(*key), time);
}

void CrossPoint::visit_changed(Time time) {
  const auto key = latest_key();
  if (key == last_) return;
  last_ = key;
  if (key) tally_.visit(find_or_add(*key), time);
}

/// The keys of combinations that were not declared are found again by their names.
void CrossPoint::persist(core::StateArchive& state) {
  tally_.persist(state);
  state.value(last_);
}

}  // namespace stride::coverage
