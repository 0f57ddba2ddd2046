// What the process of a unit writes into the memory that the master reads; and what a master of
// another machine asks of a unit.
#include <memory>

#include "master/loader/process/log_message.h"
#include "master/loader/wire/codec.h"
#include "master/loader/wire/dispatcher.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/master/loader/wire/any_unit.h"

namespace stride::tests {
namespace {

using namespace isolation;
using core::ValueType;

void take_and_raise(PacketReader& from) {
  const SentError error = take_error(from);
  try {
    error.raise();
  } catch (const core::Error&) {
  }
}

template <ValueType type>
void take_three(PacketReader& from) {
  core::ValueBlock block(type, 3);
  take_values(from, block);
}

/// The parts of replies, as loader/wire/unit_proxy.cpp takes them.
constexpr void (*kParts[])(PacketReader&) = {
    [](PacketReader& from) {
      take_step(from, core::StepInterval(Time{}, Time(std::chrono::seconds(1))));
    },
    [](PacketReader& from) { Form<core::EventResult>::take(from); },
    [](PacketReader& from) { Form<std::optional<Time>>::take(from); },
    take_and_raise,
    [](PacketReader& from) { Form<CapabilitySet>::take(from); },
    [](PacketReader& from) { Form<Protections>::take(from); },
    [](PacketReader& from) { from.take_text(); },
    [](PacketReader& from) { from.take_all<std::uint8_t>(); },
    [](PacketReader& from) { Form<core::ClockInterval>::take(from); },
    take_three<ValueType::Float64>,
    take_three<ValueType::Boolean>,
    take_three<ValueType::String>,
    take_three<ValueType::Binary>,
    [](PacketReader& from) { Form<core::HostStatistics>::take(from); },
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
  part(1), Form<core::EventResult>::put(out, {true, false, Time(Duration(7))});
  part(3), put_error(
               out, core::Error(core::Error::Kind::Input, {{"x.ssd", 12}, "u", "v"}, "m", "h"), {});
  part(5), Form<Protections>::put(out, {{"one", "two"}, {"three"}});
  part(6), out.put(std::string("a text"));
  core::ValueBlock words(ValueType::String, 3);
  words.strings()[1] = "word";
  part(11), put_values(out, words);
  part(9), put_values(out, core::ValueBlock(ValueType::Float64, 3));
  return {reinterpret_cast<const char*>(memory.data()), out.size()};
}

/// Requests, each as its number, its size and its packet.
void read_requests(const std::string& bytes) {
  PacketReader reader(std::as_bytes(std::span(bytes.data(), bytes.size())));
  const core::UnitDescription description = any_description();
  AnyUnit unit;
  Dispatcher dispatcher([](double) {});
  dispatcher.begin(unit, description, nullptr, true);
  PacketBuffer memory;
  refusing<BadPacket>("", [&] {
    while (reader.rest() > 0) {
      const auto request = static_cast<RequestCode>(reader.take<std::uint8_t>());
      const std::size_t size = reader.take<std::uint8_t>();
      PacketReader in(std::span(reader.take_bytes(size), size));
      PacketWriter out(memory);
      dispatcher.serve(request, in, out);
      ensure(out.size() < 100 * bytes.size() + 1000, "little does not make much");
    }
  });
}

std::string requests_bytes() {
  std::string bytes;
  const auto put = [&](RequestCode request, auto&& put_packet) {
    PacketBuffer memory;
    PacketWriter out(memory);
    put_packet(out);
    bytes += static_cast<char>(request);
    bytes += static_cast<char>(out.size());
    bytes.append(reinterpret_cast<const char*>(out.bytes().data()), out.size());
  };
  const core::ValueReference in[] = {0}, out[] = {1};
  core::ValueBlock pair(ValueType::Float64, 2), number(ValueType::Float64, 1);
  const core::BoundValues inputs[] = {{in, pair}}, outputs[] = {{out, number}};
  const auto put_block = [&](PacketWriter& to) {
    to.put_all(std::span<const core::ValueReference>(in));
    put_shape(to, pair);
  };
  put(code_of<&core::Unit::get>(), put_block);
  put(code_of<&core::Unit::set>(), [&](PacketWriter& to) {
    put_block(to);
    put_values(to, pair);
  });
  put(RequestCode::MakePlan, [&](PacketWriter& to) {
    to.put(std::uint32_t{3});
    put_shape(to, core::StepValues{inputs, outputs});
  });
  put(RequestCode::Step, [&](PacketWriter& to) {
    to.put(StepRequest(3, {Time(), Time(Duration(5))}, true, false));
    put_values(to, pair);
  });
  put(code_of<&core::ClockIntervals::clock_shift>(), [](PacketWriter& to) { to.put(3); });
  return bytes;
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
         .alphabet = std::string("\0\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c\x0d\xff", 15)},
        {.name = "requests",
         .read = read_requests,
         .make_seed = requests_bytes,
         .alphabet = std::string("\0\x01\x02\x03\x05\x08\x0a\x10\x18\xff", 10)},
        {.name = "log",
         .read = read_log,
         .make_seed = log_bytes,
         .alphabet = std::string("\0\x01\xff", 3),
         .may_refuse = false},
    });

}  // namespace
}  // namespace stride::tests
