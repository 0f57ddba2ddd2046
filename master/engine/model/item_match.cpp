#include "master/engine/model/item_match.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "master/base/text/lower_case.h"

namespace stride::core {
namespace {

using Item = EnumerationItems::value_type;

/// Null if there is none, or more than one that differs by case alone.
const Item* find_named(const EnumerationItems& items, const std::string& name) {
  const auto exact = std::ranges::find(items, name, &Item::first);
  if (exact != items.end()) return &*exact;
  const Item* found = nullptr;
  for (const Item& item : items) {
    if (lower_case(item.first) != lower_case(name)) continue;
    if (found != nullptr) return nullptr;
    found = &item;
  }
  return found;
}

}  // namespace

ItemMatch match_items(const EnumerationItems& from, const EnumerationItems& to) {
  ItemMatch match;
  std::map<std::int64_t, std::int64_t> numbers;
  bool all_named = true, is_changed = false;
  for (const auto& [name, number] : from) {
    if (const Item* const same = find_named(to, name)) {
      all_named &= numbers.try_emplace(number, same->second).first->second == same->second;
      if (same->second == number) continue;
      is_changed = true;
      match.contradictions.push_back(fmt::format("'{}' is {} and {}", name, number, same->second));
    } else {
      all_named = false;
      const auto other = std::ranges::find(to, number, &Item::second);
      if (other == to.end()) continue;
      match.renamed.push_back(fmt::format("'{}' ({}) becomes '{}'", name, number, other->first));
    }
  }
  if (!all_named || !is_changed) return match;
  match.by_name.assign(numbers.begin(), numbers.end());
  match.contradictions.clear();
  return match;
}

}  // namespace stride::core
