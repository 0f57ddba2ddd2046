// A value of an Enumeration is one of its items.
#ifndef STRIDE_MASTER_ENGINE_RUN_EXCHANGE_ITEM_CHECK_H
#define STRIDE_MASTER_ENGINE_RUN_EXCHANGE_ITEM_CHECK_H

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/model/item_set.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"

namespace stride::core {

/// Of a unit that has made no step yet: many leave an Enumeration at 0 until then.
class FirstValues {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Without `warn`, they are as others.
  FirstValues(const System& system, Time start, Warn warn = {})
      : system_(system), start_(start), warn_(std::move(warn)) {}

  /// Throws Error (Run), or warns, once for the variable, if the unit that gives its value has made
  /// no step.
  void refuse(VariableId from, const Context& context, const std::string& message,
              const std::string& hint) const;

  bool warns() const { return warn_ != nullptr; }
  void warn(const std::string& message) const { warn_(message); }

 private:
  bool is_before_first_step(std::size_t component, Time time) const;

  const System& system_;
  Time start_;
  Warn warn_;
  mutable std::set<VariableId> said_;
};

/// Throws Error (Run) for an element that is not an item of the unit's Enumeration. A variable of
/// another type, or one whose description lists no items, may have any value.
void check_items(const System& system, VariableId id, const ValueBlock& value, Time time);

/// Throws Error (Run) for an element of the value, which `to` has from `from`, that is not valid;
/// for `first`, if it is given, see FirstValues.
void check_valid(const System& system, VariableId from, VariableId to,
                 std::span<const std::int64_t> valid, const ValueSlice& value, Time time,
                 const FirstValues* first = nullptr);

/// Likewise for one that is not an item of the Enumeration, where the conversion can lead to such.
inline void check_converted(const System& system, VariableId from, VariableId to,
                            const Conversion& conversion, const ValueSlice& value, Time time,
                            const FirstValues* first = nullptr) {
  if (conversion.valid.empty()) [[likely]]
    return;
  check_valid(system, from, to, conversion.valid, value, time, first);
}

/// check_items() of many variables at each communication point.
class ItemCheck {
 public:
  ItemCheck(const System& system, const FirstValues& first) : system_(system), first_(first) {}

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
  void fail(const Value& value, Time time) const;

  const System& system_;
  const FirstValues& first_;
  std::vector<Value> values_;
};

}  // namespace stride::core

#endif
