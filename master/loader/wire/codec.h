// core's types in packets. What has arrived is checked in the copy that is taken, since who has
// written it may write on: a value that does not exist throws BadPacket.
#ifndef STRIDE_MASTER_LOADER_WIRE_CODEC_H
#define STRIDE_MASTER_LOADER_WIRE_CODEC_H

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "master/base/child_process/sandbox.h"
#include "master/base/error.h"
#include "master/engine/model/values.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/unit.h"
#include "master/loader/wire/packet.h"

namespace stride::isolation {

/// The elements only: the other side knows type and size.
void put_values(PacketWriter& to, const core::ValueBlock& values);
void take_values(PacketReader& from, core::ValueBlock& values);

/// The type and size of a block.
struct Shape {
  core::ValueType type;
  std::size_t size;
};
void put_shape(PacketWriter& to, const core::ValueBlock& values);
Shape take_shape(PacketReader& from);
/// A block of this shape, whose elements follow. Needs memory for what has arrived only.
core::ValueBlock take_block(PacketReader& from, const Shape& shape);

void put_step(PacketWriter& to, const core::StepResult& result);
/// Of a step of this interval.
core::StepResult take_step(PacketReader& from, const core::StepInterval& interval);

/// With all its parts; what is no core::Error becomes one of this unit. `hint` is for an error that
/// has none.
void put_error(PacketWriter& to, const std::exception& error, const core::Context& context,
               const std::string& hint = "");

/// An error that has arrived, and may be supplemented before it is thrown.
struct SentError {
  std::uint8_t nature = 0;  ///< its kind and its class
  core::Context context{};
  std::string message{}, hint{};

  [[noreturn]] void raise() const;
};
SentError take_error(PacketReader& from);

/// Those of a unit.
using CapabilitySet = std::bitset<core::kCapabilities>;

/// How a value of the type T is put into a packet and taken from it; unless there is another form
/// below: as it is in memory.
template <class T>
struct Form {
  static void put(PacketWriter& to, const T& value) { to.put(value); }
  static T take(PacketReader& from) { return from.take<T>(); }
};

template <>
struct Form<std::optional<Time>> {
  static void put(PacketWriter& to, const std::optional<Time>& time);
  static std::optional<Time> take(PacketReader& from);
};
template <>
struct Form<core::EventResult> {
  static void put(PacketWriter& to, const core::EventResult& result);
  static core::EventResult take(PacketReader& from);
};
template <>
struct Form<core::Interval> {
  static void put(PacketWriter& to, const core::Interval& interval);
  static core::Interval take(PacketReader& from);
};
template <>
struct Form<core::ClockInterval> {
  static void put(PacketWriter& to, const core::ClockInterval& clock);
  static core::ClockInterval take(PacketReader& from);
};
/// All but the link.
template <>
struct Form<core::HostStatistics> {
  static void put(PacketWriter& to, const core::HostStatistics& host);
  static core::HostStatistics take(PacketReader& from);
};
template <>
struct Form<Protections> {
  static void put(PacketWriter& to, const Protections& protections);
  static Protections take(PacketReader& from);
};
template <>
struct Form<CapabilitySet> {
  static void put(PacketWriter& to, const CapabilitySet& capabilities);
  static CapabilitySet take(PacketReader& from);
};
template <class T>
struct Form<std::vector<T>> {
  static void put(PacketWriter& to, const std::vector<T>& values) { to.put_all(std::span(values)); }
  static std::vector<T> take(PacketReader& from) { return from.take_all<T>(); }
};
template <>
struct Form<std::string> {
  static void put(PacketWriter& to, const std::string& text) { to.put(text); }
  static std::string take(PacketReader& from) { return from.take_text(); }
};

}  // namespace stride::isolation

#endif
