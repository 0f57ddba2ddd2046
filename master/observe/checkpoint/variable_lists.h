// The lists of variables that a unit's calls are about.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_VARIABLE_LISTS_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_VARIABLE_LISTS_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "master/base/state_archive.h"
#include "master/engine/model/description.h"
#include "master/engine/model/values.h"

namespace stride::checkpoint {

/// Variables of one type, as one call reads or sets them, and the values that were set last.
struct VariableList {
  core::ValueType type{};
  std::vector<core::ValueReference> references;
  std::size_t size = 0;  ///< of their values, element by element
  std::optional<core::ValueBlock> set_values{};
  bool is_known = false;  ///< whether set_values are the values of the last call
  std::optional<core::ValueBlock> read_values{};

  /// Blocks that are made where they are needed first.
  core::ValueBlock& set_block() { return block(set_values); }
  core::ValueBlock& read_block() { return block(read_values); }

 private:
  core::ValueBlock& block(std::optional<core::ValueBlock>& values) const {
    return values ? *values : values.emplace(type, size);
  }
};

/// Each list once, so that a call is noted by the number of its list.
class VariableLists {
 public:
  using Number = std::uint32_t;

  /// Adds the list if it is new. Finding one that follows another as it did before takes one
  /// comparison.
  Number number_of(std::span<const core::ValueReference> references,
                   const core::ValueBlock& values) {
    return number_of(references, values.type(), values.size());
  }
  Number number_of(std::span<const core::ValueReference> references, core::ValueType type,
                   std::size_t size) {
    const Number expected = entries_.empty() ? 0 : entries_[previous_].successor;
    const bool is_expected = expected < entries_.size() && is_of(expected, references, type, size);
    const Number number = is_expected ? expected : find_or_add(references, type, size);
    if (!entries_.empty()) entries_[previous_].successor = number;
    return previous_ = number;
  }
  std::size_t size() const { return entries_.size(); }
  VariableList& operator[](Number number) { return entries_[number].list; }

  /// The next values of each list are to be noted whatever they are.
  void forget_values() {
    for (Entry& entry : entries_) entry.list.is_known = false;
  }

  /// Without the values. Reading throws core::BadState for lists that the description cannot have.
  void persist(core::StateArchive& state, const core::UnitDescription& description);

 private:
  struct Entry {
    VariableList list;
    Number successor = 0;  ///< what came next, the last time
  };
  struct Key {
    core::ValueType type;
    std::size_t size;
    std::vector<core::ValueReference> references;
    auto operator<=>(const Key&) const = default;
  };

  bool is_of(Number number, std::span<const core::ValueReference> references, core::ValueType type,
             std::size_t size) const;
  Number find_or_add(std::span<const core::ValueReference> references, core::ValueType type,
                     std::size_t size);
  static void check(core::StateArchive& state, const VariableList& list,
                    const core::UnitDescription& description);

  std::vector<Entry> entries_;
  std::map<Key, Number> numbers_;
  Number previous_ = 0;
};

}  // namespace stride::checkpoint

#endif
