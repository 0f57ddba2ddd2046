#include "units/player/values.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <type_traits>

namespace player {
namespace {

constexpr std::array<const char*, 15> kNames = {
    "Float32", "Float64", "Int8",    "UInt8",  "Int16",  "UInt16",      "Int32", "UInt32",
    "Int64",   "UInt64",  "Boolean", "String", "Binary", "Enumeration", "Clock"};

[[noreturn]] void refuse(const std::string& text, Type type, const char* expected) {
  throw std::invalid_argument("'" + text + "' is no " + name(type) + "; expected " + expected);
}

template <class T>
T parse_number(const std::string& text, Type type) {
  T value{};
  const char* const last = text.data() + text.size();
  const auto [end, mistake] = std::from_chars(text.data(), last, value);
  if (mistake == std::errc() && end == last) return value;
  refuse(text, type,
         std::is_integral_v<T> ? "a whole number within its range" : "a number such as 1.5e-06");
}

bool parse_boolean(const std::string& text) {
  if (text == "true" || text == "false") return text == "true";
  refuse(text, Type::Boolean, "true or false");
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

Bytes parse_bytes(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const int high = digit(text[i]);
    const int low = i + 1 < text.size() ? digit(text[i + 1]) : -1;
    if (high < 0 || low < 0) refuse(text, Type::Binary, "two hexadecimal digits for each byte");
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
  return bytes;
}

}  // namespace

const char* name(Type type) { return kNames[static_cast<std::size_t>(type)]; }

Type type_named(const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return static_cast<Type>(i);
    known.append(i == 0 ? "" : ", ").append(kNames[i]);
  }
  throw std::invalid_argument("'" + name + "' is no type; expected " + known);
}

Values values_of(Type type) {
  switch (type) {
    case Type::Float32:
      return std::vector<float>();
    case Type::Float64:
      return std::vector<double>();
    case Type::Int8:
      return std::vector<std::int8_t>();
    case Type::UInt8:
      return std::vector<std::uint8_t>();
    case Type::Int16:
      return std::vector<std::int16_t>();
    case Type::UInt16:
      return std::vector<std::uint16_t>();
    case Type::Int32:
      return std::vector<std::int32_t>();
    case Type::UInt32:
      return std::vector<std::uint32_t>();
    case Type::Int64:
    case Type::Enumeration:
      return std::vector<std::int64_t>();
    case Type::UInt64:
      return std::vector<std::uint64_t>();
    case Type::String:
      return std::vector<std::string>();
    case Type::Binary:
      return std::vector<Bytes>();
    case Type::Boolean:
    case Type::Clock:
      break;
  }
  return std::vector<bool>();
}

void append_parsed(Values& values, Type type, const std::string& text) {
  std::visit(
      [&](auto& list) {
        using T = typename std::decay_t<decltype(list)>::value_type;
        if constexpr (std::is_same_v<T, std::string>) {
          list.push_back(text);
        } else if constexpr (std::is_same_v<T, Bytes>) {
          list.push_back(parse_bytes(text));
        } else if constexpr (std::is_same_v<T, bool>) {
          list.push_back(parse_boolean(text));
        } else {
          list.push_back(parse_number<T>(text, type));
        }
      },
      values);
}

void append_default(Values& values) {
  std::visit([](auto& list) { list.emplace_back(); }, values);
}

}  // namespace player
