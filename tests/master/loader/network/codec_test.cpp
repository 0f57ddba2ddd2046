#include "master/loader/network/codec.h"

#include <limits>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride;
using namespace stride::remote;
using core::ValueBlock;
using core::ValueType;

namespace {

/// A message as it arrives.
template <class Root>
class Sent {
 public:
  template <class Fill>
  explicit Sent(Fill&& fill) {
    Scratch scratch;
    std::string bytes;
    append_message<Root>(bytes, scratch, fill);
    reader_.put(bytes);
    message_.emplace(*reader_.next());
  }
  typename Root::Reader root() { return message_->root<Root>(); }

 private:
  FrameReader reader_;
  std::optional<IncomingMessage> message_;
};

core::UnitDescription described() {
  core::UnitDescription unit;
  core::Variable number, text;
  number.reference = 3;
  number.size = 2;
  text.reference = 4;
  text.type = ValueType::String;
  unit.variables = {number, text};
  return unit;
}

ValueBlock numbers(std::initializer_list<double> values) {
  ValueBlock block(ValueType::Float64, values.size());
  std::copy(values.begin(), values.end(), block.numbers<double>().begin());
  return block;
}

}  // namespace

TEST_CASE("values of several blocks arrive bit by bit") {
  ValueBlock reals = numbers({-0.0, std::numeric_limits<double>::quiet_NaN(), 5e-324});
  ValueBlock texts(ValueType::String, 2), bytes(ValueType::Binary, 1);
  ValueBlock truths(ValueType::Boolean, 2);
  texts.strings()[0] = "\xff text";
  bytes.binaries()[0] = {1, 2, 3};
  truths.numbers<bool>()[1] = true;
  const std::vector<core::BoundValues> out{{{}, reals}, {{}, texts}, {{}, truths}, {{}, bytes}};
  Sent<wire::Values> sent([&](wire::Values::Builder to) { put_values(to, out); });
  ValueBlock reals2(ValueType::Float64, 3), texts2(ValueType::String, 2);
  ValueBlock bytes2(ValueType::Binary, 1), truths2(ValueType::Boolean, 2);
  const std::vector<core::BoundValues> in{{{}, reals2}, {{}, texts2}, {{}, truths2}, {{}, bytes2}};
  take_values(sent.root(), in);
  CHECK((reals2 == reals));
  CHECK((texts2 == texts));
  CHECK((bytes2 == bytes));
  CHECK((truths2 == truths));
}

TEST_CASE("values of another size are refused, and a Boolean is 0 or 1") {
  Sent<wire::Values> sent([](wire::Values::Builder to) { put_values(to, numbers({1, 2})); });
  ValueBlock three(ValueType::Float64, 3), text(ValueType::String, 1);
  CHECK_THROWS_AS(take_values(sent.root(), three), BadMessage);
  CHECK_THROWS_AS(take_values(sent.root(), text), BadMessage);
  Sent<wire::Values> odd([](wire::Values::Builder to) { to.initNumbers(1)[0] = 77; });
  ValueBlock truth(ValueType::Boolean, 1);
  take_values(odd.root(), truth);
  CHECK(truth.bytes()[0] == std::byte{1});
}

TEST_CASE("only variables that there are can be named, with the sizes that they have") {
  const core::UnitDescription unit = described();
  const auto taken = [&](std::uint8_t type, std::uint64_t size,
                         const std::vector<core::ValueReference>& references) {
    Sent<wire::Block> sent([&](wire::Block::Builder to) {
      to.setType(type);
      to.setSize(size);
      put_references(to.initReferences(static_cast<unsigned>(references.size())), references);
    });
    return take_block(sent.root(), unit);
  };
  const auto real = static_cast<std::uint8_t>(ValueType::Float64);
  CHECK(taken(real, 4, {3, 3}).size == 4);
  CHECK_THROWS_AS(taken(real, 1'000'000'000'000, {3}), BadMessage);
  CHECK_THROWS_AS(taken(real, 1, {9}), BadMessage);
  CHECK_THROWS_AS(taken(real, 1, {4}), BadMessage);
  CHECK_THROWS_AS(taken(99, 0, {}), BadMessage);
}

TEST_CASE("a step keeps each bit of its interval") {
  core::StepInterval interval(Time(Duration(100)), 1.0000000000000002e-10, Time(Duration(350)),
                              3.5e-10, 2.5e-10);
  interval.may_go_back_before = true;
  Sent<wire::Step> sent([&](wire::Step::Builder to) { put_interval(to, interval); });
  const core::StepInterval taken = take_interval(sent.root());
  CHECK(taken.from == interval.from);
  CHECK(taken.to == interval.to);
  CHECK(taken.begin_seconds == interval.begin_seconds);
  CHECK(taken.end_seconds == interval.end_seconds);
  CHECK(taken.size_seconds == interval.size_seconds);
  CHECK(taken.may_go_back_before);
}

TEST_CASE("a step that ends outside of itself is refused") {
  const core::StepInterval interval(Time(Duration(100)), Time(Duration(350)));
  Sent<wire::StepResult> sent([](wire::StepResult::Builder to) { to.setReached(351); });
  CHECK_THROWS_AS(take_result(sent.root(), interval), BadMessage);
}

TEST_CASE("clocks arrive as exact fractions, and none with the denominator 0") {
  const core::ClockInterval clock{core::ClockInterval::State::Changed,
                                  core::Interval::from_fraction(1, 3)};
  Sent<wire::Result> sent([&](wire::Result::Builder to) { put_clock(to.initClock(), clock); });
  CHECK((take_clock(sent.root().getClock()).interval == clock.interval));
  Sent<wire::Result> bad([](wire::Result::Builder to) { to.initClock().setState(1); });
  CHECK_THROWS_AS(take_clock(bad.root().getClock()), BadMessage);
}

TEST_CASE("errors arrive with all their parts, their kind, the place here and the machine") {
  core::Context context{
      .where = {"a.ssd", 7}, .unit = "u", .variable = "v", .time = Time(Duration(5))};
  const auto again = [here = context](const std::exception& error) {
    Sent<wire::Error> sent([&](wire::Error::Builder to) { put_error(to, error, {.unit = "w"}); });
    throw_error(sent.root(), {.where = here.where, .unit = here.unit}, "box");
  };
  const auto text_of = [&](const core::Context& there) {
    return tests::error_of(
        [&] { again(core::Error(core::Error::Kind::Input, there, "wrong", "mend it")); });
  };
  const std::string expected =
      core::Error(core::Error::Kind::Input, context, "box: wrong", "mend it").what();
  CHECK(text_of(context) == expected);
  context.where = {};
  CHECK(text_of(context) == expected);
  context.where = {"/models/x.fmu/modelDescription.xml", 3};
  CHECK_THAT(text_of(context),
             Catch::Matchers::StartsWith("a.ssd:7: unit 'u'") &&
                 Catch::Matchers::Contains("box: /models/x.fmu/modelDescription.xml:3: wrong"));
  CHECK_THROWS_AS(again(core::EnvironmentError(context, "full")), core::EnvironmentError);
  CHECK_THROWS_AS(again(core::ConsequentError(core::Error::Kind::Run, context, "x")),
                  core::ConsequentError);
  CHECK(tests::error_of([&] { again(std::runtime_error("odd")); }) ==
        "a.ssd:7: unit 'u': box: odd");
}

TEST_CASE("a malformed message is refused, and none makes much out of little") {
  FrameReader reader;
  std::string bytes;
  const std::vector<std::uint64_t> words{0x0000000200000000, 0x0000000100000190, 0};
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(words))};
  append_frames(bytes, parts);
  reader.put(bytes);
  CHECK_THROWS_AS(with_checked_messages([&] {
                    IncomingMessage message(*reader.next());
                    message.root<wire::Request>().getDescribe();
                  }),
                  BadMessage);
}
