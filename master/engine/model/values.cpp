#include "master/engine/model/values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/message_text.h"
#include "master/base/state_archive.h"
#include "master/base/text/boolean_text.h"
#include "master/base/text/hex.h"
#include "master/base/text/number_text.h"
#include "master/base/text/words.h"
#include "master/engine/model/item_text.h"

namespace stride::core {
namespace {

[[noreturn]] void reject(const std::string& text, const std::string& expected) {
  throw std::invalid_argument(
      fmt::format("'{}' is not a value for it, expected {}", name_text(text), expected));
}

template <class Number>
void parse_element(const Variable& variable, const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc{} && result.ptr == end) return;
  if constexpr (std::is_floating_point_v<Number>) {
    if (result.ec == std::errc::result_out_of_range && result.ptr == end && is_tiny_number(text)) {
      value = text.starts_with('-') ? Number{-0.0} : Number{0};
      return;
    }
  }
  reject(text, result.ec == std::errc::result_out_of_range
                   ? fmt::format("a number within the range of {}", name(variable.type))
                   : fmt::format("{} number", name_with_article(variable.type)));
}

void parse_element(const Variable&, const std::string& text, bool& value) {
  const auto read = boolean_of(text);
  if (!read) reject(text, "true or false");
  value = *read;
}

void parse_element(const Variable&, const std::string& text, std::string& value) { value = text; }

void parse_element(const Variable&, const std::string& text, Binary& value) {
  if (text.size() % 2 != 0) reject(text, "an even number of hexadecimal digits");
  auto bytes = from_hex(text);
  if (!bytes) reject(text, "hexadecimal digits");
  value = std::move(*bytes);
}

void parse_enumeration(const Variable& variable, const std::string& text, std::int64_t& value) {
  const std::optional<std::int64_t> number = item_number(text, variable.items);
  if (number) {
    value = *number;
    return;
  }
  reject(text, "one of " + item_text(variable.items));
}

template <class T>
std::span<const T> elements(const ValueBlock& block) {
  if constexpr (std::is_same_v<T, std::string>) {
    return block.strings();
  } else if constexpr (std::is_same_v<T, Binary>) {
    return block.binaries();
  } else {
    return block.numbers<T>();
  }
}

/// Writes a value, and returns whether it was another one.
template <class T>
bool change(T& target, T value) {
  const bool changes = !(target == value);
  target = std::move(value);
  return changes;
}

}  // namespace

std::size_t element_size(ValueType type) {
  static constexpr std::size_t kSizes[] = {4, 8, 1, 1, 2, 2, 4, 4, 8, 8, 1, 0, 0, 8, 1};
  return kSizes[static_cast<std::size_t>(type)];
}

ValueBlock::ValueBlock(ValueType type, std::size_t size) : type_(type), size_(size) {
  switch (type) {
    case ValueType::String:
      data_ = std::vector<std::string>(size);
      break;
    case ValueType::Binary:
      data_ = std::vector<Binary>(size);
      break;
    default:
      data_ = Bytes(size * element_size(type));
  }
}

void persist(StateArchive& state, ValueBlock& block) {
  visit(block, [&]<class T>(std::span<T> elements) {
    if constexpr (std::is_same_v<T, Binary>) {
      state.fixed(elements, [&](Binary& element) { state.values(element); });
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, bool>) {
      state.fixed(elements);
    } else {
      state.fixed_bytes(std::as_writable_bytes(elements));
    }
  });
}

bool copy_elements(ValueBlock& to, std::size_t to_first, const ValueBlock& from,
                   std::size_t from_first, std::size_t size, const Conversion& conversion) {
  return visit(to, [&]<class To>(std::span<To> targets) {
    return visit(from, [&]<class From>(std::span<const From> sources) {
      bool changes = false;
      for (std::size_t i = 0; i < size; ++i) {
        const From& source = sources[from_first + i];
        To& target = targets[to_first + i];
        if constexpr (std::is_arithmetic_v<To> && std::is_arithmetic_v<From>) {
          changes |= change(target, converted<To>(source, conversion));
        } else if constexpr (std::is_same_v<To, From>) {
          changes |= change(target, source);
        }
      }
      return changes;
    });
  });
}

double real(const ValueBlock& block, std::size_t element) {
  return block.type() == ValueType::Float32 ? block.numbers<float>()[element]
                                            : block.numbers<double>()[element];
}

void set_real(ValueBlock& block, std::size_t element, double value) {
  if (block.type() == ValueType::Float32) {
    block.numbers<float>()[element] = static_cast<float>(value);
  } else {
    block.numbers<double>()[element] = value;
  }
}

void convert(ValueBlock& block, const LinearConversion& conversion) {
  if (conversion.is_identity()) return;  // which keeps the sign of -0
  visit(block, [&](auto elements) {
    using T = typename decltype(elements)::value_type;
    if constexpr (std::is_floating_point_v<T>) {
      for (T& element : elements) {
        element = static_cast<T>(conversion.factor * element + conversion.offset);
      }
    }
  });
}

bool has_nan(const ValueBlock& block) {
  return visit(block, []<class T>(std::span<const T> values) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::any_of(values.begin(), values.end(), [](T value) { return std::isnan(value); });
    }
    return false;
  });
}

bool is_same(const ValueBlock& a, std::size_t a_element, const ValueBlock& b,
             std::size_t b_element) {
  return visit(a, [&]<class T>(std::span<const T> values) {
    return values[a_element] == elements<T>(b)[b_element];
  });
}

std::vector<std::string> element_texts(const Variable& variable, const std::string& text) {
  if (variable.type == ValueType::Enumeration) {
    if (variable.size != 1) return item_words(text, variable.items);
    return {fmt::format("{}", fmt::join(words_of(text), " "))};
  }
  const bool is_whole = variable.size == 1 && variable.type == ValueType::String;
  if (is_whole || (text.empty() && variable.type == ValueType::Binary)) return {text};
  return words_of(text);
}

ValueBlock parse(const Variable& variable, const std::string& text) {
  ValueBlock block(variable.type, variable.size);
  const std::vector<std::string> words = element_texts(variable, text);
  if (words.size() != variable.size) {
    reject(text, variable.size == 1 ? fmt::format("one {} value", name(variable.type))
                                    : fmt::format("{} {} values separated by blanks", variable.size,
                                                  name(variable.type)));
  }
  if (variable.type == ValueType::Enumeration) {
    const auto values = block.numbers<std::int64_t>();
    for (std::size_t i = 0; i < words.size(); ++i) parse_enumeration(variable, words[i], values[i]);
    return block;
  }
  visit(block, [&](auto values) {
    for (std::size_t i = 0; i < words.size(); ++i) parse_element(variable, words[i], values[i]);
  });
  return block;
}

ValueBlock parse_start(const Variable& variable, const std::string& text) {
  if (variable.type != ValueType::Enumeration) return parse(variable, text);
  return parse(variable, numbers_as_names(text, variable.items));
}

std::string element_text(const ValueBlock& block, std::size_t element) {
  return visit(block, [&](auto values) -> std::string {
    const auto& value = values[element];
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<T, Binary>) {
      return to_hex(value);
    } else {
      return fmt::format("{}", value);
    }
  });
}

std::string elements_text(const ValueBlock& block, std::size_t first, std::size_t count) {
  std::string text;
  for (std::size_t e = 0; e < count; ++e) {
    text += (e == 0 ? "" : " ") + element_text(block, first + e);
  }
  return text;
}

std::string elements_text(const ValueBlock& block) { return elements_text(block, 0, block.size()); }

}  // namespace stride::core
