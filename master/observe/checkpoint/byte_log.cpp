#include "master/observe/checkpoint/byte_log.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include <zlib.h>

namespace stride::checkpoint {

// ---- Growing and shrinking ----

std::size_t ByteLog::memory() const {
  std::size_t bytes = tail_.capacity();
  for (const Chunk& chunk : chunks_) bytes += chunk.deflated.size();
  return bytes;
}

/// A cut mostly takes back the last few steps: what is before them is deflated, and they are not.
void ByteLog::deflate_tail() {
  std::size_t done = 0;
  for (; tail_.size() - done >= 2 * kChunk; done += kChunk) {
    chunks_.push_back(deflated(tail_begin_ + done, std::span(tail_).subspan(done, kChunk)));
  }
  tail_.erase(tail_.begin(), tail_.begin() + static_cast<std::ptrdiff_t>(done));
  tail_begin_ += done;
}

void ByteLog::cut(Position end) {
  while (end < tail_begin_) {
    const Chunk last = std::move(chunks_.back());
    chunks_.pop_back();
    inflate(last, tail_);
    tail_begin_ = last.first;
  }
  tail_.resize(end - tail_begin_);
}

void ByteLog::drop_before(Position begin) {
  begin_ = begin;
  while (!chunks_.empty() && chunks_.front().first + chunks_.front().size <= begin) {
    chunks_.pop_front();
  }
}

// ---- zlib ----

/// At level 1, since the others take several times as long for a few percent.
ByteLog::Chunk ByteLog::deflated(Position first, std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  Chunk chunk{first, static_cast<std::uint32_t>(bytes.size()), std::vector<std::uint8_t>(size)};
  const auto* const from = reinterpret_cast<const Bytef*>(bytes.data());
  if (compress2(chunk.deflated.data(), &size, from, bytes.size(), Z_BEST_SPEED) != Z_OK) {
    throw std::bad_alloc();  // its only reason here
  }
  chunk.deflated.resize(size);
  chunk.deflated.shrink_to_fit();
  return chunk;
}

void ByteLog::inflate(const Chunk& chunk, std::vector<std::byte>& bytes) {
  bytes.resize(chunk.size);
  uLongf size = chunk.size;
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                chunk.deflated.data(), chunk.deflated.size());
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (status != Z_OK || size != chunk.size) {
    throw core::BadState("a chunk of the journal cannot be inflated");
  }
}

// ---- Its state ----

void ByteLog::persist(core::StateArchive& state, Position from) {
  state.mark("log");
  if (state.is_reading()) return read(state);
  write(state, from);
}

void ByteLog::persist(core::StateArchive& state, Chunk& chunk) {
  state.value(chunk.size);
  if (chunk.size > kChunk) state.fail("a chunk is longer than any");
  state.values(chunk.deflated);
}

void ByteLog::write(core::StateArchive& state, Position from) {
  const auto first = std::ranges::find_if(
      chunks_, [&](const Chunk& chunk) { return from < chunk.first + chunk.size; });
  const Position begin = first != chunks_.end() ? first->first : tail_begin_;
  std::uint64_t skipped = from - begin;
  state.value(skipped);
  std::uint64_t count =
      static_cast<std::uint64_t>(chunks_.end() - first) + (tail_.size() + kChunk - 1) / kChunk;
  state.value(count);
  std::for_each(first, chunks_.end(), [&](Chunk& chunk) { persist(state, chunk); });
  for (std::size_t done = 0; done < tail_.size(); done += kChunk) {
    const std::size_t size = std::min(kChunk, tail_.size() - done);
    Chunk last = deflated(tail_begin_ + done, std::span(tail_).subspan(done, size));
    persist(state, last);
  }
}

void ByteLog::read(core::StateArchive& state) {
  *this = ByteLog();
  state.value(begin_);
  std::uint64_t count = 0;
  state.value(count);
  for (; count > 0; --count) {
    Chunk chunk{tail_begin_, 0, {}};
    persist(state, chunk);
    tail_begin_ += chunk.size;
    chunks_.push_back(std::move(chunk));
  }
  if (begin_ > tail_begin_) state.fail("the journal begins behind its end");
}

// ---- Reading ----

ByteLog::Reader::Reader(const ByteLog& log, Position from) : log_(log) {
  const auto is_before = [&](const Chunk& chunk) { return chunk.first + chunk.size <= from; };
  const auto first = std::ranges::find_if_not(log.chunks_, is_before);
  next_chunk_ = static_cast<std::size_t>(first - log.chunks_.begin());
  const Position begin = first != log.chunks_.end() ? first->first : log.tail_begin_;
  if (from > begin && has_more()) rest_ = rest_.subspan(from - begin);
}

bool ByteLog::Reader::next() {
  while (rest_.empty() && next_chunk_ < log_.chunks_.size()) {
    inflate(log_.chunks_[next_chunk_++], inflated_);
    rest_ = inflated_;
  }
  if (rest_.empty() && next_chunk_ == log_.chunks_.size()) {
    ++next_chunk_;
    rest_ = log_.tail_;
  }
  return !rest_.empty();
}

bool ByteLog::Reader::is_at_end() { return !has_more(); }

std::byte ByteLog::Reader::peek() {
  if (!has_more()) fail_short();
  return rest_.front();
}

void ByteLog::Reader::take(void* into, std::size_t size) {
  auto* to = static_cast<std::byte*>(into);
  while (size > 0) {
    if (!has_more()) fail_short();
    const std::size_t count = std::min(size, rest_.size());
    std::memcpy(to, rest_.data(), count);
    rest_ = rest_.subspan(count);
    to += count;
    size -= count;
  }
}

void ByteLog::Reader::fail_short() { throw core::BadState("the journal ends too early"); }

}  // namespace stride::checkpoint
