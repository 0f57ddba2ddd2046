// What the two ends of a link to another machine read.
#include <csignal>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "master/loader/network/greeting.h"
#include "master/loader/network/instantiation.h"
#include "master/loader/network/message.h"
#include "master/loader/network/place.h"
#include "master/loader/network/remote_spec.h"
#include "master/loader/network/server/serve.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"

namespace stride::tests {
namespace {

using namespace remote;

template <class Head, class Put>
std::string message_bytes(const Head& head, Put&& put) {
  isolation::PacketBuffer memory;
  PacketWriter packet(memory);
  put(packet);
  std::string bytes;
  append_message(bytes, head, packet.bytes());
  return bytes;
}

// ---- The server ----

/// A whole session of a server that has no units. What it does with one: parser `requests`.
void serve_bytes(const std::string& bytes) {
  const core::Descriptor in(::memfd_create("in", MFD_CLOEXEC));
  const core::Descriptor out(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  const std::string all = greeting_line(Side::Master, own_greeting()) + bytes;
  ensure(::write(in.number(), all.data(), all.size()) == static_cast<ssize_t>(all.size()),
         "the bytes are in the file");
  ::lseek(in.number(), 0, SEEK_SET);
  ServeOptions options;
  options.find = [](const std::string&) -> std::filesystem::path {
    core::fail_input({}, "there is no unit");
  };
  static const volatile std::sig_atomic_t kNotInterrupted = 0;
  refusing<core::Error>("", [&] { serve(in.number(), out.number(), options, kNotInterrupted); });
}

std::string request_bytes() {
  return message_bytes(RequestHead{kDescribe, 1},
                       [](PacketWriter& to) { to.put(std::string("sensor.fmu")); }) +
         message_bytes(RequestHead{RequestCode::Instantiate, 1}, [](PacketWriter& to) {
           Instantiation wanted;
           wanted.name = "sensor";
           wanted.parameters = {1};
           wanted.elements = {4};
           wanted.put(to);
         });
}

// ---- The master ----

/// As remote_unit.cpp and remote_spec.cpp take them.
void take_reply(Message<ReplyHead> reply) {
  if (reply.head.code == ReplyCode::Failed) {
    isolation::SentError error = isolation::take_error(reply.packet);
    supplement(error, {.where = {"x.ssd", 3}, .unit = "sensor"}, "box");
    try {
      error.raise();
    } catch (const core::Error&) {
    }
  } else if (reply.head.code == kFile) {
    FilePiece::take(reply.packet);
  } else if (reply.head.code == ReplyCode::Done) {
    isolation::Form<isolation::CapabilitySet>::take(reply.packet);
    isolation::Form<core::HostStatistics>::take(reply.packet);
  }
}

void read_replies(const std::string& bytes) {
  refusing<BadPacket>("", [&] {
    FrameReader reader;
    reader.put(bytes);
    while (const auto message = reader.next()) take_reply(Message<ReplyHead>(*message));
  });
}

std::string reply_bytes() {
  return message_bytes(ReplyHead{.code = kFile},
                       [](PacketWriter& to) {
                         FilePiece{"trace.vcd", "#5", true}.put(to);
                       }) +
         message_bytes(ReplyHead{.code = ReplyCode::Failed},
                       [](PacketWriter& to) {
                         isolation::put_error(
                             to,
                             core::Error(core::Error::Kind::Input,
                                         {.where = {"x.ssd", 12}, .unit = "u"}, "m", "h"),
                             {});
                       }) +
         message_bytes(ReplyHead{.calls = 3}, [](PacketWriter& to) {
           isolation::Form<isolation::CapabilitySet>::put(to, {5});
           isolation::Form<core::HostStatistics>::put(to, {.restores = 1, .protections = {"all"}});
         });
}

// ---- Greetings and places ----

void read_greeting(const std::string& bytes) {
  refusing<BadGreeting>("", [&] {
    GreetingScanner scanner(Side::Server);
    for (const char byte : bytes) {
      if (scanner.take({&byte, 1})) return;
    }
  });
}

void read_place(const std::string& text) {
  refusing<std::invalid_argument>("", [&] {
    const Place place = parse_place(text);
    const bool is_ssh = place.command.front() == "ssh";
    ensure(!is_ssh || !place.command.at(place.command.size() - 2).starts_with("-"),
           "the machine is no option of ssh");
  });
}

const Registration kRemoteParsers(
    "remote",
    {
        {.name = "remote_requests", .read = serve_bytes, .make_seed = request_bytes},
        {.name = "remote_replies", .read = read_replies, .make_seed = reply_bytes},
        {.name = "greeting",
         .read = read_greeting,
         .make_seed = [] { return "Welcome\n" + greeting_line(Side::Server, own_greeting()); },
         .alphabet = "\x01STRIDE-V protocl,bu019.\n"},
        {.name = "place",
         .read = read_place,
         .make_seed = [] { return std::string("ssh://me@box:2222"); },
         .alphabet = "sh:/@[]-%.e12 x"},
    });

}  // namespace
}  // namespace stride::tests
