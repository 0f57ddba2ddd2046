// What the process of a unit writes into the memory that the master reads.
#include <memory>

#include "master/loader/process/log_message.h"
#include "master/loader/wire/codec.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"

namespace stride::tests {
namespace {

using namespace isolation;
using core::ValueType;

void take_error(PacketReader& from) {
  try {
    throw_error(from);
  } catch (const core::Error&) {
  }
}

template <ValueType type>
void take_block(PacketReader& from) {
  core::ValueBlock block(type, 3);
  take_values(from, block);
}

/// The parts of replies, as loader/process/unit_proxy.cpp takes them.
constexpr void (*kParts[])(PacketReader&) = {
    [](PacketReader& from) {
      take_step(from, core::StepInterval(Time{}, Time(std::chrono::seconds(1))));
    },
    [](PacketReader& from) { take_events(from); },
    [](PacketReader& from) { take_time(from); },
    take_error,
    [](PacketReader& from) { take_capabilities(from); },
    [](PacketReader& from) { take_protections(from); },
    [](PacketReader& from) { from.take_text(); },
    [](PacketReader& from) { from.take_all<std::uint8_t>(); },
    [](PacketReader& from) { from.take<core::Interval>(); },
    take_block<ValueType::Float64>,
    take_block<ValueType::Boolean>,
    take_block<ValueType::String>,
    take_block<ValueType::Binary>,
};

/// Each part is behind a byte that names it.
void read_packet(const std::string& bytes) {
  PacketReader reader(std::as_bytes(std::span(bytes.data(), bytes.size())));
  refusing<BadPacket>("", [&] {
    for (;;) {
      std::uint8_t part = 0xff;
      try {
        part = reader.take<std::uint8_t>();
      } catch (const BadPacket&) {
        return;  // that was all
      }
      kParts[part % std::size(kParts)](reader);
    }
  });
}

std::string packet_bytes() {
  GrowingMemory memory{"test", 16};
  PacketWriter out(memory);
  const auto part = [&](std::uint8_t number) { out.put(number); };
  part(0), put_step(out, {.early_return = true, .reached = Time(Duration(5))});
  part(1), put_events(out, {true, false, Time(Duration(7))});
  part(3), put_error(
               out, core::Error(core::Error::Kind::Input, {{"x.ssd", 12}, "u", "v"}, "m", "h"), {});
  part(5), put_protections(out, {{"one", "two"}, {"three"}});
  part(6), out.put(std::string("a text"));
  core::ValueBlock words(ValueType::String, 3);
  words.strings()[1] = "word";
  part(11), put_values(out, words);
  part(9), put_values(out, core::ValueBlock(ValueType::Float64, 3));
  return {reinterpret_cast<const char*>(memory.data()), out.size()};
}

/// The ring's bytes, cut into two writes.
void read_log(const std::string& bytes) {
  const auto link = std::make_unique<HostLinkMemory>();
  LogReader reader(*link);
  std::size_t size = 0;
  const auto count = [&](const LogMessage& message) {
    size += message.category.size() + message.text.size();
  };
  for (const auto& part : {bytes.substr(0, bytes.size() / 2), bytes.substr(bytes.size() / 2)}) {
    link->logged.write(part);
    reader.read(count);
  }
  ensure(size <= bytes.size(), "messages consist of what was written");
}

std::string log_bytes() {
  const auto link = std::make_unique<HostLinkMemory>();
  LogWriter writer(*link);
  writer.write({importer::Status::Warning, "category", "what there is to say"});
  writer.write({importer::Status::Ok, "", "more"});
  std::string bytes;
  link->logged.read(bytes);
  return bytes;
}

const Registration kIsolationParsers(
    "isolation",
    {
        {.name = "packet",
         .read = read_packet,
         .make_seed = packet_bytes,
         .alphabet = std::string("\0\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c\xff", 14)},
        {.name = "log",
         .read = read_log,
         .make_seed = log_bytes,
         .alphabet = std::string("\0\x01\xff", 3),
         .may_refuse = false},
    });

}  // namespace
}  // namespace stride::tests
