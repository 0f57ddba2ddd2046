// Arguments of calls: how those of each type go to the unit, and what comes back in them.
#ifndef STRIDE_MASTER_LOADER_WIRE_ARGUMENTS_H
#define STRIDE_MASTER_LOADER_WIRE_ARGUMENTS_H

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/loader/wire/codec.h"

namespace stride::isolation {

/// What arguments refer to where the unit is.
struct ArgumentPlace {
  const core::UnitDescription* description = nullptr;
  core::InputUpdate request_inputs{};  ///< asks the master for the inputs of an instant

  const core::Variable& variable(core::ValueReference reference) const {
    const auto found = description->find(reference);
    if (!found) throw BadPacket("the unit has no such variable");
    return description->variables[*found];
  }
};

/// Nothing comes back in it.
struct OneWay {
  static constexpr bool kIsFilled = false;
  static void put_back(PacketWriter&, const auto&) {}
  static void take_back(PacketReader&, const auto&) {}
};

/// A parameter of the type P. put() and take_back() are for the master; take() makes an argument
/// where the unit is, and put_back() sends what the call has left in it.
template <class P>
struct Argument : OneWay {
  static void put(PacketWriter& to, const P& value) { Form<P>::put(to, value); }
  static P take(PacketReader& from, const ArgumentPlace&) { return Form<P>::take(from); }
};

template <class T>
struct Argument<std::span<const T>> : OneWay {
  static void put(PacketWriter& to, std::span<const T> values) { to.put_all(values); }
  static std::vector<T> take(PacketReader& from, const ArgumentPlace&) {
    return from.take_all<T>();
  }
};

template <>
struct Argument<const core::Binary&> : OneWay {
  static void put(PacketWriter& to, const core::Binary& value) { to.put_all(std::span(value)); }
  static core::Binary take(PacketReader& from, const ArgumentPlace&) {
    return from.take_all<core::Binary::value_type>();
  }
};

/// A variable of the unit's description.
template <>
struct Argument<const core::Variable&> : OneWay {
  static void put(PacketWriter& to, const core::Variable& value) { to.put(value.reference); }
  static std::reference_wrapper<const core::Variable> take(PacketReader& from,
                                                           const ArgumentPlace& place) {
    return place.variable(from.take<core::ValueReference>());
  }
};

/// Only whether there is a function: it stays with the master.
template <>
struct Argument<core::InputUpdate> : OneWay {
  static void put(PacketWriter& to, const core::InputUpdate& update) {
    to.put(static_cast<bool>(update));
  }
  static core::InputUpdate take(PacketReader& from, const ArgumentPlace& place) {
    return from.take<bool>() ? place.request_inputs : core::InputUpdate();
  }
};

template <>
struct Argument<const core::ValueBlock&> : OneWay {
  static void put(PacketWriter& to, const core::ValueBlock& values) {
    put_shape(to, values);
    put_values(to, values);
  }
  static core::ValueBlock take(PacketReader& from, const ArgumentPlace&) {
    const Shape shape = take_shape(from);
    return take_block(from, shape);
  }
};

// ---- Results in arguments ----

/// A block that a call fills: its memory is taken when the call is made, since sizes are checked
/// before.
struct FilledBlock {
  Shape shape;
  std::optional<core::ValueBlock> block{};

  operator core::ValueBlock&() { return block.emplace(shape.type, shape.size); }  // NOLINT
};

/// Numbers likewise.
struct FilledNumbers {
  std::size_t size;
  std::vector<double> numbers{};

  operator std::span<double>() { return numbers.resize(size), numbers; }  // NOLINT
};

template <>
struct Argument<core::ValueBlock&> {
  static constexpr bool kIsFilled = true;
  static void put(PacketWriter& to, const core::ValueBlock& values) { put_shape(to, values); }
  static FilledBlock take(PacketReader& from, const ArgumentPlace&) { return {take_shape(from)}; }
  static void put_back(PacketWriter& to, const FilledBlock& filled) {
    put_values(to, *filled.block);
  }
  static void take_back(PacketReader& from, core::ValueBlock& values) { take_values(from, values); }
};

template <>
struct Argument<std::span<double>> {
  static constexpr bool kIsFilled = true;
  static void put(PacketWriter& to, std::span<double> numbers) { to.put(numbers.size()); }
  static FilledNumbers take(PacketReader& from, const ArgumentPlace&) {
    return {from.take<std::size_t>()};
  }
  static void put_back(PacketWriter& to, const FilledNumbers& filled) {
    to.put_bytes(filled.numbers.data(), filled.numbers.size() * sizeof(double));
  }
  static void take_back(PacketReader& from, std::span<double> numbers) {
    from.take_into(numbers.data(), numbers.size_bytes());
  }
};

}  // namespace stride::isolation

#endif
