// core's types in messages. What has arrived is checked: a value that does not exist, or is not of
// the size that it should have, throws BadMessage or kj::Exception (with_checked_messages()).
#ifndef STRIDE_MASTER_LOADER_NETWORK_CODEC_H
#define STRIDE_MASTER_LOADER_NETWORK_CODEC_H

#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/child_process/sandbox.h"
#include "master/base/error.h"
#include "master/engine/model/values.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/unit.h"
#include "master/loader/network/message.h"
#include "master/loader/wire/codec.h"
#include "master/loader/wire/step_plan.h"

namespace stride::remote {

/// The elements of blocks, one behind the other.
void put_values(wire::Values::Builder to, std::span<const core::BoundValues> blocks);
void take_values(wire::Values::Reader from, std::span<const core::BoundValues> blocks);
void put_values(wire::Values::Builder to, const core::ValueBlock& block);
void take_values(wire::Values::Reader from, core::ValueBlock& block);

using References = std::vector<core::ValueReference>;
using ReferencesBuilder = capnp::List<std::uint32_t>::Builder;
using ReferencesReader = capnp::List<std::uint32_t>::Reader;

void put_references(ReferencesBuilder to, std::span<const core::ValueReference> references);
References take_references(ReferencesReader from);

/// Variables of one type with the size of the block that holds their values.
void put_block(wire::Block::Builder to, std::span<const core::ValueReference> references,
               const core::ValueBlock& values);
/// Only with a type and a size that those variables have in the description.
isolation::StepShape::Group take_block(wire::Block::Reader from,
                                       const core::UnitDescription& description);
/// So many elements have the Float64 variables.
std::size_t element_count(std::span<const core::ValueReference> references,
                          const core::UnitDescription& description);

std::vector<double> take_doubles(capnp::Data::Reader from);
/// As many as there is room for.
void take_doubles(capnp::Data::Reader from, std::span<double> to);
inline kj::ArrayPtr<const kj::byte> to_data(std::span<const double> numbers) {
  return to_data(numbers.data(), numbers.size_bytes());
}

inline std::int64_t to_wire(Time time) { return time.time_since_epoch().count(); }
inline Time to_time(std::int64_t picoseconds) { return Time(Duration(picoseconds)); }
void put_time(wire::OptionalTime::Builder to, std::optional<Time> time);
std::optional<Time> take_time(wire::OptionalTime::Reader from);

void put_interval(wire::Step::Builder to, const core::StepInterval& interval);
core::StepInterval take_interval(wire::Step::Reader from);

/// All but the outputs.
void put_result(wire::StepResult::Builder to, const core::StepResult& result);
/// Of a step of this interval.
core::StepResult take_result(wire::StepResult::Reader from, const core::StepInterval& interval);

void put_events(wire::EventResult::Builder to, const core::EventResult& result);
core::EventResult take_events(wire::EventResult::Reader from);

void put_clock(wire::Result::Clock::Builder to, const core::ClockInterval& clock);
core::ClockInterval take_clock(wire::Result::Clock::Reader from);

void put_capabilities(wire::Instance::Builder to, const isolation::CapabilitySet& capabilities);
/// Not without those that are declared.
isolation::CapabilitySet take_capabilities(wire::Instance::Reader from,
                                           const isolation::CapabilitySet& declared);
void put_protections(wire::Instance::Builder to, const core::HostStatistics& host);
void take_protections(wire::Instance::Reader from, core::HostStatistics& host);

void put_statistics(wire::Statistics::Builder to, const core::HostStatistics& host);
/// All but the protections.
void take_statistics(wire::Statistics::Reader from, core::HostStatistics& host);

/// With all its parts; what is no core::Error becomes one of this unit.
void put_error(wire::Error::Builder to, const std::exception& error, const core::Context& context);
/// Throws it, as the error of what was asked of a machine: with the place and the component that
/// are known here, and with the machine's name before the message, which then also has the place
/// that it has there.
[[noreturn]] void throw_error(wire::Error::Reader from, const core::Context& here,
                              const std::string& machine);

}  // namespace stride::remote

#endif
