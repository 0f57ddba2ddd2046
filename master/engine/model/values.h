// Blocks of values of one type, and the text form of a value.
#ifndef STRIDE_MASTER_ENGINE_MODEL_VALUES_H
#define STRIDE_MASTER_ENGINE_MODEL_VALUES_H

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "master/engine/model/conversion.h"
#include "master/engine/model/description.h"
#include "master/engine/model/visit_type.h"

namespace stride::core {

class StateArchive;
using stride::Binary;

/// The bytes of one element of a numeric type (Boolean and Clock: 1); 0 for String and Binary.
std::size_t element_size(ValueType type);

/// A contiguous block of values of one type, as the C ABI wants them. Its size never changes, so
/// pointers into it stay valid.
class ValueBlock {
 public:
  ValueBlock(ValueType type, std::size_t size);

  ValueType type() const { return type_; }
  std::size_t size() const { return size_; }

  /// The elements of a numeric type. T: the C type of the FMI type; bool for Boolean and Clock,
  /// std::int64_t for Enumeration.
  template <class T>
  std::span<T> numbers() {
    assert(sizeof(T) == element_size(type_));
    return {reinterpret_cast<T*>(std::get<Bytes>(data_).data()), size_};
  }
  template <class T>
  std::span<const T> numbers() const {
    assert(sizeof(T) == element_size(type_));
    return {reinterpret_cast<const T*>(std::get<Bytes>(data_).data()), size_};
  }
  /// The first byte of a numeric block.
  std::byte* bytes() { return std::get<Bytes>(data_).data(); }
  const std::byte* bytes() const { return std::get<Bytes>(data_).data(); }
  std::span<std::string> strings() { return std::get<std::vector<std::string>>(data_); }
  std::span<const std::string> strings() const { return std::get<std::vector<std::string>>(data_); }
  std::span<Binary> binaries() { return std::get<std::vector<Binary>>(data_); }
  std::span<const Binary> binaries() const { return std::get<std::vector<Binary>>(data_); }

  bool operator==(const ValueBlock&) const = default;

 private:
  using Bytes = std::vector<std::byte>;  // as operator new aligns them, so for any number

  ValueType type_;
  std::size_t size_;
  std::variant<Bytes, std::vector<std::string>, std::vector<Binary>> data_;
};

/// Calls visitor(std::span<T>) with the elements of the block (const or not) in their C++ type.
template <class Block, class Visitor>
decltype(auto) visit(Block& block, Visitor&& visitor) {
  return visit_type(block.type(), [&]<class T>(std::type_identity<T>) -> decltype(auto) {
    if constexpr (std::is_same_v<T, std::string>) {
      return visitor(block.strings());
    } else if constexpr (std::is_same_v<T, Binary>) {
      return visitor(block.binaries());
    } else {
      return visitor(block.template numbers<T>());
    }
  });
}

/// The elements, of a block of the same type and size.
void persist(StateArchive& state, ValueBlock& block);

/// Copies elements, converted, to a block of the same type or of one that System lets be connected
/// to it; returns whether the target changes. NaN is another value each time.
bool copy_elements(ValueBlock& to, std::size_t to_first, const ValueBlock& from,
                   std::size_t from_first, std::size_t size, const Conversion& conversion = {});

/// An element of a Float64 or Float32 block as a double; set_real() rounds to the block's type.
double real(const ValueBlock& block, std::size_t element);
void set_real(ValueBlock& block, std::size_t element, double value);

/// Elements of a block that keeps them: `size` of them, from `first` on. The block must outlive it.
struct ValueSlice {
  ValueBlock* block = nullptr;
  std::size_t first = 0;
  std::size_t size = 1;

  auto operator<=>(const ValueSlice&) const = default;
};

/// As copy_elements() of blocks; `to` has the size of `from`.
inline bool copy_elements(const ValueSlice& to, const ValueSlice& from,
                          const Conversion& conversion = {}) {
  return copy_elements(*to.block, to.first, *from.block, from.first, from.size, conversion);
}
/// As real() and set_real() of blocks; `element` counts from the beginning of the slice.
inline double real(const ValueSlice& slice, std::size_t element = 0) {
  return real(*slice.block, slice.first + element);
}
inline void set_real(const ValueSlice& slice, double value, std::size_t element = 0) {
  set_real(*slice.block, slice.first + element, value);
}
/// Whether set_real() would change the element.
inline bool would_change(const ValueSlice& slice, double value) {
  return real(slice) !=
         (slice.block->type() == ValueType::Float32 ? static_cast<float>(value) : value);
}

/// The value of type To that one of type From becomes.
template <class To, class From>
To converted(const From& value, const Conversion& conversion) {
  if constexpr (std::is_floating_point_v<From>) {
    if (conversion.linear.is_identity()) return static_cast<To>(value);
    return static_cast<To>(conversion.linear.factor * value + conversion.linear.offset);
  } else if constexpr (std::is_floating_point_v<To>) {
    const auto number =
        conversion.map.empty()
            ? static_cast<double>(value)
            : static_cast<double>(mapped(conversion.map, static_cast<std::int64_t>(value)));
    if (conversion.linear.is_identity()) return static_cast<To>(number);
    return static_cast<To>(conversion.linear.factor * number + conversion.linear.offset);
  } else {
    if (conversion.map.empty() && conversion.truth.empty()) return static_cast<To>(value);
    const std::int64_t number = mapped(conversion.map, static_cast<std::int64_t>(value));
    if constexpr (std::is_same_v<To, bool>) return mapped(conversion.truth, number != 0) != 0;
    return static_cast<To>(number);
  }
}

/// Converts the elements of a block of floating-point numbers.
void convert(ValueBlock& block, const LinearConversion& conversion);

/// Whether a floating-point number of the block is NaN.
bool has_nan(const ValueBlock& block);

/// Whether two elements of blocks of the same type are equal.
bool is_same(const ValueBlock& a, std::size_t a_element, const ValueBlock& b,
             std::size_t b_element);

/// The texts of the elements in that of a variable's value, as parse() reads it. Throws
/// std::invalid_argument for an enumeration's text that can be read in two ways.
std::vector<std::string> element_texts(const Variable& variable, const std::string& text);

/// Parses a variable's value: numbers separated by blanks for an array, "true"/"false"/"1"/"0" for
/// Boolean, the item's name, or else its number, for Enumeration, hexadecimal digits for Binary,
/// the text itself for String. Throws std::invalid_argument whose text contains what was expected.
ValueBlock parse(const Variable& variable, const std::string& text);
/// Likewise a `start` of FMI, which has the number of an item: the number comes before the name.
ValueBlock parse_start(const Variable& variable, const std::string& text);

/// The text of one element: shortest decimal form that reads back the same, "true"/"false",
/// hexadecimal digits.
std::string element_text(const ValueBlock& block, std::size_t element);

/// Those of `count` elements from `first` on, separated by blanks.
std::string elements_text(const ValueBlock& block, std::size_t first, std::size_t count);
/// Those of all elements.
std::string elements_text(const ValueBlock& block);

}  // namespace stride::core

#endif
