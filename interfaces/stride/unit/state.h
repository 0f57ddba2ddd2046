#ifndef STRIDE_UNIT_STATE_H
#define STRIDE_UNIT_STATE_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stride {

namespace detail {

/// What a state can hold as it is in memory: it is the same in another process. Of what a struct
/// has inside, only `stride verify` can see whether it is.
template <class T>
constexpr bool is_plain() {
  return std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_member_pointer_v<T> &&
         !std::is_same_v<T, std::string_view>;
}

template <class T>
constexpr bool has_padding() {
  return !std::has_unique_object_representations_v<T> && !std::is_same_v<T, double> &&
         !std::is_same_v<T, float>;
}

/// FNV-1a over whole numbers (Fowler, Noll, Vo).
constexpr std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  return (hash ^ value) * 0x100000001b3U;
}

/// How values of a type are written: kValue differs where those of two types are not written
/// alike; none takes less than kLeast bytes.
template <class T>
struct Layout {
  static constexpr std::uint64_t kKind = std::is_floating_point_v<T> ? 1
                                         : std::is_same_v<T, bool>   ? 2
                                         : std::is_class_v<T>        ? 3
                                         : std::is_signed_v<T>       ? 4
                                         : std::is_enum_v<T>         ? 5
                                                                     : 6;
  static constexpr std::uint64_t kValue = mix(mix(kKind, sizeof(T)), alignof(T));
  static constexpr std::size_t kLeast = sizeof(T);
};
template <>
struct Layout<std::string> {
  static constexpr std::uint64_t kValue = 7;
  static constexpr std::size_t kLeast = 8;
};
template <class T>
struct Layout<std::vector<T>> {
  static constexpr std::uint64_t kValue = mix(8, Layout<T>::kValue);
  static constexpr std::size_t kLeast = 8;
};
template <class T>
struct Layout<std::deque<T>> : Layout<std::vector<T>> {};
template <class T>
struct Layout<std::optional<T>> {
  static constexpr std::uint64_t kValue = mix(9, Layout<T>::kValue);
  static constexpr std::size_t kLeast = 1;
};

}  // namespace detail

/// Appends values to a saved state. What can be written: trivially copyable types, std::string, and
/// std::optional, std::vector or std::deque of what can be written.
///
/// The same values are the same bytes, in each process and build: padding is written as zeros (but
/// for compilers without __builtin_clear_padding()), and what would not be the same, such as
/// pointers and containers without an order, is not accepted. Inside of a struct write no pointer
/// and no std::optional; list its members one by one.
class StateWriter {
 public:
  /// Keeps the buffer's memory, so that repeated saves do not allocate.
  explicit StateWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) { bytes_.clear(); }

  void write_bytes(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  template <class T>
  void write(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>, "list the members of this type one by one");
    static_assert(detail::is_plain<T>(), "an address means nothing in another process");
#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
    if constexpr (detail::has_padding<T>()) {
      T copy = value;
      __builtin_clear_padding(&copy);
      return write_bytes(&copy, sizeof copy);
    }
#endif
#endif
    write_bytes(&value, sizeof value);
  }
  void write(const std::string& text) { write_sequence(text); }
  template <class T>
  void write(const std::optional<T>& optional) {
    write(optional.has_value());
    if (optional) write(*optional);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write_sequence(values);
  }
  template <class T>
  void write(const std::deque<T>& values) {
    write_sequence(values);
  }

 private:
  template <class Sequence>
  void write_sequence(const Sequence& values) {
    write(static_cast<std::uint64_t>(values.size()));
    for (const auto& value : values) write(value);
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Reads back what a StateWriter wrote, in the same order. Throws std::runtime_error past the end.
class StateReader {
 public:
  StateReader(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}

  void read_bytes(void* data, std::size_t size) {
    if (size > left_) throw std::runtime_error("the saved state ends too early");
    if (size != 0) std::memcpy(data, next_, size);
    next_ += size;
    left_ -= size;
  }

  template <class T>
  void read(T& value) {
    static_assert(std::is_trivially_copyable_v<T>, "list the members of this type one by one");
    static_assert(detail::is_plain<T>(), "an address means nothing in another process");
    read_bytes(&value, sizeof value);
  }
  void read(std::string& text) { read_sequence(text); }
  template <class T>
  void read(std::optional<T>& optional) {
    bool has_value = false;
    read(has_value);
    if (!has_value) return optional.reset();
    if (!optional) optional.emplace();
    read(*optional);
  }
  template <class T>
  void read(std::vector<T>& values) {
    read_sequence(values);
  }
  template <class T>
  void read(std::deque<T>& values) {
    read_sequence(values);
  }

  std::size_t left() const { return left_; }

 private:
  /// Makes no more elements than there are bytes for.
  template <class Sequence>
  void read_sequence(Sequence& values) {
    constexpr std::size_t kLeast = detail::Layout<typename Sequence::value_type>::kLeast;
    std::uint64_t size = 0;
    read(size);
    if (size > left_ / kLeast) throw std::runtime_error("the saved state ends too early");
    values.resize(size);
    for (auto& value : values) read(value);
  }

  const std::uint8_t* next_;
  std::size_t left_;
};

/// One member that belongs to a unit's state.
struct StateItem {
  void* object;
  void (*save)(const void* object, StateWriter& writer);
  void (*load)(void* object, StateReader& reader);
  std::uint64_t layout;  ///< differs where members are not saved alike

  template <class T>
  static StateItem of(T& object) {
    return {&object,
            [](const void* o, StateWriter& writer) { writer.write(*static_cast<const T*>(o)); },
            [](void* o, StateReader& reader) { reader.read(*static_cast<T*>(o)); },
            detail::Layout<T>::kValue};
  }
};

}  // namespace stride

#endif
