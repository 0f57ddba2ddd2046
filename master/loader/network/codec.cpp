#include "master/loader/network/codec.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "master/loader/wire/untrusted_values.h"

namespace stride::remote {
namespace {

using isolation::byte_count;
using isolation::has_fixed_size;

std::size_t text_count(const core::ValueBlock& values) {
  return has_fixed_size(values.type()) ? 0 : values.size();
}

using TextsBuilder = capnp::List<capnp::Data>::Builder;
using TextsReader = capnp::List<capnp::Data>::Reader;

/// Returns the place behind them.
unsigned put_texts(TextsBuilder to, unsigned at, const core::ValueBlock& values) {
  core::visit(values, [&]<class T>(std::span<const T> elements) {
    if constexpr (!std::is_arithmetic_v<T>) {
      for (const T& element : elements) to.set(at++, to_data(element.data(), element.size()));
    }
  });
  return at;
}

unsigned take_texts(TextsReader from, unsigned at, core::ValueBlock& values) {
  core::visit(values, [&]<class T>(std::span<T> elements) {
    if constexpr (!std::is_arithmetic_v<T>) {
      for (T& element : elements) {
        const capnp::Data::Reader bytes = from[at++];
        element.assign(bytes.begin(), bytes.end());
      }
    }
  });
  return at;
}

/// What blocks have in them.
struct Extent {
  std::size_t bytes = 0;  ///< of elements with a fixed size
  std::size_t texts = 0;
};

/// `block(i)`: of `count` blocks.
template <class GetBlock>
Extent extent_of(std::size_t count, GetBlock&& block) {
  Extent extent;
  for (std::size_t i = 0; i < count; ++i) {
    extent.bytes += byte_count(block(i));
    extent.texts += text_count(block(i));
  }
  return extent;
}

template <class GetBlock>
void put_blocks(wire::Values::Builder to, std::size_t count, GetBlock&& block) {
  const auto [bytes, texts] = extent_of(count, block);
  if (bytes > kLongestMessage || texts > kLongestMessage) {
    throw BadMessage("the values of a call are too many for a message");
  }
  if (bytes > 0) {
    kj::byte* at = to.initNumbers(static_cast<unsigned>(bytes)).begin();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t size = byte_count(block(i));
      if (size == 0) continue;
      std::memcpy(at, block(i).bytes(), size);
      at += size;
    }
  }
  if (texts == 0) return;
  const TextsBuilder list = to.initTexts(static_cast<unsigned>(texts));
  unsigned at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (text_count(block(i)) > 0) at = put_texts(list, at, block(i));
  }
}

template <class GetBlock>
void take_blocks(wire::Values::Reader from, std::size_t count, GetBlock&& block) {
  const auto [bytes, texts] = extent_of(count, block);
  const capnp::Data::Reader numbers = from.getNumbers();
  const TextsReader list = from.getTexts();
  if (numbers.size() != bytes || list.size() != texts) {
    throw BadMessage(fmt::format("values of {} bytes and {} texts came in place of {} and {}",
                                 numbers.size(), list.size(), bytes, texts));
  }
  const kj::byte* at = numbers.begin();
  unsigned text = 0;
  for (std::size_t i = 0; i < count; ++i) {
    core::ValueBlock& to = block(i);
    if (!has_fixed_size(to.type())) {
      text = take_texts(list, text, to);
    } else if (const std::size_t size = byte_count(to); size > 0) {
      std::memcpy(to.bytes(), at, size);
      at += size;
      isolation::make_true_or_false(to);
    }
  }
}

}  // namespace

// ---- Values ----

void put_values(wire::Values::Builder to, std::span<const core::BoundValues> blocks) {
  put_blocks(to, blocks.size(),
             [&](std::size_t i) -> const core::ValueBlock& { return *blocks[i].block; });
}

void take_values(wire::Values::Reader from, std::span<const core::BoundValues> blocks) {
  take_blocks(from, blocks.size(),
              [&](std::size_t i) -> core::ValueBlock& { return *blocks[i].block; });
}

void put_values(wire::Values::Builder to, const core::ValueBlock& block) {
  put_blocks(to, 1, [&](std::size_t) -> const core::ValueBlock& { return block; });
}

void take_values(wire::Values::Reader from, core::ValueBlock& block) {
  take_blocks(from, 1, [&](std::size_t) -> core::ValueBlock& { return block; });
}

void put_references(ReferencesBuilder to, std::span<const core::ValueReference> references) {
  for (unsigned i = 0; i < to.size(); ++i) to.set(i, references[i]);
}

References take_references(ReferencesReader from) {
  References references(from.size());
  for (unsigned i = 0; i < from.size(); ++i) references[i] = from[i];
  return references;
}

void put_block(wire::Block::Builder to, std::span<const core::ValueReference> references,
               const core::ValueBlock& values) {
  to.setType(static_cast<std::uint8_t>(values.type()));
  to.setSize(values.size());
  put_references(to.initReferences(static_cast<unsigned>(references.size())), references);
}

isolation::StepShape::Group take_block(wire::Block::Reader from,
                                       const core::UnitDescription& description) {
  if (from.getType() >= core::kValueTypeCount) throw BadMessage("there is no such type");
  isolation::StepShape::Group group{static_cast<core::ValueType>(from.getType()), from.getSize(),
                                    take_references(from.getReferences())};
  std::size_t size = 0;
  for (const core::ValueReference reference : group.references) {
    const auto found = description.find(reference);
    if (!found || description.variables[*found].type != group.type) {
      throw BadMessage(fmt::format("the unit has no {} with the reference {}",
                                   core::name(group.type), reference));
    }
    size += description.variables[*found].size;
    if (size > core::kMaxElements) throw BadMessage("the values of a call are too many");
  }
  if (size != group.size) {
    throw BadMessage(
        fmt::format("{} elements are named of variables that have {}", group.size, size));
  }
  return group;
}

std::size_t element_count(std::span<const core::ValueReference> references,
                          const core::UnitDescription& description) {
  std::size_t size = 0;
  for (const core::ValueReference reference : references) {
    const auto found = description.find(reference);
    if (!found) throw BadMessage(fmt::format("the unit has no variable {}", reference));
    size += description.variables[*found].size;
    if (size > core::kMaxElements) throw BadMessage("the values of a call are too many");
  }
  return size;
}

std::vector<double> take_doubles(capnp::Data::Reader from) {
  if (from.size() % sizeof(double) != 0) throw BadMessage("a number is cut off");
  std::vector<double> numbers(from.size() / sizeof(double));
  take_doubles(from, numbers);
  return numbers;
}

void take_doubles(capnp::Data::Reader from, std::span<double> to) {
  if (from.size() != to.size_bytes()) throw BadMessage("numbers are missing, or too many");
  if (!to.empty()) std::memcpy(to.data(), from.begin(), from.size());
}

// ---- Times, and results ----

void put_time(wire::OptionalTime::Builder to, std::optional<Time> time) {
  to.setIsThere(time.has_value());
  if (time) to.setTime(to_wire(*time));
}

std::optional<Time> take_time(wire::OptionalTime::Reader from) {
  return from.getIsThere() ? std::optional(to_time(from.getTime())) : std::nullopt;
}

void put_interval(wire::Step::Builder to, const core::StepInterval& interval) {
  to.setFrom(to_wire(interval.from));
  to.setTo(to_wire(interval.to));
  to.setBeginSeconds(interval.begin_seconds);
  to.setEndSeconds(interval.end_seconds);
  to.setSizeSeconds(interval.size_seconds);
  to.setMayGoBackBefore(interval.may_go_back_before);
}

core::StepInterval take_interval(wire::Step::Reader from) {
  core::StepInterval interval(to_time(from.getFrom()), from.getBeginSeconds(),
                              to_time(from.getTo()), from.getEndSeconds(), from.getSizeSeconds());
  interval.size_seconds = from.getSizeSeconds();
  interval.may_go_back_before = from.getMayGoBackBefore();
  return interval;
}

void put_result(wire::StepResult::Builder to, const core::StepResult& result) {
  to.setIsRejected(result.rejected);
  to.setIsEarlyReturn(result.early_return);
  to.setEventHandlingNeeded(result.event_handling_needed);
  to.setTerminateSimulation(result.terminate_simulation);
  to.setReached(to_wire(result.reached));
}

core::StepResult take_result(wire::StepResult::Reader from, const core::StepInterval& interval) {
  const core::StepResult result{.rejected = from.getIsRejected(),
                                .early_return = from.getIsEarlyReturn(),
                                .event_handling_needed = from.getEventHandlingNeeded(),
                                .terminate_simulation = from.getTerminateSimulation(),
                                .reached = to_time(from.getReached())};
  if (!isolation::is_possible(result, interval)) {
    throw BadMessage("a step has ended outside of itself");
  }
  return result;
}

void put_events(wire::EventResult::Builder to, const core::EventResult& result) {
  to.setDiscreteStatesNeedUpdate(result.discrete_states_need_update);
  to.setTerminateSimulation(result.terminate_simulation);
  put_time(to.initNextEventTime(), result.next_event_time);
}

core::EventResult take_events(wire::EventResult::Reader from) {
  core::EventResult result;
  result.discrete_states_need_update = from.getDiscreteStatesNeedUpdate();
  result.terminate_simulation = from.getTerminateSimulation();
  result.next_event_time = take_time(from.getNextEventTime());
  if (!isolation::is_possible(result)) throw BadMessage("there is no such time of an event");
  return result;
}

void put_clock(wire::Result::Clock::Builder to, const core::ClockInterval& clock) {
  to.setState(static_cast<std::uint8_t>(clock.state));
  const core::Interval::Parts parts = clock.interval.parts();
  to.setNumeratorHigh(parts.numerator_high);
  to.setNumeratorLow(parts.numerator_low);
  to.setDenominator(parts.denominator);
}

core::ClockInterval take_clock(wire::Result::Clock::Reader from) {
  if (from.getState() > static_cast<std::uint8_t>(core::ClockInterval::State::Changed)) {
    throw BadMessage("there is no such state of a clock");
  }
  if (from.getDenominator() == 0) throw BadMessage("the interval of a clock is none");
  return {static_cast<core::ClockInterval::State>(from.getState()),
          core::Interval::from_parts(
              {from.getNumeratorHigh(), from.getNumeratorLow(), from.getDenominator()})};
}

// ---- Instances ----

namespace {

struct SentCapability {
  core::CapabilityId id;
  wire::Capability sent;
  const char* name;
};

constexpr SentCapability kSent[] = {
    {core::CapabilityId::ConfigurationMode, wire::Capability::CONFIGURATION_MODE,
     "the configuration mode"},
    {core::CapabilityId::StateSaving, wire::Capability::STATE_SAVING, "the saving of its state"},
    {core::CapabilityId::StateSerialization, wire::Capability::STATE_SERIALIZATION,
     "the serialization of its state"},
    {core::CapabilityId::Resetting, wire::Capability::RESETTING, "the reset"},
    {core::CapabilityId::IdlePromises, wire::Capability::IDLE_PROMISES, "idle promises"},
    {core::CapabilityId::DirectionalDerivatives, wire::Capability::DIRECTIONAL_DERIVATIVES,
     "directional derivatives"},
    {core::CapabilityId::ClockIntervals, wire::Capability::CLOCK_INTERVALS,
     "the intervals of clocks"},
    {core::CapabilityId::InputsWithinStep, wire::Capability::INPUTS_WITHIN_STEP,
     "inputs within steps"},
    {core::CapabilityId::MessageText, wire::Capability::MESSAGE_TEXT, "texts of messages"},
    {core::CapabilityId::UnitDiagnostics, wire::Capability::UNIT_DIAGNOSTICS, "diagnostics"}};

void put_lines(capnp::List<capnp::Text>::Builder to, const std::vector<std::string>& lines) {
  for (unsigned i = 0; i < to.size(); ++i) to.set(i, lines[i]);
}

std::vector<std::string> take_lines(capnp::List<capnp::Text>::Reader from) {
  std::vector<std::string> lines;
  for (const capnp::Text::Reader line : from) lines.push_back(to_string(line));
  return lines;
}

}  // namespace

void put_capabilities(wire::Instance::Builder to, const isolation::CapabilitySet& capabilities) {
  std::vector<wire::Capability> found;
  for (const SentCapability& known : kSent) {
    if (capabilities.test(static_cast<std::size_t>(known.id))) found.push_back(known.sent);
  }
  auto list = to.initCapabilities(static_cast<unsigned>(found.size()));
  for (unsigned i = 0; i < list.size(); ++i) list.set(i, found[i]);
}

/// Those that are not known here are not used.
isolation::CapabilitySet take_capabilities(wire::Instance::Reader from,
                                           const isolation::CapabilitySet& declared) {
  isolation::CapabilitySet capabilities;
  for (const wire::Capability capability : from.getCapabilities()) {
    const auto known = std::ranges::find(kSent, capability, &SentCapability::sent);
    if (known != std::end(kSent)) capabilities.set(static_cast<std::size_t>(known->id));
  }
  for (const SentCapability& known : kSent) {
    const auto id = static_cast<std::size_t>(known.id);
    if (!declared.test(id) || capabilities.test(id)) continue;
    throw BadMessage(
        fmt::format("the unit there lacks what its description promises: {}", known.name));
  }
  return capabilities;
}

void put_protections(wire::Instance::Builder to, const core::HostStatistics& host) {
  put_lines(to.initProtections(static_cast<unsigned>(host.protections.size())), host.protections);
  put_lines(to.initMissingProtections(static_cast<unsigned>(host.missing_protections.size())),
            host.missing_protections);
}

void take_protections(wire::Instance::Reader from, core::HostStatistics& host) {
  host.protections = take_lines(from.getProtections());
  host.missing_protections = take_lines(from.getMissingProtections());
}

void put_statistics(wire::Statistics::Builder to, const core::HostStatistics& host) {
  to.setSnapshots(host.snapshots);
  to.setRestores(host.restores);
  to.setMostSnapshots(host.most_snapshots);
  to.setMostSnapshotMemory(host.most_snapshot_memory);
  to.setMostMemory(host.most_memory);
}

void take_statistics(wire::Statistics::Reader from, core::HostStatistics& host) {
  host.snapshots = from.getSnapshots();
  host.restores = from.getRestores();
  host.most_snapshots = from.getMostSnapshots();
  host.most_snapshot_memory = from.getMostSnapshotMemory();
  host.most_memory = from.getMostMemory();
}

// ---- Errors ----

void put_error(wire::Error::Builder to, const std::exception& error, const core::Context& context) {
  const auto* const own = dynamic_cast<const core::Error*>(&error);
  if (own == nullptr) {
    return put_error(to, core::Error(core::Error::Kind::Run, context, error.what()), context);
  }
  to.setIsOfInput(own->kind() == core::Error::Kind::Input);
  to.setIsConsequent(dynamic_cast<const core::ConsequentError*>(own) != nullptr);
  to.setIsOfEnvironment(dynamic_cast<const core::EnvironmentError*>(own) != nullptr);
  to.setFile(own->context().where.file);
  to.setLine(own->context().where.line);
  to.setUnit(own->context().unit);
  to.setVariable(own->context().variable);
  put_time(to.initTime(), own->context().time);
  to.setMessage(own->message());
  to.setHint(own->hint());
}

void throw_error(wire::Error::Reader from, const core::Context& here, const std::string& machine) {
  const auto kind = from.getIsOfInput() ? core::Error::Kind::Input : core::Error::Kind::Run;
  core::Location there{to_string(from.getFile()), from.getLine()};
  if (there.file == here.where.file && there.line == here.where.line) there = {};
  core::Context context{.where = here.where,
                        .unit = here.unit.empty() ? to_string(from.getUnit()) : here.unit,
                        .variable = to_string(from.getVariable()),
                        .time = take_time(from.getTime())};
  const std::string message = fmt::format("{}: {}{}", machine, core::to_text({.where = there}),
                                          to_string(from.getMessage()));
  const std::string hint = to_string(from.getHint());
  if (from.getIsConsequent()) {
    throw core::ConsequentError(kind, std::move(context), message, hint);
  }
  if (from.getIsOfEnvironment()) throw core::EnvironmentError(std::move(context), message, hint);
  throw core::Error(kind, std::move(context), message, hint);
}

}  // namespace stride::remote
