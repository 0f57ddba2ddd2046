// A value of an Enumeration is one of its items.
#ifndef STRIDE_MASTER_ALGORITHM_EXCHANGE_ITEM_CHECK_H
#define STRIDE_MASTER_ALGORITHM_EXCHANGE_ITEM_CHECK_H

#include <cstdint>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/model/item_set.h"
#include "master/model/system.h"
#include "master/model/values.h"

namespace stride::core {

/// Throws Error (Run) for an element that is not an item of the unit's Enumeration. A variable of
/// another type, or one whose description lists no items, may have any value.
void check_items(const System& system, VariableId id, const ValueBlock& value, Time time);

/// Throws Error (Run) for an element of the value, which `to` has from `from`, that is not valid.
void check_valid(const System& system, VariableId from, VariableId to,
                 std::span<const std::int64_t> valid, const ValueSlice& value, Time time);

/// Likewise for one that is not an item of the Enumeration, where the conversion can lead to such.
inline void check_converted(const System& system, VariableId from, VariableId to,
                            const Conversion& conversion, const ValueSlice& value, Time time) {
  if (conversion.valid.empty()) [[likely]]
    return;
  check_valid(system, from, to, conversion.valid, value, time);
}

/// check_items() of many variables at each communication point.
class ItemCheck {
 public:
  explicit ItemCheck(const System& system) : system_(system) {}

  /// The value must stay where it is.
  void add(VariableId id, const ValueSlice& value);
  bool is_empty() const { return values_.empty(); }
  void check(Time time) const {
    for (const Value& value : values_) {
      if (!value.items.contains(*value.number)) [[unlikely]]
        fail(value, time);
    }
  }

 private:
  struct Value {
    VariableId id;
    const std::int64_t* number;
    ItemSet items;
  };
  [[noreturn]] void fail(const Value& value, Time time) const;

  const System& system_;
  std::vector<Value> values_;
};

}  // namespace stride::core

#endif
