// A packet, the content of a request or reply, written into memory and read from it. Numbers have a
// fixed size and are little-endian, as in the memory of the machines that stride runs on.
#ifndef STRIDE_MASTER_LOADER_WIRE_PACKET_H
#define STRIDE_MASTER_LOADER_WIRE_PACKET_H

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "master/base/child_process/shared_memory.h"

namespace stride::isolation {

static_assert(std::endian::native == std::endian::little && sizeof(std::size_t) == 8,
              "numbers are sent as they are in memory");

/// Puts one thing after another.
class PacketWriter {
 public:
  explicit PacketWriter(ResizableMemory& memory) : memory_(memory) {}

  std::size_t size() const { return size_; }
  std::span<const std::byte> bytes() const { return {memory_.data(), size_}; }
  void clear() { size_ = 0; }

  void put_bytes(const void* bytes, std::size_t size) {
    if (size == 0) return;
    if (size > memory_.size() - size_) memory_.grow(size_ + size);
    std::memcpy(memory_.data() + size_, bytes, size);
    size_ += size;
  }
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    put_bytes(&value, sizeof value);
  }
  /// With its size.
  template <class T>
  void put_all(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(values.size());
    put_bytes(values.data(), values.size_bytes());
  }
  void put(std::string_view text) { put_all(std::span<const char>(text)); }
  void put(const std::string& text) { put(std::string_view(text)); }

 private:
  ResizableMemory& memory_;
  std::size_t size_ = 0;
};

/// Memory for packets of one process.
class PacketBuffer final : public ResizableMemory {
 public:
  void grow(std::size_t size) override {
    bytes_.resize(std::max(size, 2 * bytes_.size()));
    data_ = bytes_.data();
    size_ = bytes_.size();
  }
  /// To be called when a packet was used: a large one leaves no memory behind.
  void trim() {
    constexpr std::size_t kKept = std::size_t{1} << 22;
    if (size_ <= kKept) return;
    bytes_ = {};
    data_ = nullptr;
    size_ = 0;
  }

 private:
  std::vector<std::byte> bytes_;
};

/// What has arrived cannot be read. what() says why.
class BadPacket : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Takes one thing after another. All of it has to be taken before another packet is written.
/// Throws BadPacket where there is less than there should be.
class PacketReader {
 public:
  PacketReader() = default;
  explicit PacketReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  const std::byte* take_bytes(std::size_t size) {
    if (size > rest_.size()) throw BadPacket("something is missing at the end");
    const std::byte* const bytes = rest_.data();
    rest_ = rest_.subspan(size);
    return bytes;
  }
  void take_into(void* target, std::size_t size) {
    if (size > 0) std::memcpy(target, take_bytes(size), size);
  }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    if constexpr (std::is_same_v<T, bool>) {
      return take<std::uint8_t>() != 0;
    } else {
      std::array<std::byte, sizeof(T)> bytes;
      take_into(bytes.data(), bytes.size());
      return std::bit_cast<T>(bytes);
    }
  }
  /// What put_all() has put.
  template <class T>
  std::vector<T> take_all() {
    std::vector<T> values(take_count(sizeof(T)));
    take_into(values.data(), values.size() * sizeof(T));
    return values;
  }
  std::string take_text() {
    const std::string_view text = take_text_view();
    return std::string(text);
  }
  /// The same, where the packet is.
  std::string_view take_text_view() {
    const std::size_t size = take_count(1);
    return {reinterpret_cast<const char*>(take_bytes(size)), size};
  }
  /// How many things follow, of at least `least` bytes each.
  std::size_t take_count(std::size_t least) {
    const auto count = take<std::size_t>();
    if (count > rest_.size() / least) throw BadPacket("there is less than was announced");
    return count;
  }
  std::size_t rest() const { return rest_.size(); }
  /// Everything was taken.
  void require_end() const {
    if (!rest_.empty()) throw BadPacket("there is more than there should be");
  }

 private:
  std::span<const std::byte> rest_;
};

}  // namespace stride::isolation

#endif
