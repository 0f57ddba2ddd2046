// Bytes of a journal, in little memory.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_BYTE_LOG_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_BYTE_LOG_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "master/base/state_archive.h"

namespace stride::checkpoint {

/// Bytes that are appended at the end, and cut off there. All but the last ones are deflated, in
/// chunks, so that a reader inflates one of them at a time.
class ByteLog {
 public:
  /// Counted from the first byte that was ever appended.
  using Position = std::uint64_t;
  class Reader;

  Position begin() const { return begin_; }
  Position end() const { return tail_begin_ + tail_.size(); }
  /// What keeps the bytes [byte].
  std::size_t memory() const;

  /// Where bytes are to be appended; settle() is to be called before or after.
  std::vector<std::byte>& tail() { return tail_; }
  void settle() {
    if (tail_.size() >= 2 * kChunk) [[unlikely]]
      deflate_tail();
  }

  /// Drops what is behind. The position is not before begin().
  void cut(Position end);
  /// Forgets what is before; cut() must not go back there.
  void drop_before(Position begin);

  /// Writes what follows `from`; reads it to begin at 0. Throws core::BadState.
  void persist(core::StateArchive& state, Position from);

 private:
  static constexpr std::size_t kChunk = std::size_t{64} << 10;

  struct Chunk {
    Position first = 0;
    std::uint32_t size = 0;
    std::vector<std::uint8_t> deflated;
  };

  void deflate_tail();
  static Chunk deflated(Position first, std::span<const std::byte> bytes);
  static void inflate(const Chunk& chunk, std::vector<std::byte>& bytes);
  static void persist(core::StateArchive& state, Chunk& chunk);
  void write(core::StateArchive& state, Position from);
  void read(core::StateArchive& state);

  std::deque<Chunk> chunks_;
  Position begin_ = 0;
  Position tail_begin_ = 0;
  std::vector<std::byte> tail_;
};

/// Reads a log from a position on, while nothing is appended. Throws core::BadState where there is
/// less than was wanted, or a chunk is damaged.
class ByteLog::Reader {
 public:
  Reader(const ByteLog& log, Position from);

  bool is_at_end();
  std::byte peek();
  void take(void* into, std::size_t size);

 private:
  bool has_more() { return !rest_.empty() || next(); }
  bool next();
  [[noreturn]] static void fail_short();

  const ByteLog& log_;
  std::size_t next_chunk_ = 0;
  std::vector<std::byte> inflated_;
  std::span<const std::byte> rest_;
};

}  // namespace stride::checkpoint

#endif
