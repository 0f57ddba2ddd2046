#include "master/trace/code_table.h"

#include <cstring>

namespace stride::trace {
namespace {

std::uint64_t key_of(std::string_view code) {
  std::uint64_t key = 0;
  std::memcpy(&key, code.data(), code.size());
  return key;
}

}  // namespace

/// Where the key is, or would be.
std::size_t CodeTable::slot_of(std::uint64_t key) const {
  constexpr std::uint64_t kFibonacci = 0x9e3779b97f4a7c15;
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * kFibonacci) >> 32) & mask;
  while (slots_[at].key != 0 && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

void CodeTable::grow() {
  std::vector<Slot> smaller(slots_.size() * 2);
  smaller.swap(slots_);
  for (const Slot& slot : smaller) {
    if (slot.key != 0) slots_[slot_of(slot.key)] = slot;
  }
}

std::uint32_t CodeTable::add(std::string_view code) {
  if (const auto known = find(code)) return *known;
  if (code.size() > sizeof(std::uint64_t)) {
    long_codes_.emplace(code, size_);
    return size_++;
  }
  if (2 * (std::size_t{size_} + 1) > slots_.size()) grow();
  slots_[slot_of(key_of(code))] = {key_of(code), size_};
  return size_++;
}

std::optional<std::uint32_t> CodeTable::find(std::string_view code) const {
  if (code.size() > sizeof(std::uint64_t)) {
    const auto found = long_codes_.find(std::string(code));
    if (found == long_codes_.end()) return std::nullopt;
    return found->second;
  }
  const Slot& slot = slots_[slot_of(key_of(code))];
  if (slot.key == 0 || code.empty()) return std::nullopt;
  return slot.number;
}

}  // namespace stride::trace
