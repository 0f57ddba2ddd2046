// Messages on a stream of bytes. A message is cut into frames, so that a long one does not keep a
// sign of life waiting, and so that what does not come from the peer is noticed.
//
// A frame is a header of 8 bytes and 1 to kLongestFrame bytes of a message.
// Header: 4 bytes that are always the same, then the size [byte], little-endian, whose topmost bit
// says that the message goes on in the next frame.
#ifndef STRIDE_MASTER_LOADER_NETWORK_FRAME_H
#define STRIDE_MASTER_LOADER_NETWORK_FRAME_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/loader/wire/packet.h"

namespace stride::remote {

inline constexpr std::size_t kLongestFrame = std::size_t{1} << 20;
/// Of a message [byte]: above the 256 MiB that a value may have.
inline constexpr std::size_t kLongestMessage = std::size_t{384} << 20;

/// Puts a message in frames after what is there. Throws BadPacket for one that is too long.
void append_frames(std::string& bytes, std::span<const std::span<const std::byte>> parts);

/// Takes frames as they arrive, in pieces of any size. Needs memory for what has arrived only.
class FrameReader {
 public:
  /// Where the next bytes may be put: always some.
  std::span<char> room();
  void filled(std::size_t size) { end_ += size; }
  /// The same for bytes that are there already.
  void put(std::string_view bytes);

  /// The next message that is complete; nothing if there is none yet. Its bytes stay until the next
  /// call. Throws isolation::BadPacket.
  std::optional<std::span<const std::byte>> next();

 private:
  std::string_view unread() const { return {buffer_.data() + begin_, end_ - begin_}; }
  bool take_header();
  void take_content();

  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is unread
  std::vector<std::byte> message_;
  std::size_t taken_ = 0;  ///< of the message [byte]
  std::size_t rest_ = 0;   ///< of the frame
  bool goes_on_ = false;
  bool is_complete_ = false;
};

}  // namespace stride::remote

#endif
