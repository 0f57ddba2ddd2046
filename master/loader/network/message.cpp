#include "master/loader/network/message.h"

#include <algorithm>
#include <vector>

namespace stride::remote {
namespace {

kj::ArrayPtr<const capnp::word> to_words(std::span<const std::uint64_t> words) {
  static_assert(sizeof(capnp::word) == sizeof(std::uint64_t));
  return kj::arrayPtr(reinterpret_cast<const capnp::word*>(words.data()), words.size());
}

/// Each part may be read some times over, but what points to the same part from many places may not
/// make much out of little.
capnp::ReaderOptions limits(std::size_t words) {
  capnp::ReaderOptions options;
  options.traversalLimitInWords = 4 * words + 1024;
  options.nestingLimit = 16;
  return options;
}

}  // namespace

IncomingMessage::IncomingMessage(std::span<const std::uint64_t> words)
    : reader_(to_words(words), limits(words.size())) {}

/// In the form of capnp::messageToFlatArray(), without a copy of its own.
void append_message(std::string& bytes, capnp::MessageBuilder& message) {
  const auto segments = message.getSegmentsForOutput();
  std::vector<std::uint32_t> table{static_cast<std::uint32_t>(segments.size() - 1)};
  for (const auto& segment : segments) table.push_back(static_cast<std::uint32_t>(segment.size()));
  if (table.size() % 2 != 0) table.push_back(0);
  std::vector<std::span<const std::byte>> parts{std::as_bytes(std::span(table))};
  for (const auto& segment : segments) {
    const auto part = segment.asBytes();
    parts.push_back(std::as_bytes(std::span(part.begin(), part.size())));
  }
  append_frames(bytes, parts);
}

}  // namespace stride::remote
