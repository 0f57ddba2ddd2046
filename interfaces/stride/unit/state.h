#ifndef STRIDE_UNIT_STATE_H
#define STRIDE_UNIT_STATE_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace stride {

/// Appends values to a saved state. What can be written: trivially copyable types, std::string, and
/// std::vector or std::deque of what can be written.
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
    write_bytes(&value, sizeof value);
  }
  void write(const std::string& text) { write_sequence(text); }
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
    read_bytes(&value, sizeof value);
  }
  void read(std::string& text) { read_sequence(text); }
  template <class T>
  void read(std::vector<T>& values) {
    read_sequence(values);
  }
  template <class T>
  void read(std::deque<T>& values) {
    read_sequence(values);
  }

  void skip(std::size_t size) {
    if (size > left_) throw std::runtime_error("the saved state ends too early");
    next_ += size;
    left_ -= size;
  }
  std::size_t left() const { return left_; }

 private:
  template <class Sequence>
  void read_sequence(Sequence& values) {
    std::uint64_t size = 0;
    read(size);
    if (size > left_) throw std::runtime_error("the saved state ends too early");
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

  template <class T>
  static StateItem of(T& object) {
    return {&object,
            [](const void* o, StateWriter& writer) { writer.write(*static_cast<const T*>(o)); },
            [](void* o, StateReader& reader) { reader.read(*static_cast<T*>(o)); }};
  }
};

}  // namespace stride

#endif
