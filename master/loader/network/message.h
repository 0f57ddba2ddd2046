// What a master and `stride serve` send to each other once they have greeted each other
// (greeting.h): a head of fixed size and a packet of the wire, in frames (frame.h).
//
// The packets of calls and of their answers are those that the master and a unit's process have in
// common (wire/calls.h). The others, in the order in which they are put:
//
// - Instantiate: struct Instantiation. Answer: the capabilities and the protections of the host.
// - Describe: the path or name of the FMU as a text; empty for the only one that is offered.
// Answer:
//   the path there, then the number of files that describe it, then the name and text of each.
// - SendFile: a FilePiece of an FMU, in place of one that is there.
// - GetFiles: nothing. Answer: a reply File with a FilePiece for each piece of what the unit has
//   written, then what was left out, in words.
#ifndef STRIDE_MASTER_LOADER_NETWORK_MESSAGE_H
#define STRIDE_MASTER_LOADER_NETWORK_MESSAGE_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "master/loader/network/frame.h"
#include "master/loader/wire/calls.h"
#include "master/loader/wire/packet.h"

namespace stride::remote {

using isolation::BadPacket;
using isolation::PacketReader;
using isolation::PacketWriter;
using isolation::ReplyCode;
using isolation::RequestCode;

// Requests beyond those for a unit.
inline constexpr RequestCode kPing{1000};
inline constexpr RequestCode kDescribe{1001};
inline constexpr RequestCode kSendFile{1002};
inline constexpr RequestCode kGetFiles{1003};

// Replies beyond those of a unit.
inline constexpr ReplyCode kLog{1000};   ///< of the unit: its status, category and text
inline constexpr ReplyCode kBeat{1001};  ///< this machine is still there
inline constexpr ReplyCode kFile{1002};

/// The head of a request. The server carries requests out in their order. A failure of one that is
/// not awaited is the answer to the next one that is; those between them are not carried out.
struct RequestHead {
  RequestCode request;
  std::uint32_t is_awaited;
};

/// The head of a reply.
struct ReplyHead {
  ReplyCode code = ReplyCode::Done;
  std::uint32_t unused = 0;
  std::uint64_t calls = 0;        ///< of functions of the unit, so far
  std::uint64_t nanoseconds = 0;  ///< that the request has taken there
};

/// Puts a message in frames after what is there. Throws BadPacket for one that is too long.
template <class Head>
void append_message(std::string& bytes, const Head& head, std::span<const std::byte> packet) {
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(&head, 1)), packet};
  append_frames(bytes, parts);
}

/// A message that has arrived. Throws BadPacket for one that is too short.
template <class Head>
struct Message {
  explicit Message(std::span<const std::byte> bytes) : packet(bytes), head(packet.take<Head>()) {}

  PacketReader packet;
  Head head;
};

/// Of a file that comes piece by piece.
struct FilePiece {
  std::string_view name;   ///< relative to its folder, with '/'
  std::string_view bytes;  ///< after those of the piece before
  bool is_first;

  void put(PacketWriter& to) const {
    to.put(name);
    to.put(bytes);
    to.put(is_first);
  }
  /// Refers to the packet.
  static FilePiece take(PacketReader& from) {
    const std::string_view name = from.take_text_view();
    const std::string_view bytes = from.take_text_view();
    return {name, bytes, from.take<bool>()};
  }
};

}  // namespace stride::remote

#endif
