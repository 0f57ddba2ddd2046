#include "master/base/state_archive.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include <fmt/format.h>

namespace stride::core {

void StateArchive::end() const {
  if (!rest_.empty()) fail(fmt::format("{} bytes are left over", rest_.size()));
}

void StateArchive::mark(std::string_view name) {
  std::string found(name);
  value(found);
  if (found != name) fail(fmt::format("the state of '{}' was expected next", name));
  mark_ = name;
}

void StateArchive::keys(std::vector<std::uint64_t>& keys, std::uint64_t end) {
  values(keys);
  const auto falls = std::ranges::adjacent_find(keys, std::ranges::greater_equal());
  if (falls != keys.end()) fail("its keys do not ascend");
  if (!keys.empty() && keys.back() >= end) fail("it has a key that does not exist");
}

void StateArchive::fixed_bytes(std::span<std::byte> bytes) {
  check_size(bytes.size());
  copy(bytes.data(), bytes.size());
}

void StateArchive::check_size(std::size_t size) {
  std::uint64_t found = size;
  value(found);
  if (found != size) fail(fmt::format("it has {} elements where there should be {}", found, size));
}

void StateArchive::copy(void* bytes, std::size_t size) {
  if (size == 0) return;
  if (!is_reading_) {
    const auto* const first = static_cast<const std::byte*>(bytes);
    written_.insert(written_.end(), first, first + size);
    return;
  }
  if (size > rest_.size()) fail("it ends too early");
  std::memcpy(bytes, rest_.data(), size);
  rest_ = rest_.subspan(size);
}

void StateArchive::fail(const std::string& what) const {
  throw BadState(mark_.empty() ? what : fmt::format("{}: {}", mark_, what));
}

}  // namespace stride::core
