#include "master/loader/wire/codec.h"

#include <string>
#include <type_traits>
#include <utility>

#include "master/loader/wire/untrusted_values.h"

namespace stride::isolation {

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
    return make_true_or_false(values);
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
  to.put(values.type());
  to.put(values.size());
}

core::ValueBlock take_shape(PacketReader& from) {
  const auto type = from.take<core::ValueType>();
  return {type, from.take<std::size_t>()};
}

// ---- Results ----

void put_time(PacketWriter& to, std::optional<Time> time) {
  to.put(time.has_value());
  to.put(time.value_or(Time{}).time_since_epoch().count());
}

std::optional<Time> take_time(PacketReader& from) {
  const bool is_there = from.take<bool>();
  const Time time{Duration(from.take<Duration::rep>())};
  return is_there ? std::optional(time) : std::nullopt;
}

namespace {

enum Flag : std::uint8_t { kRejected = 1, kEarlyReturn = 2, kEventNeeded = 4, kTerminate = 8 };

}  // namespace

void put_step(PacketWriter& to, const core::StepResult& result) {
  to.put(static_cast<std::uint8_t>((result.rejected ? kRejected : 0) |
                                   (result.early_return ? kEarlyReturn : 0) |
                                   (result.event_handling_needed ? kEventNeeded : 0) |
                                   (result.terminate_simulation ? kTerminate : 0)));
  to.put(result.reached.time_since_epoch().count());
}

core::StepResult take_step(PacketReader& from, const core::StepInterval& interval) {
  const auto flags = from.take<std::uint8_t>();
  const Time reached{Duration(from.take<Duration::rep>())};
  const core::StepResult result{.rejected = (flags & kRejected) != 0,
                                .early_return = (flags & kEarlyReturn) != 0,
                                .event_handling_needed = (flags & kEventNeeded) != 0,
                                .terminate_simulation = (flags & kTerminate) != 0,
                                .reached = reached};
  if (!is_possible(result, interval)) throw BadPacket();
  return result;
}

void put_events(PacketWriter& to, const core::EventResult& result) {
  to.put(result.discrete_states_need_update);
  to.put(result.terminate_simulation);
  put_time(to, result.next_event_time);
}

core::EventResult take_events(PacketReader& from) {
  core::EventResult result;
  result.discrete_states_need_update = from.take<bool>();
  result.terminate_simulation = from.take<bool>();
  result.next_event_time = take_time(from);
  if (!is_possible(result)) throw BadPacket();
  return result;
}

// ---- Clocks ----

void put_interval(PacketWriter& to, const core::Interval& interval) { to.put(interval); }

core::Interval take_interval(PacketReader& from) {
  const auto interval = from.take<core::Interval>();
  if (!interval.is_fraction()) throw BadPacket();
  return interval;
}

void put_clock(PacketWriter& to, const core::ClockInterval& clock) {
  to.put(clock.state);
  put_interval(to, clock.interval);
}

core::ClockInterval take_clock(PacketReader& from) {
  const auto state = from.take<core::ClockInterval::State>();
  if (state < core::ClockInterval::State::NotYetKnown ||
      state > core::ClockInterval::State::Changed) {
    throw BadPacket();
  }
  return {state, take_interval(from)};
}

// ---- Errors ----

void put_error(PacketWriter& to, const std::exception& error, const core::Context& context,
               const std::string& hint) {
  const auto* const own = dynamic_cast<const core::Error*>(&error);
  if (own == nullptr) {
    return put_error(to, core::Error(core::Error::Kind::Run, context, error.what(), hint), context);
  }
  to.put(own->kind());
  to.put(dynamic_cast<const core::ConsequentError*>(own) != nullptr);
  to.put(own->context().where.file);
  to.put(own->context().where.line);
  to.put(own->context().unit);
  to.put(own->context().variable);
  put_time(to, own->context().time);
  to.put(own->message());
  to.put(own->hint().empty() ? hint : own->hint());
}

void throw_error(PacketReader& from) {
  const auto kind = from.take<core::Error::Kind>();
  if (kind != core::Error::Kind::Input && kind != core::Error::Kind::Run) throw BadPacket();
  const bool is_consequent = from.take<bool>();
  core::Context context;
  context.where.file = from.take_text();
  context.where.line = from.take<int>();
  context.unit = from.take_text();
  context.variable = from.take_text();
  context.time = take_time(from);
  const std::string message = from.take_text();
  const std::string hint = from.take_text();
  if (is_consequent) throw core::ConsequentError(kind, std::move(context), message, hint);
  throw core::Error(kind, std::move(context), message, hint);
}

// ---- Protections ----

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

void put_capabilities(PacketWriter& to, const CapabilitySet& capabilities) {
  to.put(std::uint64_t{capabilities.to_ullong()});
}

CapabilitySet take_capabilities(PacketReader& from) {
  return CapabilitySet(from.take<std::uint64_t>());
}

void put_protections(PacketWriter& to, const Protections& protections) {
  put_lines(to, protections.in_force);
  put_lines(to, protections.missing);
}

Protections take_protections(PacketReader& from) {
  Protections protections;
  protections.in_force = take_lines(from);
  protections.missing = take_lines(from);
  return protections;
}

}  // namespace stride::isolation
