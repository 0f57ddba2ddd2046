#include <cctype>

#include <stride/systemc/conversion.h>

namespace stride::systemc::detail {
namespace {

constexpr const char* kDigits = "0123456789abcdef";

int value_of(char digit) {
  const std::string digits = kDigits;
  return static_cast<int>(digits.find(static_cast<char>(std::tolower(digit))));
}

}  // namespace

void fail_range(const std::string& value, const std::string& type, const std::string& range) {
  throw std::out_of_range(value + " does not fit into " + type + ", which hold " + range);
}

std::string hexadecimal(const std::string& digits) {
  std::string text = "0x";
  const std::size_t leading = digits.size() % 4;
  for (std::size_t i = 0; i < digits.size();) {
    const std::size_t size = i == 0 && leading != 0 ? leading : 4;
    text += kDigits[std::stoi(digits.substr(i, size), nullptr, 2)];
    i += size;
  }
  return text;
}

std::string binary(const std::string& hexadecimal, int width, const std::string& type) {
  const bool has_prefix = hexadecimal.rfind("0x", 0) == 0 || hexadecimal.rfind("0X", 0) == 0;
  std::string bits;
  for (std::size_t i = has_prefix ? 2 : 0; i < hexadecimal.size(); ++i) {
    if (std::isxdigit(static_cast<unsigned char>(hexadecimal[i])) == 0) {
      fail_range('"' + hexadecimal + '"', type, "hexadecimal digits, such as 0x1f");
    }
    const int value = value_of(hexadecimal[i]);
    for (int bit = 3; bit >= 0; --bit) bits += (value >> bit & 1) != 0 ? '1' : '0';
  }
  const std::size_t first = bits.find('1');
  bits = first == std::string::npos ? "" : bits.substr(first);
  const auto size = static_cast<std::size_t>(width);
  if (bits.size() > size) {
    fail_range(hexadecimal, type, "numbers below 2^" + std::to_string(width));
  }
  return std::string(size - bits.size(), '0') + bits;
}

}  // namespace stride::systemc::detail
