#include "units/ground_truth/text.h"

#include <array>
#include <charconv>

namespace ground_truth {

std::string quantity_text(double number, const std::string& unit) {
  constexpr int kDigits = 6;
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                 std::chars_format::general, kDigits)
                       .ptr;
  const std::string text(buffer.data(), end);
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace ground_truth
