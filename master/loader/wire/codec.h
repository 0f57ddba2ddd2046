// core's types in packets. What a unit's process may write there is checked in the copy that is
// taken, since it may write on: a value that does not exist throws BadPacket.
#ifndef STRIDE_MASTER_LOADER_WIRE_CODEC_H
#define STRIDE_MASTER_LOADER_WIRE_CODEC_H

#include <bitset>
#include <optional>

#include "master/base/child_process/sandbox.h"
#include "master/base/error.h"
#include "master/engine/model/values.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/unit.h"
#include "master/loader/wire/packet.h"

namespace stride::isolation {

/// The elements only: the other side knows type and size.
void put_values(PacketWriter& to, const core::ValueBlock& values);
void take_values(PacketReader& from, core::ValueBlock& values);

/// An empty block of the type and size of another.
void put_shape(PacketWriter& to, const core::ValueBlock& values);
core::ValueBlock take_shape(PacketReader& from);

void put_step(PacketWriter& to, const core::StepResult& result);
/// Of a step of this interval.
core::StepResult take_step(PacketReader& from, const core::StepInterval& interval);

void put_events(PacketWriter& to, const core::EventResult& result);
core::EventResult take_events(PacketReader& from);

void put_time(PacketWriter& to, std::optional<Time> time);
std::optional<Time> take_time(PacketReader& from);

void put_interval(PacketWriter& to, const core::Interval& interval);
core::Interval take_interval(PacketReader& from);

void put_clock(PacketWriter& to, const core::ClockInterval& clock);
core::ClockInterval take_clock(PacketReader& from);

/// With all its parts; what is no core::Error becomes one of this unit. `hint` is for an error that
/// has none.
void put_error(PacketWriter& to, const std::exception& error, const core::Context& context,
               const std::string& hint = "");
/// Throws it.
[[noreturn]] void throw_error(PacketReader& from);

/// Those of a unit.
using CapabilitySet = std::bitset<core::kCapabilities>;
void put_capabilities(PacketWriter& to, const CapabilitySet& capabilities);
CapabilitySet take_capabilities(PacketReader& from);

void put_protections(PacketWriter& to, const Protections& protections);
Protections take_protections(PacketReader& from);

}  // namespace stride::isolation

#endif
