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
    const Shape shape = take_shape(from);
    CHECK(shape.type == type);
    CHECK(take_block(from, shape) == values);
    PacketReader less = there.read_all_but(1);
    const Shape other = take_shape(less);
    CHECK_THROWS_AS(take_block(less, other), BadPacket);
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
    const There there([&](PacketWriter& to) {
      Form<core::EventResult>::put(to, {true, false, next});
    });
    PacketReader from = there.read();
    const core::EventResult copy = Form<core::EventResult>::take(from);
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
    take_error(from).raise();
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
  CHECK_THROWS_WITH(take_error(from).raise(), "system.ssd:3: unit 'u': no");
  const There consequent([](PacketWriter& to) {
    put_error(to, core::ConsequentError(core::Error::Kind::Run, {}, "later"), {});
  });
  from = consequent.read();
  CHECK_THROWS_AS(take_error(from).raise(), core::ConsequentError);
  const There environment(
      [](PacketWriter& to) { put_error(to, core::EnvironmentError({}, "full"), {}); });
  from = environment.read();
  CHECK_THROWS_AS(take_error(from).raise(), core::EnvironmentError);
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
    refused([&](PacketWriter& to) { Form<core::EventResult>::put(to, {.next_event_time = next}); },
            Form<core::EventResult>::take);
  }
  refused([](PacketWriter& to) { to.put(std::array<std::uint8_t, 25>{77}); },
          Form<core::ClockInterval>::take);
  refused(
      [](PacketWriter& to) {
        to.put(std::array<std::uint64_t, 3>{1, 2, 0});
      },
      Form<core::Interval>::take);
  refused([](PacketWriter& to) { to.put(77); }, take_error);
  refused([](PacketWriter& to) { to.put(std::uint8_t{core::kValueTypeCount}); }, take_shape);
  const auto take_any = [](PacketReader& from) {
    const Shape shape = take_shape(from);
    take_block(from, shape);
  };
  for (const ValueType type : {ValueType::Int8, ValueType::String}) {
    refused(
        [&](PacketWriter& to) {
          to.put(static_cast<std::uint8_t>(type));
          to.put(std::size_t{1} << 60);
        },
        take_any);
  }
}

TEST_CASE("clocks, statistics and what is in force come over") {
  const core::ClockInterval clock{core::ClockInterval::State::Changed,
                                  core::Interval::from_fraction(1, 3)};
  const core::HostStatistics host{.snapshots = 1,
                                  .restores = 2,
                                  .most_snapshots = 3,
                                  .most_snapshot_memory = 4,
                                  .most_memory = 5,
                                  .protections = {"a", "b"},
                                  .missing_protections = {"c"}};
  const There there([&](PacketWriter& to) {
    Form<core::ClockInterval>::put(to, clock);
    Form<core::HostStatistics>::put(to, host);
  });
  PacketReader from = there.read();
  const core::ClockInterval copy = Form<core::ClockInterval>::take(from);
  CHECK((copy.state == clock.state && copy.interval == clock.interval));
  const core::HostStatistics same = Form<core::HostStatistics>::take(from);
  CHECK(same.restores == 2);
  CHECK(same.most_memory == 5);
  CHECK(same.protections == host.protections);
  CHECK(same.missing_protections == host.missing_protections);
  CHECK_NOTHROW(from.require_end());
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
