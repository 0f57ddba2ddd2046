#include "master/loader/wire/codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace stride::isolation {
namespace {

/// Whether its elements have one size in memory.
constexpr bool has_fixed_size(core::ValueType type) {
  return type != core::ValueType::String && type != core::ValueType::Binary;
}

/// Of all elements, which have a fixed size.
std::size_t byte_count(const core::ValueBlock& values) {
  return values.size() * core::element_size(values.type());
}

/// A bool of another byte than 0 and 1 has no value in C++.
void normalize_booleans(core::ValueBlock& values) {
  if (values.type() != core::ValueType::Boolean && values.type() != core::ValueType::Clock) return;
  std::byte* const bytes = values.bytes();
  std::transform(bytes, bytes + byte_count(values), bytes,
                 [](std::byte byte) { return std::byte{byte != std::byte{0}}; });
}

}  // namespace

// ---- Values ----

void put_values(PacketWriter& to, const core::ValueBlock& values) {
  if (has_fixed_size(values.type())) return to.put_bytes(values.bytes(), byte_count(values));
  core::visit(values, [&]<class T>(std::span<const T> elements) {
    if constexpr (!std::is_arithmetic_v<T>) {
      for (const T& element : elements) {
        to.put(element.size());
        to.put_bytes(element.data(), element.size());
      }
    }
  });
}

void take_values(PacketReader& from, core::ValueBlock& values) {
  if (has_fixed_size(values.type())) {
    from.take_into(values.bytes(), byte_count(values));
    return normalize_booleans(values);
  }
  core::visit(values, [&]<class T>(std::span<T> elements) {
    if constexpr (!std::is_arithmetic_v<T>) {
      using Element = typename T::value_type;
      for (T& element : elements) {
        const std::size_t size = from.take_count(1);
        const auto* const bytes = reinterpret_cast<const Element*>(from.take_bytes(size));
        element.assign(bytes, bytes + size);
      }
    }
  });
}

void put_shape(PacketWriter& to, const core::ValueBlock& values) {
  to.put(static_cast<std::uint8_t>(values.type()));
  to.put(values.size());
}

Shape take_shape(PacketReader& from) {
  const auto type = from.take<std::uint8_t>();
  if (type >= core::kValueTypeCount) throw BadPacket("there is no such type");
  return {static_cast<core::ValueType>(type), from.take<std::size_t>()};
}

core::ValueBlock take_block(PacketReader& from, const Shape& shape) {
  const std::size_t least =
      has_fixed_size(shape.type) ? core::element_size(shape.type) : sizeof(std::size_t);
  if (shape.size > from.rest() / least) throw BadPacket("there are fewer values than announced");
  core::ValueBlock values(shape.type, shape.size);
  take_values(from, values);
  return values;
}

// ---- Results ----

void Form<std::optional<Time>>::put(PacketWriter& to, const std::optional<Time>& time) {
  to.put(time.has_value());
  to.put(time.value_or(Time{}));
}

std::optional<Time> Form<std::optional<Time>>::take(PacketReader& from) {
  const bool is_there = from.take<bool>();
  const Time time = from.take<Time>();
  return is_there ? std::optional(time) : std::nullopt;
}

namespace {

enum Flag : std::uint8_t { kRejected = 1, kEarlyReturn = 2, kEventNeeded = 4, kTerminate = 8 };

/// In one piece, without gaps.
struct SentStepResult {
  Time reached;
  std::uint8_t flags;
  std::array<std::uint8_t, 15> unused{};
};
static_assert(sizeof(SentStepResult) == 32);

}  // namespace

void put_step(PacketWriter& to, const core::StepResult& result) {
  const int flags = (result.rejected ? kRejected : 0) | (result.early_return ? kEarlyReturn : 0) |
                    (result.event_handling_needed ? kEventNeeded : 0) |
                    (result.terminate_simulation ? kTerminate : 0);
  to.put(SentStepResult{result.reached, static_cast<std::uint8_t>(flags)});
}

core::StepResult take_step(PacketReader& from, const core::StepInterval& interval) {
  const auto [reached, flags, unused] = from.take<SentStepResult>();
  const core::StepResult result{.rejected = (flags & kRejected) != 0,
                                .early_return = (flags & kEarlyReturn) != 0,
                                .event_handling_needed = (flags & kEventNeeded) != 0,
                                .terminate_simulation = (flags & kTerminate) != 0,
                                .reached = reached};
  if (!result.rejected && (result.reached < interval.from || result.reached > interval.to)) {
    throw BadPacket("a step has ended outside of itself");
  }
  return result;
}

void Form<core::EventResult>::put(PacketWriter& to, const core::EventResult& result) {
  to.put(result.discrete_states_need_update);
  to.put(result.terminate_simulation);
  Form<std::optional<Time>>::put(to, result.next_event_time);
}

/// No unit can give a later next event, and with these a sum does not overflow.
core::EventResult Form<core::EventResult>::take(PacketReader& from) {
  core::EventResult result;
  result.discrete_states_need_update = from.take<bool>();
  result.terminate_simulation = from.take<bool>();
  result.next_event_time = Form<std::optional<Time>>::take(from);
  if (std::abs(to_seconds(result.next_event_time.value_or(Time{}))) > kMaxSeconds + 1) {
    throw BadPacket("there is no such time of an event");
  }
  return result;
}

// ---- Clocks ----

void Form<core::Interval>::put(PacketWriter& to, const core::Interval& interval) {
  to.put(interval.parts());
}

core::Interval Form<core::Interval>::take(PacketReader& from) {
  const auto parts = from.take<core::Interval::Parts>();
  if (parts.denominator == 0) throw BadPacket("the interval of a clock is none");
  return core::Interval::from_parts(parts);
}

void Form<core::ClockInterval>::put(PacketWriter& to, const core::ClockInterval& clock) {
  to.put(static_cast<std::uint8_t>(clock.state));
  Form<core::Interval>::put(to, clock.interval);
}

core::ClockInterval Form<core::ClockInterval>::take(PacketReader& from) {
  const auto state = from.take<std::uint8_t>();
  if (state > static_cast<std::uint8_t>(core::ClockInterval::State::Changed)) {
    throw BadPacket("there is no such state of a clock");
  }
  return {static_cast<core::ClockInterval::State>(state), Form<core::Interval>::take(from)};
}

// ---- Errors ----

namespace {

enum Nature : std::uint8_t { kOfInput = 1, kConsequent = 2, kOfEnvironment = 4 };

}  // namespace

void put_error(PacketWriter& to, const std::exception& error, const core::Context& context,
               const std::string& hint) {
  const auto* const own = dynamic_cast<const core::Error*>(&error);
  if (own == nullptr) {
    return put_error(to, core::Error(core::Error::Kind::Run, context, error.what(), hint), context);
  }
  const bool is_consequent = dynamic_cast<const core::ConsequentError*>(own) != nullptr;
  const bool is_of_environment = dynamic_cast<const core::EnvironmentError*>(own) != nullptr;
  to.put(static_cast<std::uint8_t>((own->kind() == core::Error::Kind::Input ? kOfInput : 0) |
                                   (is_consequent ? kConsequent : 0) |
                                   (is_of_environment ? kOfEnvironment : 0)));
  to.put(own->context().where.file);
  to.put(std::int32_t{own->context().where.line});
  to.put(own->context().unit);
  to.put(own->context().variable);
  Form<std::optional<Time>>::put(to, own->context().time);
  to.put(own->message());
  to.put(own->hint().empty() ? hint : own->hint());
}

SentError take_error(PacketReader& from) {
  SentError error;
  error.nature = from.take<std::uint8_t>();
  if (error.nature > (kOfInput | kConsequent | kOfEnvironment)) {
    throw BadPacket("there is no such kind of error");
  }
  error.context.where.file = from.take_text();
  error.context.where.line = from.take<std::int32_t>();
  error.context.unit = from.take_text();
  error.context.variable = from.take_text();
  error.context.time = Form<std::optional<Time>>::take(from);
  error.message = from.take_text();
  error.hint = from.take_text();
  return error;
}

void SentError::raise() const {
  const auto kind = (nature & kOfInput) != 0 ? core::Error::Kind::Input : core::Error::Kind::Run;
  if ((nature & kConsequent) != 0) throw core::ConsequentError(kind, context, message, hint);
  if ((nature & kOfEnvironment) != 0) throw core::EnvironmentError(context, message, hint);
  throw core::Error(kind, context, message, hint);
}

// ---- Capabilities, and the host ----

void Form<CapabilitySet>::put(PacketWriter& to, const CapabilitySet& capabilities) {
  to.put(std::uint64_t{capabilities.to_ullong()});
}

CapabilitySet Form<CapabilitySet>::take(PacketReader& from) {
  return CapabilitySet(from.take<std::uint64_t>());
}

namespace {

void put_lines(PacketWriter& to, const std::vector<std::string>& lines) {
  to.put(lines.size());
  for (const std::string& line : lines) to.put(line);
}

std::vector<std::string> take_lines(PacketReader& from) {
  std::vector<std::string> lines(from.take_count(sizeof(std::size_t)));
  for (std::string& line : lines) line = from.take_text();
  return lines;
}

}  // namespace

void Form<Protections>::put(PacketWriter& to, const Protections& protections) {
  put_lines(to, protections.in_force);
  put_lines(to, protections.missing);
}

Protections Form<Protections>::take(PacketReader& from) {
  Protections protections;
  protections.in_force = take_lines(from);
  protections.missing = take_lines(from);
  return protections;
}

void Form<core::HostStatistics>::put(PacketWriter& to, const core::HostStatistics& host) {
  for (const std::uint64_t number : {host.snapshots, host.restores, host.most_snapshots,
                                     host.most_snapshot_memory, host.most_memory}) {
    to.put(number);
  }
  Form<Protections>::put(to, {host.protections, host.missing_protections});
}

core::HostStatistics Form<core::HostStatistics>::take(PacketReader& from) {
  core::HostStatistics host;
  for (std::uint64_t* const number : {&host.snapshots, &host.restores, &host.most_snapshots,
                                      &host.most_snapshot_memory, &host.most_memory}) {
    *number = from.take<std::uint64_t>();
  }
  Protections protections = Form<Protections>::take(from);
  host.protections = std::move(protections.in_force);
  host.missing_protections = std::move(protections.missing);
  return host;
}

}  // namespace stride::isolation
