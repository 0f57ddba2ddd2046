#include "master/observe/checkpoint/byte_log.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace stride;
using checkpoint::ByteLog;

namespace {

using Bytes = std::vector<std::byte>;

Bytes read(const ByteLog& log, ByteLog::Position from) {
  ByteLog::Reader reader(log, from);
  Bytes bytes;
  while (!reader.is_at_end()) {
    const std::byte next = reader.peek();
    const std::size_t size = std::min<std::size_t>(1 + bytes.size() % 999, log.end() - from);
    bytes.resize(bytes.size() + size);
    reader.take(&bytes[bytes.size() - size], size);
    from += size;
    REQUIRE(bytes[bytes.size() - size] == next);
  }
  return bytes;
}

void append(ByteLog& log, Bytes& model, const Bytes& bytes) {
  log.settle();
  log.tail().insert(log.tail().end(), bytes.begin(), bytes.end());
  model.insert(model.end(), bytes.begin(), bytes.end());
}

}  // namespace

TEST_CASE("a log has what was appended and not cut off, however long it is") {
  std::mt19937 random(1);
  ByteLog log;
  Bytes model;
  ByteLog::Position begin = 0;
  for (int i = 0; i < 300; ++i) {
    append(log, model, Bytes(random() % 9000, std::byte(random() % 4)));
    if (random() % 4 == 0) {
      const ByteLog::Position end = log.end() - random() % (log.end() - begin + 1) / (1 + i % 7);
      log.cut(end);
      model.resize(end);
    }
    if (random() % 40 == 0) {
      begin += (log.end() - begin) / 2;
      log.drop_before(begin);
    }
    REQUIRE(log.begin() == begin);
    REQUIRE(log.end() == model.size());
  }
  CHECK(read(log, begin) == Bytes(model.begin() + static_cast<std::ptrdiff_t>(begin), model.end()));
  CHECK(log.memory() < model.size() / 2 + (std::size_t{1} << 19));

  const ByteLog::Position from = begin + (log.end() - begin) / 3;
  core::StateArchive written;
  log.persist(written, from);
  core::StateArchive state(written.bytes());
  ByteLog other;
  other.persist(state, 0);
  state.end();
  const Bytes rest(model.begin() + static_cast<std::ptrdiff_t>(from), model.end());
  CHECK(read(other, other.begin()) == rest);
  other.cut(other.end() - 10);
  CHECK(read(other, other.begin()) == Bytes(rest.begin(), rest.end() - 10));
}

TEST_CASE("damaged chunks are refused, and none is longer than it may be") {
  ByteLog log;
  Bytes model;
  for (int i = 0; i < 100; ++i) append(log, model, Bytes(5000, std::byte(i)));
  core::StateArchive written;
  log.persist(written, 0);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    Bytes bytes = written.bytes();
    bytes[random() % bytes.size()] ^= std::byte(1U << random() % 8);
    try {
      core::StateArchive state(bytes);
      ByteLog other;
      other.persist(state, 0);
      state.end();
      const Bytes got = read(other, other.begin());  // from another position, at most
      CHECK(std::equal(got.rbegin(), got.rend(), model.rbegin()));
    } catch (const core::BadState&) {
      SUCCEED();
    }
  }
}
