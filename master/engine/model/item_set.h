// The numbers of the items of an enumeration, to be looked up often.
#ifndef STRIDE_MASTER_ENGINE_MODEL_ITEM_SET_H
#define STRIDE_MASTER_ENGINE_MODEL_ITEM_SET_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include "master/engine/model/transformation.h"

namespace stride::core {

class ItemSet {
 public:
  /// There must be an item.
  explicit ItemSet(const EnumerationItems& items);

  bool contains(std::int64_t number) const {
    if (number < numbers_.front() || number > numbers_.back()) return false;
    return is_contiguous_ || std::ranges::binary_search(numbers_, number);
  }

 private:
  std::vector<std::int64_t> numbers_;  ///< sorted, without duplicates
  bool is_contiguous_ = false;
};

}  // namespace stride::core

#endif
