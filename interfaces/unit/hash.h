#ifndef STRIDE_INTERFACES_UNIT_HASH_H
#define STRIDE_INTERFACES_UNIT_HASH_H

#include <cstddef>
#include <cstdint>

namespace stride::kit {

inline constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325U;

/// FNV-1a, 64 bits (Fowler, Noll, Vo), going on from an earlier hash. Where one byte is another,
/// the hash is another.
inline std::uint64_t hash(const void* data, std::size_t size,
                          std::uint64_t earlier = kHashOfNothing) {
  const auto* const bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) earlier = (earlier ^ bytes[i]) * 0x100000001b3U;
  return earlier;
}

}  // namespace stride::kit

#endif
