#include "master/loader/wire/codec.h"

#include <array>
#include <cstddef>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::isolation;
using core::ValueBlock;
using core::ValueType;

namespace {

/// Puts something and hands over a reader of it.
class There {
 public:
  template <class Put>
  explicit There(Put&& put) {
    PacketWriter out(memory_);
    put(out);
    size_ = out.size();
  }
  PacketReader read() const { return PacketReader({memory_.data(), size_}); }
  PacketReader read_all_but(std::size_t bytes) const {
    return PacketReader({memory_.data(), size_ - bytes});
  }

 private:
  isolation::GrowingMemory memory_{"test", 16};
  std::size_t size_ = 0;
};

}  // namespace

TEST_CASE("blocks of all types come over") {
  for (std::size_t i = 0; i < core::kValueTypeCount; ++i) {
    const auto type = static_cast<ValueType>(i);
    CAPTURE(core::name(type));
    ValueBlock values(type, 3);
    core::visit(values, [](auto elements) {
      using T = typename decltype(elements)::value_type;
      if constexpr (std::is_arithmetic_v<T>) {
        elements[0] = T(1);
        elements[2] = T(17);
      } else {
        elements[0] = T(3, 'a');
        elements[2] = T(1000, 'b');
      }
    });
    const There there([&](PacketWriter& to) {
      put_shape(to, values);
      put_values(to, values);
    });
    PacketReader from = there.read();
    ValueBlock copy = take_shape(from);
    CHECK(copy.type() == type);
    take_values(from, copy);
    CHECK(copy == values);
    PacketReader less = there.read_all_but(1);
    ValueBlock other = take_shape(less);
    CHECK_THROWS_AS(take_values(less, other), BadPacket);
  }
}

TEST_CASE("results of steps and events come over") {
  for (int flags = 0; flags < 16; ++flags) {
    const core::StepResult result{.rejected = (flags & 1) != 0,
                                  .early_return = (flags & 2) != 0,
                                  .event_handling_needed = (flags & 4) != 0,
                                  .terminate_simulation = (flags & 8) != 0,
                                  .reached = Time(Duration(flags - 5))};
    const There there([&](PacketWriter& to) { put_step(to, result); });
    PacketReader from = there.read();
    const core::StepResult copy = take_step(from, {Time(Duration(-9)), Time(Duration(19))});
    CHECK(copy.rejected == result.rejected);
    CHECK(copy.early_return == result.early_return);
    CHECK(copy.event_handling_needed == result.event_handling_needed);
    CHECK(copy.terminate_simulation == result.terminate_simulation);
    CHECK(copy.reached == result.reached);
  }
  for (const auto next : {std::optional<Time>(), std::optional(Time(Duration(12)))}) {
    const There there([&](PacketWriter& to) { put_events(to, {true, false, next}); });
    PacketReader from = there.read();
    const core::EventResult copy = take_events(from);
    CHECK(copy.discrete_states_need_update);
    CHECK_FALSE(copy.terminate_simulation);
    CHECK(copy.next_event_time == next);
  }
}

TEST_CASE("an error comes over with all its parts") {
  const core::Error error(core::Error::Kind::Input,
                          {{"system.ssd", 12}, "unit", "variable", Time(Duration(5))}, "message",
                          "hint");
  const There there([&](PacketWriter& to) { put_error(to, error, {}); });
  PacketReader from = there.read();
  try {
    throw_error(from);
  } catch (const core::Error& copy) {
    CHECK(std::string(copy.what()) == error.what());
    CHECK(copy.kind() == core::Error::Kind::Input);
    CHECK(copy.context().where.line == 12);
    CHECK(copy.context().variable == "variable");
    CHECK(copy.context().time == Time(Duration(5)));
    CHECK(dynamic_cast<const core::ConsequentError*>(&copy) == nullptr);
  }
}

TEST_CASE("what is not an error of core's becomes one of the unit, and consequent ones stay it") {
  const There plain([](PacketWriter& to) {
    put_error(to, std::runtime_error("no"), {.where = {"system.ssd", 3}, .unit = "u"});
  });
  PacketReader from = plain.read();
  CHECK_THROWS_WITH(throw_error(from), "system.ssd:3: unit 'u': no");
  const There consequent([](PacketWriter& to) {
    put_error(to, core::ConsequentError(core::Error::Kind::Run, {}, "later"), {});
  });
  from = consequent.read();
  CHECK_THROWS_AS(throw_error(from), core::ConsequentError);
}

TEST_CASE("values that do not exist are refused, whatever the other process has written") {
  const auto refused = [](auto&& put, auto&& take) {
    const There there(put);
    PacketReader from = there.read();
    CHECK_THROWS_AS(take(from), BadPacket);
  };
  const core::StepInterval interval{Time(Duration(5)), Time(Duration(9))};
  for (const int reached : {4, 10}) {
    refused([&](PacketWriter& to) { put_step(to, {.reached = Time(Duration(reached))}); },
            [&](PacketReader& from) { take_step(from, interval); });
  }
  for (const Time next : {Time::min(), Time::max()}) {
    refused([&](PacketWriter& to) { put_events(to, {.next_event_time = next}); }, take_events);
  }
  refused(
      [](PacketWriter& to) {
        put_clock(to, {static_cast<core::ClockInterval::State>(77), {}});
      },
      take_clock);
  refused(
      [](PacketWriter& to) {
        const std::array<std::byte, sizeof(core::Interval)> zeros{};
        to.put_bytes(zeros.data(), zeros.size());
      },
      take_interval);
  refused([](PacketWriter& to) { to.put(77); }, throw_error);
}

TEST_CASE("a truth value of any byte is true or false") {
  const There there([](PacketWriter& to) { to.put(std::array<std::uint8_t, 3>{0, 1, 0xee}); });
  PacketReader from = there.read();
  ValueBlock values(ValueType::Boolean, 3);
  take_values(from, values);
  CHECK(std::to_integer<int>(values.bytes()[0]) == 0);
  CHECK(std::to_integer<int>(values.bytes()[1]) == 1);
  CHECK(std::to_integer<int>(values.bytes()[2]) == 1);
}
