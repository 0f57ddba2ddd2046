#ifndef STRIDE_MASTER_BASE_TEXT_FIXED_TEXT_H
#define STRIDE_MASTER_BASE_TEXT_FIXED_TEXT_H

#include <cstddef>
#include <cstring>
#include <string_view>

namespace stride::core {

/// A text in memory of its own, of at most kSize - 1 bytes; what is longer is cut off. Whatever its
/// memory holds, reading it stays within.
template <std::size_t kSize>
class FixedText {
 public:
  FixedText() = default;
  explicit FixedText(std::string_view text) noexcept { set(text); }

  void set(std::string_view text) noexcept { text_[text.copy(text_, kSize - 1)] = '\0'; }
  std::string_view view() const noexcept { return {text_, ::strnlen(text_, kSize - 1)}; }

 private:
  char text_[kSize] = {};
};

}  // namespace stride::core

#endif
