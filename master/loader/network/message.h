// Messages of remote.capnp, written and read.
#ifndef STRIDE_MASTER_LOADER_NETWORK_MESSAGE_H
#define STRIDE_MASTER_LOADER_NETWORK_MESSAGE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <capnp/message.h>
#include <capnp/serialize.h>
#include <remote.capnp.h>

#include "master/loader/network/frame.h"

namespace stride::remote {

/// Memory for small messages, used again and again; one message at a time.
class Scratch {
 public:
  kj::ArrayPtr<capnp::word> words() { return kj::arrayPtr(words_.data(), words_.size()); }

 private:
  std::array<capnp::word, 512> words_{};
};

/// A message with this root, which fill(Builder) fills, in frames behind what is in `bytes`.
template <class Root, class Fill>
void append_message(std::string& bytes, Scratch& scratch, Fill&& fill);
void append_message(std::string& bytes, capnp::MessageBuilder& message);

/// A message that has arrived; its bytes must outlive it. What it has in it is looked at when it is
/// read: a value that cannot be is a kj::Exception, see with_checked_messages().
class IncomingMessage {
 public:
  explicit IncomingMessage(std::span<const std::uint64_t> words);

  template <class Root>
  typename Root::Reader root() {
    return reader_.getRoot<Root>();
  }

 private:
  capnp::FlatArrayMessageReader reader_;
};

/// Carries out what reads messages. Throws BadMessage for one that is malformed.
template <class Action>
decltype(auto) with_checked_messages(Action&& action) {
  try {
    return action();
  } catch (const kj::Exception& mistake) {
    throw BadMessage(std::string("a message is malformed: ") + mistake.getDescription().cStr());
  }
}

template <class Root, class Fill>
void append_message(std::string& bytes, Scratch& scratch, Fill&& fill) {
  capnp::MallocMessageBuilder message(scratch.words());
  fill(message.initRoot<Root>());
  append_message(bytes, message);
}

inline std::string to_string(capnp::Text::Reader text) { return {text.begin(), text.size()}; }

inline kj::ArrayPtr<const kj::byte> to_data(const void* bytes, std::size_t size) {
  return kj::arrayPtr(static_cast<const kj::byte*>(bytes), size);
}

}  // namespace stride::remote

#endif
