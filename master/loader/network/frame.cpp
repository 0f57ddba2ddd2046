#include "master/loader/network/frame.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "master/base/text/readable_text.h"

namespace stride::remote {
namespace {

constexpr std::uint32_t kMark = 0x31525453;  // "STR1"
constexpr std::uint32_t kGoesOn = std::uint32_t{1} << 31;
constexpr std::size_t kHeader = 8;
constexpr std::size_t kRoom = std::size_t{1} << 16;
/// A message of this size leaves no memory behind.
constexpr std::size_t kLarge = std::size_t{1} << 22;

void append_header(std::string& bytes, std::size_t size, bool goes_on) {
  const std::uint32_t header[2] = {kMark,
                                   static_cast<std::uint32_t>(size) | (goes_on ? kGoesOn : 0)};
  bytes.append(reinterpret_cast<const char*>(header), kHeader);
}

}  // namespace

void append_frames(std::string& bytes, std::span<const std::span<const std::byte>> parts) {
  std::size_t rest = 0;
  for (const auto& part : parts) rest += part.size();
  if (rest > kLongestMessage) {
    throw isolation::BadPacket(fmt::format("a message of {} MiB is too long; {} MiB are possible",
                                           rest >> 20, kLongestMessage >> 20));
  }
  std::size_t room = 0;  // in the present frame
  for (auto part : parts) {
    while (!part.empty()) {
      if (room == 0) {
        room = std::min(rest, kLongestFrame);
        rest -= room;
        append_header(bytes, room, rest > 0);
      }
      const std::size_t size = std::min(room, part.size());
      bytes.append(reinterpret_cast<const char*>(part.data()), size);
      part = part.subspan(size);
      room -= size;
    }
  }
}

std::span<char> FrameReader::room() {
  if (begin_ == end_) begin_ = end_ = 0;
  if (buffer_.size() - end_ < kRoom / 2) {
    std::ranges::copy(unread(), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
    if (buffer_.size() - end_ < kRoom / 2) buffer_.resize(end_ + kRoom);
  }
  return {buffer_.data() + end_, buffer_.size() - end_};
}

void FrameReader::put(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::span<char> room = this->room();
    const std::size_t size = std::min(room.size(), bytes.size());
    std::memcpy(room.data(), bytes.data(), size);
    filled(size);
    bytes.remove_prefix(size);
  }
}

std::optional<std::span<const std::byte>> FrameReader::next() {
  if (is_complete_) {
    if (taken_ > kLarge) message_ = {};
    is_complete_ = false;
    taken_ = 0;
  }
  for (;;) {
    if (rest_ == 0 && !take_header()) return std::nullopt;
    take_content();
    if (rest_ > 0) return std::nullopt;
    if (goes_on_) continue;
    is_complete_ = true;
    return std::span<const std::byte>(message_.data(), taken_);
  }
}

bool FrameReader::take_header() {
  const std::string_view bytes = unread();
  std::uint32_t header[2] = {kMark, 0};
  std::copy_n(bytes.data(), std::min(bytes.size(), sizeof header[0]),
              reinterpret_cast<char*>(header));
  if (bytes.size() >= sizeof header[0] && header[0] != kMark) {
    throw isolation::BadPacket(
        fmt::format("what came is no message: '{}'",
                    core::readable_text(bytes.substr(0, bytes.find('\n')), 200)));
  }
  if (bytes.size() < kHeader) return false;
  std::memcpy(header, bytes.data(), kHeader);
  rest_ = header[1] & ~kGoesOn;
  goes_on_ = (header[1] & kGoesOn) != 0;
  if (rest_ == 0 || rest_ > kLongestFrame) {
    throw isolation::BadPacket(fmt::format("a part of a message has {} bytes", rest_));
  }
  if (taken_ + rest_ > kLongestMessage) {
    throw isolation::BadPacket(
        fmt::format("a message has more than {} MiB", kLongestMessage >> 20));
  }
  begin_ += kHeader;
  return true;
}

void FrameReader::take_content() {
  const std::size_t size = std::min(rest_, end_ - begin_);
  if (message_.size() < taken_ + size) message_.resize(taken_ + size);
  if (size > 0) std::memcpy(message_.data() + taken_, buffer_.data() + begin_, size);
  taken_ += size;
  begin_ += size;
  rest_ -= size;
}

}  // namespace stride::remote
