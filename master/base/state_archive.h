// State as bytes, written and read back by the same functions.
#ifndef STRIDE_MASTER_BASE_STATE_ARCHIVE_H
#define STRIDE_MASTER_BASE_STATE_ARCHIVE_H

#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace stride::core {

/// Bytes that are not the state they are read as.
class BadState : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Either writes or reads. An object with state has one function `persist(StateArchive&)`, which
/// names what it consists of, and serves both directions:
///
///   void Counter::persist(StateArchive& state) {
///     state.mark("counter");
///     state.value(count_);
///     state.values(limits_);
///   }
///
/// Numbers are written as they are in memory. Reading checks sizes, marks and the values of
/// Booleans and enumerations, and throws BadState; it allocates no more than there are bytes for.
/// What the object consists of is then changed in part.
class StateArchive {
 public:
  /// Writes.
  StateArchive() = default;
  /// Reads the bytes, which must outlive this object.
  explicit StateArchive(std::span<const std::byte> bytes) : is_reading_(true), rest_(bytes) {}

  bool is_reading() const { return is_reading_; }
  /// What was written.
  const std::vector<std::byte>& bytes() const { return written_; }
  /// Throws BadState where there is more to read.
  void end() const;

  /// What follows is of this name. Throws BadState where it is something else.
  void mark(std::string_view name);

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void value(Number& number) {
    if constexpr (std::same_as<Number, bool>) {
      auto byte = static_cast<std::uint8_t>(number);
      copy(&byte, 1);
      if (byte > 1) fail("a Boolean is neither 0 nor 1");
      number = byte != 0;
    } else {
      copy(&number, sizeof number);
    }
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void value(Enum& item, Enum last) {
    auto number = static_cast<std::underlying_type_t<Enum>>(item);
    value(number);
    if (number < 0 || number > static_cast<std::underlying_type_t<Enum>>(last)) {
      fail("an item of an enumeration does not exist");
    }
    item = static_cast<Enum>(number);
  }
  template <class Rep, class Period>
  void value(std::chrono::duration<Rep, Period>& duration) {
    Rep count = duration.count();
    copy(&count, sizeof count);
    duration = std::chrono::duration<Rep, Period>(count);
  }
  template <class Clock, class Duration>
  void value(std::chrono::time_point<Clock, Duration>& time) {
    Duration since = time.time_since_epoch();
    value(since);
    time = std::chrono::time_point<Clock, Duration>(since);
  }
  void value(std::string& text) { numbers(text); }
  template <class T>
  void value(std::optional<T>& optional) {
    this->optional(optional, [this](T& element) { value(element); });
  }
  /// `persist(element)` does so with what is in it, if there is something.
  template <class T, class Persist>
  void optional(std::optional<T>& optional, Persist&& persist) {
    bool has_value = optional.has_value();
    value(has_value);
    if (!has_value) return optional.reset();
    if (!optional) optional.emplace();
    persist(*optional);
  }

  /// Each element, of a size that may have changed.
  template <class T>
  void values(std::vector<T>& elements) {
    if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) {
      numbers(elements);
    } else {
      sequence(elements, [this](T& element) { value(element); });
    }
  }
  /// Likewise; `persist(element)` does so with one of them, of one byte at least.
  template <class Sequence, class Persist>
  void sequence(Sequence& elements, Persist&& persist) {
    resize(elements, 1);
    for (auto& element : elements) persist(element);
  }
  /// Elements whose number was fixed where the object was made. Throws BadState for another number.
  template <class Elements, class Persist>
  void fixed(Elements&& elements, Persist&& persist) {
    check_size(std::size(elements));
    for (auto& element : elements) persist(element);
  }
  template <class Elements>
  void fixed(Elements&& elements) {
    fixed(elements, [this](auto& element) { value(element); });
  }
  /// What the following elements are found by, where others may have been written than the reader
  /// has: ascending keys, below `end`.
  void keys(std::vector<std::uint64_t>& keys, std::uint64_t end);
  /// Bytes of a number that was fixed.
  void fixed_bytes(std::span<std::byte> bytes);

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class Sequence>
  void numbers(Sequence& elements) {
    resize(elements, sizeof elements[0]);
    copy(elements.data(), elements.size() * sizeof elements[0]);
  }
  /// To the size that follows; of elements that have so many bytes at least.
  template <class Sequence>
  void resize(Sequence& elements, std::size_t least) {
    std::uint64_t size = elements.size();
    value(size);
    if (!is_reading_) return;
    if (size > rest_.size() / least) fail("there are fewer elements than it says");
    elements.resize(size);
  }
  void check_size(std::size_t size);
  void copy(void* bytes, std::size_t size);

  bool is_reading_ = false;
  std::vector<std::byte> written_;
  std::span<const std::byte> rest_;
  std::string mark_;  ///< the last one, for errors
};

}  // namespace stride::core

#endif
