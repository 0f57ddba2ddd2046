// core's types in messages.
#ifndef STRIDE_MASTER_ISOLATION_CODEC_H
#define STRIDE_MASTER_ISOLATION_CODEC_H

#include <bitset>
#include <optional>

#include "master/algorithm/unit.h"
#include "master/isolation/message.h"
#include "master/isolation/process/sandbox.h"
#include "master/model/values.h"
#include "master/util/error.h"

namespace stride::isolation {

/// The elements only: the other side knows type and size.
void put_values(MessageWriter& to, const core::ValueBlock& values);
void take_values(MessageReader& from, core::ValueBlock& values);

/// An empty block of the type and size of another.
void put_shape(MessageWriter& to, const core::ValueBlock& values);
core::ValueBlock take_shape(MessageReader& from);

void put_step(MessageWriter& to, const core::StepResult& result);
core::StepResult take_step(MessageReader& from);

void put_events(MessageWriter& to, const core::EventResult& result);
core::EventResult take_events(MessageReader& from);

void put_time(MessageWriter& to, std::optional<Time> time);
std::optional<Time> take_time(MessageReader& from);

/// With all its parts; what is no core::Error becomes one of this unit. `hint` is for an error that
/// has none.
void put_error(MessageWriter& to, const std::exception& error, const core::Context& context,
               const std::string& hint = "");
/// Throws it.
[[noreturn]] void throw_error(MessageReader& from);

/// Those of a unit.
using CapabilitySet = std::bitset<core::kCapabilities>;
void put_capabilities(MessageWriter& to, const CapabilitySet& capabilities);
CapabilitySet take_capabilities(MessageReader& from);

void put_protections(MessageWriter& to, const Protections& protections);
Protections take_protections(MessageReader& from);

}  // namespace stride::isolation

#endif
