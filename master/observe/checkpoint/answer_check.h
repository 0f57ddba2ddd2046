// Whether a unit has answered the same again.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_ANSWER_CHECK_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_ANSWER_CHECK_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "master/engine/model/values.h"

namespace stride::checkpoint {

/// A hash of 64 bits over the bits of all that a unit has answered, in its order. The rounds are
/// those of XXH64.
class AnswerCheck {
 public:
  AnswerCheck() = default;
  explicit AnswerCheck(std::uint64_t hash) : hash_(hash) {}

  void add(std::uint64_t word) { hash_ = std::rotl(hash_ + word * kSecond, 31) * kFirst; }
  void add(std::span<const std::byte> bytes) {
    const std::byte* from = bytes.data();
    std::size_t left = bytes.size();
    for (; left >= sizeof(std::uint64_t); left -= sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, from, sizeof word);
      add(word);
      from += sizeof word;
    }
    if (left == 0) return;
    std::uint64_t word = 0;
    std::memcpy(&word, from, left);
    add(word);
  }
  void add(const core::ValueBlock& values) {
    core::visit(values, [&]<class T>(std::span<const T> elements) {
      if constexpr (std::is_arithmetic_v<T>) {
        add(std::as_bytes(elements));
      } else {
        for (const T& element : elements) {
          add(element.size());
          add(std::as_bytes(std::span(element.data(), element.size())));
        }
      }
    });
  }

  std::uint64_t hash() const { return hash_; }
  /// Too little to rely on, but what differs here differs from here on.
  std::uint8_t byte() const { return static_cast<std::uint8_t>(hash_ >> 56); }

 private:
  static constexpr std::uint64_t kFirst = 0x9E3779B185EBCA87;
  static constexpr std::uint64_t kSecond = 0xC2B2AE3D27D4EB4F;

  std::uint64_t hash_ = 0x27D4EB2F165667C5;
};

}  // namespace stride::checkpoint

#endif
