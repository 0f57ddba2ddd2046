#include "master/engine/model/item_set.h"

namespace stride::core {

ItemSet::ItemSet(const EnumerationItems& items) {
  for (const auto& [name, number] : items) numbers_.push_back(number);
  std::ranges::sort(numbers_);
  const auto duplicates = std::ranges::unique(numbers_);
  numbers_.erase(duplicates.begin(), duplicates.end());
  const auto width =
      static_cast<std::uint64_t>(numbers_.back()) - static_cast<std::uint64_t>(numbers_.front());
  is_contiguous_ = width == numbers_.size() - 1;
}

}  // namespace stride::core
