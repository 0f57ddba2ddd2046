#include "master/engine/model/conversion.h"

#include <tuple>

#include <catch2/catch.hpp>

#include "master/engine/model/values.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using Kind = Transformation::Kind;

namespace {

const UnitOfMeasure kMetre{"m", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0}};
const UnitOfMeasure kCentimetre{"cm", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 0.01, 0}};
const UnitOfMeasure kSecond{"s", BaseUnitOfMeasure{{0, 0, 1, 0, 0, 0, 0, 0}, 1, 0}};

PathConnector point(const std::string& name, std::optional<ValueType> type,
                    const UnitOfMeasure& unit = {}, bool takes_after_next = false) {
  return {name, type, unit, {}, takes_after_next};
}

PathConnector items(const std::string& name, EnumerationItems items) {
  return {name, ValueType::Enumeration, {}, std::move(items), false};
}

PathSegment linear(double factor, double offset, bool suppress = false) {
  return {suppress, {Kind::Linear, {factor, offset}, {}, {}, {"x.ssd", 7}}};
}

PathSegment numbers(Kind kind, NumberMap map) {
  return {false, {kind, {}, std::move(map), {}, {"x.ssd", 7}}};
}

PathSegment names(std::vector<std::pair<std::string, std::string>> entries) {
  return {false, {Kind::EnumerationMapping, {}, {}, std::move(entries), {"x.ssd", 7}}};
}

Conversion of(std::vector<PathConnector> path, const std::vector<PathSegment>& segments) {
  return compose(std::move(path), segments, {{"x.ssd", 9}, {}, {}, {}});
}

std::string reason(std::vector<PathConnector> path, const std::vector<PathSegment>& segments) {
  try {
    of(std::move(path), segments);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    return error.what();
  }
  return "accepted";
}

const EnumerationItems kLamp{{"off", 0}, {"on", 1}};
const EnumerationItems kSignal{{"red", 3}, {"green", 4}};

}  // namespace

TEST_CASE("units are converted before the transformation, or not at all") {
  const auto y = point("a.y", ValueType::Float64, kCentimetre);
  const auto u = point("b.u", ValueType::Float64, kMetre);
  const Conversion both = of({y, u}, {linear(2, 5)});
  CHECK(both.linear.factor == Approx(0.02));
  CHECK(both.linear.offset == 5);
  const Conversion only = of({y, u}, {linear(2, 5, true)});
  CHECK(only.linear.factor == 2);
  CHECK(only.linear.offset == 5);
}

TEST_CASE("a unit that keeps another from being converted is named if it has no definition") {
  const auto u = point("b.u", ValueType::Float64, kMetre);
  const UnitOfMeasure unknown{"furlong", std::nullopt};
  CHECK_THAT(
      reason({point("a.y", ValueType::Float64, unknown), u}, {{}}),
      Contains(
          "no <BaseUnit> says what 'furlong' is, neither in x.ssd nor where 'a.y' is declared"));
  CHECK_THAT(reason({point("a.y", ValueType::Float64, kSecond), u}, {{}}),
             Contains("cannot be converted") && !Contains("no <BaseUnit>"));
}

TEST_CASE("passages are made one after the other") {
  const auto y = point("a.y", ValueType::Float64, kCentimetre);
  const auto u = point("c.u", ValueType::Float64, kCentimetre);
  SECTION("what has no unit takes on the first one on its way, which is converted to the last") {
    const auto bare = point("a.y", ValueType::Float64);
    const auto system = point("s.y", {}, kMetre);
    CHECK(of({bare, system, u}, {{}, {}}).linear.factor == Approx(100));
    CHECK(of({bare, system, point("t.y", {}, kMetre), u}, {{}, {}, {}}).linear.factor ==
          Approx(100));
    CHECK(of({bare, point("s.y", {}), system, u}, {{}, {}, {}}).linear.factor == Approx(100));
    CHECK(
        of({bare, point("s.y", {}, kMetre), point("o", {}, kCentimetre)}, {{}, {}}).linear.factor ==
        Approx(100));
    CHECK(of({bare, system, point("b.u", ValueType::Float64)}, {{}, {}}).is_identity());
    CHECK(of({bare, system, u}, {{}, {true, {}}}).is_identity());
  }
  SECTION("what leaves a system has the unit that it came with, unless its connector says one") {
    const Conversion c =
        of({y, point("s.y", {}), point("t.u", {}, kMetre), u}, {linear(1, 10), {}, linear(3, 0)});
    CHECK(c.linear.factor == Approx(3));  // cm + 10 -> m -> cm, times 3
    CHECK(c.linear.offset == Approx(30));
  }
  SECTION("what enters a system has the unit of what is inside") {
    const Conversion c =
        of({y, point("t.u", {}, {}, true), point("c.u", ValueType::Float64, kMetre)},
           {linear(1, 10), {}});
    CHECK(c.linear.factor == Approx(0.01));
    CHECK(c.linear.offset == 10);
  }
  SECTION("by way of another unit, a number stays the same") {
    CHECK(of({y, point("s.y", {}, kMetre), u}, {{}, {}}).is_identity());
  }
  SECTION("a unit that does not fit is named where it does not") {
    CHECK_THAT(reason({y, point("s.y", {}, kSecond), u}, {{}, {}}),
               Contains("x.ssd:9: cannot connect 'a.y' to 's.y': 'a.y' is in 'cm', 's.y' in 's'") &&
                   Contains("suppressUnitConversion"));
    CHECK(reason({y, point("s.y", {}, kSecond), u}, {{true, {}}, {true, {}}}) == "accepted");
  }
}

TEST_CASE("types that hold all values of another may take them") {
  const auto [from, to, fits] = GENERATE(table<ValueType, ValueType, bool>({
      {ValueType::Float32, ValueType::Float64, true},
      {ValueType::Float64, ValueType::Float32, true},
      {ValueType::UInt8, ValueType::Int16, true},
      {ValueType::Int32, ValueType::Int64, true},
      {ValueType::UInt32, ValueType::UInt64, true},
      {ValueType::Int32, ValueType::Float64, true},
      {ValueType::Int16, ValueType::Float32, true},
      {ValueType::Int32, ValueType::Float32, false},
      {ValueType::Int64, ValueType::Float64, false},
      {ValueType::Int8, ValueType::UInt8, false},
      {ValueType::Int32, ValueType::Int16, false},
      {ValueType::UInt64, ValueType::Int64, false},
      {ValueType::Float64, ValueType::Int32, false},
      {ValueType::Float64, ValueType::Boolean, false},
      {ValueType::Boolean, ValueType::String, false},
      {ValueType::Binary, ValueType::String, false},
      {ValueType::Clock, ValueType::Boolean, false},
  }));
  CAPTURE(name(from), name(to));
  const std::string said = reason({point("a.y", from), point("b.u", to)}, {{}});
  if (fits) {
    CHECK(said == "accepted");
  } else {
    CHECK_THAT(said, Contains("x.ssd:9: cannot connect 'a.y' to 'b.u'") && Contains(name(from)) &&
                         Contains(name(to)) && Contains("hint:"));
  }
}

TEST_CASE("a transformation is for its types") {
  const auto real = [](const char* name) { return point(name, ValueType::Float64); };
  const auto whole = [](const char* name) { return point(name, ValueType::Int32); };
  const auto flag = [](const char* name) { return point(name, ValueType::Boolean); };
  CHECK_THAT(reason({flag("a.y"), flag("b.u")}, {linear(2, 0)}),
             Contains("x.ssd:7: a LinearTransformation is for Float64 and Float32") &&
                 Contains("BooleanMappingTransformation"));
  CHECK_THAT(reason({real("a.y"), real("b.u")}, {numbers(Kind::IntegerMapping, {{1, 2}})}),
             Contains("is for integers and Enumerations") && Contains("LinearTransformation"));
  CHECK_THAT(reason({whole("a.y"), whole("b.u")}, {numbers(Kind::BooleanMapping, {{1, 0}})}),
             Contains("is for Boolean") && Contains("IntegerMappingTransformation"));
  CHECK_THAT(reason({whole("a.y"), whole("b.u")}, {names({{"a", "b"}})}),
             Contains("is for Enumerations"));
  CHECK_THAT(reason({whole("a.y"), whole("b.u")}, {linear(2, 0)}),
             Contains("is for Float64") && Contains("by an <ssc:IntegerMappingTransformation>"));
  CHECK_THAT(reason({real("a.y"), real("b.u")}, {numbers(Kind::IntegerMapping, {})}),
             Contains(": an IntegerMappingTransformation is for"));
  const auto text = [](const char* name) { return point(name, ValueType::String); };
  CHECK_THAT(reason({text("a.y"), text("b.u")}, {linear(2, 0)}),
             Contains("SSP has no transformation for them"));
}

TEST_CASE("a transformation is applied to the end whose type it is for") {
  const auto real = point("r", ValueType::Float64);
  const auto whole = point("n", ValueType::Int32);
  const auto flag = point("b", ValueType::Boolean);
  const auto exchange = numbers(Kind::BooleanMapping, {{0, 1}, {1, 0}});
  const auto swap = numbers(Kind::IntegerMapping, {{1, 7}, {2, 0}});
  CHECK(converted<double>(std::int32_t{3}, of({whole, real}, {linear(2, 1)})) == 7);
  CHECK(converted<double>(true, of({flag, real}, {linear(5, 1)})) == 6);
  CHECK(converted<float>(false, of({flag, real}, {exchange})) == 1);
  CHECK(converted<double>(std::int32_t{1}, of({whole, real}, {swap})) == 7);
  CHECK(converted<std::int32_t>(true, of({flag, whole}, {exchange})) == 0);
  CHECK(converted<std::int32_t>(true, of({flag, whole}, {swap})) == 7);
  for (const auto& [number, swapped, exchanged] :
       {std::tuple{0, false, true}, {1, true, false}, {2, false, false}, {9, true, false}}) {
    CHECK(converted<bool>(number, of({whole, flag}, {swap})) == swapped);
    CHECK(converted<bool>(number, of({whole, flag}, {exchange})) == exchanged);
    CHECK(converted<bool>(number, of({whole, flag, flag}, {swap, exchange})) == !swapped);
  }
}

TEST_CASE("a Boolean that is a number on its way is mapped there") {
  const auto whole = point("n", ValueType::Int32);
  const auto flag = point("b", ValueType::Boolean);
  const auto exchange = numbers(Kind::BooleanMapping, {{0, 1}, {1, 0}});
  const Conversion c =
      of({flag, whole, flag, flag}, {numbers(Kind::IntegerMapping, {{0, 5}, {1, 6}}),
                                     numbers(Kind::IntegerMapping, {{5, 0}}), exchange});
  CHECK(converted<bool>(true, c) == false);
  CHECK(converted<bool>(false, c) == true);
  const Conversion both = of({flag, whole, point("r", ValueType::Float64)},
                             {numbers(Kind::IntegerMapping, {{1, 4}}), linear(10, 1)});
  CHECK(converted<double>(true, both) == 41);
  CHECK_THAT(
      reason({flag, whole, point("u", ValueType::UInt8)},
             {numbers(Kind::IntegerMapping, {{1, 300}}), numbers(Kind::IntegerMapping, {{2, 2}})}),
      Contains("the value 'true' of the one becomes 300, which is not a valid UInt8"));
}

TEST_CASE("what a mapping does not name stays what it is") {
  const auto y = point("a.y", ValueType::Int32);
  const auto u = point("b.u", ValueType::Int32);
  const Conversion once = of({y, u}, {numbers(Kind::IntegerMapping, {{1, 10}, {2, 20}})});
  CHECK(mapped(once.map, 1) == 10);
  CHECK(mapped(once.map, 2) == 20);
  CHECK(mapped(once.map, 3) == 3);
  const Conversion twice =
      of({y, point("s.y", {}), u}, {numbers(Kind::IntegerMapping, {{1, 2}, {5, 7}}),
                                    numbers(Kind::IntegerMapping, {{2, 3}, {4, 5}, {7, 7}})});
  const std::vector<std::int64_t> results{0, 3, 3, 3, 5, 7, 6, 7};
  for (std::size_t i = 0; i < results.size(); ++i) {
    CHECK(mapped(twice.map, static_cast<std::int64_t>(i)) == results[i]);
  }
  const Conversion flag = of({point("a.y", ValueType::Boolean), point("b.u", ValueType::Boolean)},
                             {numbers(Kind::BooleanMapping, {{0, 1}, {1, 0}})});
  CHECK(mapped(flag.map, 0) == 1);
  CHECK(mapped(flag.map, 1) == 0);
}

TEST_CASE("the targets of a mapping are in the target, its sources need not be in the source") {
  const auto small = point("b.u", ValueType::UInt8);
  CHECK_THAT(
      reason({point("a.y", ValueType::UInt8), small}, {numbers(Kind::IntegerMapping, {{1, 256}})}),
      Contains("x.ssd:7: the target 256 of the mapping is not a valid UInt8, which 'b.u' is"));
  const Conversion c = of({point("a.y", ValueType::UInt8), small},
                          {numbers(Kind::IntegerMapping, {{-1, 3}, {1, 2}, {999, 4}})});
  CHECK(c.map == NumberMap{{1, 2}});
  CHECK_THAT(
      reason({point("a.y", ValueType::Int32), small}, {numbers(Kind::IntegerMapping, {{-1, 3}})}),
      Contains("not every Int32 is a UInt8") && Contains("stays what it is"));
}

TEST_CASE("the items of Enumerations are mapped by their names") {
  const Conversion c =
      of({items("a.y", kLamp), items("b.u", kSignal)}, {names({{"off", "red"}, {"on", "green"}})});
  CHECK(c.map == NumberMap{{0, 3}, {1, 4}});
  CHECK(c.valid.empty());
  CHECK_THAT(reason({items("a.y", kLamp), items("b.u", kSignal)}, {names({{"of", "red"}})}),
             Contains("x.ssd:7: the Enumeration of 'a.y' has no item 'of'") &&
                 Contains("did you mean 'off'?"));
  CHECK_THAT(
      reason({items("a.y", kLamp), items("b.u", kSignal)}, {names({{"off", "red"}})}),
      Contains("the item 'on' of the one becomes 1, which is not an item of the other: red (3), "
               "green (4)"));
  CHECK_THAT(reason({items("a.y", kLamp), items("b.u", kSignal)}, {{}}),
             Contains("the item 'off'") && Contains("EnumerationMappingTransformation"));
  CHECK_THAT(reason({items("a.y", kLamp), items("b.u", kSignal)},
                    {numbers(Kind::IntegerMapping, {{0, 3}, {1, 5}})}),
             Contains("the target 5 of the mapping is not an item of the Enumeration of 'b.u'"));
}

TEST_CASE("items of the same names are the same, whatever their numbers") {
  const EnumerationItems other{{"on", 3}, {"Off", 4}, {"broken", 5}};
  const Conversion c = of({items("a.y", kLamp), items("b.u", other)}, {{}});
  CHECK(c.map == NumberMap{{0, 4}, {1, 3}});
  CHECK(c.valid.empty());
  const Conversion back =
      of({items("a.y", other), items("s.x", {{"broken", 0}, {"off", 1}, {"on", 2}}),
          items("b.u", {{"broken", 7}, {"off", 8}, {"on", 9}})},
         {{}, {}});
  for (const auto& [from, to] : NumberMap{{3, 9}, {4, 8}, {5, 7}}) {
    CHECK(mapped(back.map, from) == to);
  }
  const std::vector<PathSegment> segments{{}, {}};
  CHECK(compose_text("2 on 1",
                     {{"the value", {}, {}, {}, true},
                      items("s.x", {{"off", 1}, {"on", 2}}),
                      items("b.u", kLamp)},
                     segments, {})
            .text == "on on off");
}

TEST_CASE("an item is known by its name before its number") {
  const EnumerationItems digits{{"1", 5}, {"eco", 1}, {"3", 3}};
  const auto text = [&](const std::string& given, std::vector<PathConnector> ends,
                        const PathSegment& segment, bool is_integer = false) {
    std::vector<PathConnector> path{{"the value", {}, {}, {}, true}};
    path.insert(path.end(), ends.begin(), ends.end());
    const std::vector<PathSegment> segments{segment, {}};
    return compose_text(given, path, std::span(segments).first(ends.size()), {}, is_integer).text;
  };
  const PathConnector end = items("b.u", digits);
  CHECK(text("1", {end}, {}) == "1");
  CHECK(text("1 3", {end}, {}, true) == "eco 3");
  CHECK_THROWS_WITH(text("2", {end}, {}, true), Contains("'2' is not the number of an item"));
  // by way of a connector with other items, and of an integer
  CHECK(text("a", {items("s.x", {{"a", 1}, {"b", 3}}), end}, {}) == "eco");
  CHECK(text("1", {point("s.x", ValueType::Int32), end}, {}) == "eco");
  CHECK(text("1", {end, point("b.u", ValueType::Int32)}, {}) == "5");
  CHECK(text("1", {end}, numbers(Kind::IntegerMapping, {{5, 1}})) == "eco");
  CHECK(text("5", {end}, numbers(Kind::IntegerMapping, {{5, 1}}), true) == "eco");
  CHECK(text("1", {end}, names({{"eco", "3"}})) == "1");
  CHECK(text("5", {end}, names({{"1", "3"}})) == "3");
}

TEST_CASE("items of the same names and other numbers are an error where not all are in both") {
  const EnumerationItems other{{"on", 0}, {"red", 1}};
  CHECK_THAT(reason({items("a.y", kLamp), items("b.u", other)}, {{}}),
             Contains("cannot connect 'a.y' to 'b.u': items of the same names") &&
                 Contains("'on' is 1 and 0") && Contains("EnumerationMappingTransformation"));
  CHECK_THAT(reason({items("a.y", kLamp), items("b.u", other)}, {names({{"off", "red"}})}),
             Contains("accepted"));
  CHECK(of({items("a.y", kLamp), items("b.u", other)}, {numbers(Kind::IntegerMapping, {})})
            .is_identity());
}

TEST_CASE("an Enumeration goes to an integer that holds its items, and back if they are items") {
  const auto to = [](ValueType type) { return point("b.u", type); };
  CHECK(of({items("a.y", kLamp), to(ValueType::UInt8)}, {{}}).is_identity());
  CHECK_THAT(reason({items("a.y", {{"low", -1}}), to(ValueType::UInt8)}, {{}}),
             Contains("Enumeration and UInt8 are different types"));
  CHECK(reason({items("a.y", {{"low", -1}}), to(ValueType::UInt8)},
               {numbers(Kind::IntegerMapping, {{-1, 0}})}) == "accepted");
  CHECK_THAT(reason({items("a.y", {{"low", -1}, {"lower", -2}}), to(ValueType::UInt8)},
                    {numbers(Kind::IntegerMapping, {{-1, 0}})}),
             Contains("the item 'lower' of the one becomes -2, which is not a valid UInt8"));
  const Conversion back = of({point("a.y", ValueType::Int32), items("b.u", kSignal)}, {{}});
  CHECK(back.valid == std::vector<std::int64_t>{3, 4});
}

TEST_CASE("values that are given as text are mapped word by word") {
  const auto with = [](const std::string& text, ValueType type, const PathSegment& segment) {
    const std::vector<PathSegment> segments{segment};
    return compose_text(text, {{"the value", {}, {}, {}, true}, point("b.u", type)}, segments, {})
        .text;
  };
  CHECK(with("on", ValueType::Enumeration, names({{"on", "green"}})) == "green");
  CHECK(with("1 2  3", ValueType::Int32, numbers(Kind::IntegerMapping, {{2, 5}})) == "1 5 3");
  CHECK(with("0 true", ValueType::Boolean, numbers(Kind::BooleanMapping, {{0, 1}})) == "true true");
  CHECK(with(" a  b ", ValueType::String, {}) == " a  b ");
  CHECK(with("2 true", ValueType::Float64, numbers(Kind::IntegerMapping, {{1, 3}, {2, 5}})) ==
        "5 3");
  CHECK(with("2.0 2.5", ValueType::Float64, numbers(Kind::IntegerMapping, {{2, 5}})) == "5 2.5");
  CHECK(with("2.0 0.0", ValueType::Boolean, numbers(Kind::BooleanMapping, {{1, 0}})) ==
        "false false");
  CHECK(with("true", ValueType::Int32, numbers(Kind::BooleanMapping, {{1, 0}})) == "false");
}

TEST_CASE("each connection of a running system converts, from the first instant on") {
  using T = ValueType;
  ScriptedSystem system;
  const auto source = Describe("source")
                          .add("d", T::Float64, Causality::Output)
                          .add("f", T::Float32, Causality::Output)
                          .add("n", T::Int16, Causality::Output)
                          .add("b", T::Boolean, Causality::Output)
                          .add("u", T::UInt64, Causality::Output)
                          .done();
  const auto sink = Describe("sink")
                        .add("f", T::Float32, Causality::Input)
                        .add("d", T::Float64, Causality::Input)
                        .add("d2", T::Float64, Causality::Input)
                        .add("b", T::Boolean, Causality::Input)
                        .add("u", T::UInt64, Causality::Input)
                        .done();
  ScriptedUnit& a = system.add("a", source);
  ScriptedUnit& b = system.add("b", sink);
  const auto put = [](ScriptedUnit& self, double x) {
    self.number(0) = x;
    self.block(1).numbers<float>()[0] = static_cast<float>(2 * x);
    self.block(2).numbers<std::int16_t>()[0] = static_cast<std::int16_t>(x);
    self.block(3).numbers<bool>()[0] = true;
    self.block(4).numbers<std::uint64_t>()[0] = ~std::uint64_t{0};
  };
  a.on_initialize = [&](ScriptedUnit& self) { put(self, 4); };
  a.on_step = [&](ScriptedUnit& self, Time, Time to) {
    put(self, 4 + to_seconds(to));
    return reached(to);
  };
  std::vector<std::string> seen;
  b.on_step = [&](ScriptedUnit& self, Time, Time to) {
    seen.push_back(fmt::format("{} {} {} {} {}", self.block(0).numbers<float>()[0], self.number(1),
                               self.number(2), self.block(3).numbers<bool>()[0],
                               self.block(4).numbers<std::uint64_t>()[0]));
    return reached(to);
  };
  system.wire("a", "d", "b", "f");
  system.wire("a", "f", "b", "d");
  system.wire("a", "n", "b", "d2");
  system.wire("a", "b", "b", "b");
  system.wire("a", "u", "b", "u");
  auto& wires = system.declaration.connections;
  wires[0].transformation = {Kind::Linear, {3, 1}, {}, {}, {}};
  wires[3].transformation = {Kind::BooleanMapping, {}, {{1, 0}}, {}, {}};
  wires[4].transformation = {Kind::IntegerMapping, {}, {{-1, 7}}, {}, {}};  // no UInt64, so ignored
  system.build(2, std::chrono::seconds(1)).run();
  const std::string all = std::to_string(~std::uint64_t{0});
  CHECK(seen == std::vector<std::string>{"13 8 4 false " + all, "16 10 5 false " + all});
}

TEST_CASE("an integer that is not an item of the Enumeration that it goes to ends the run") {
  ScriptedSystem system;
  auto sink = std::make_shared<UnitDescription>(
      *Describe("sink").add("mode", ValueType::Enumeration, Causality::Input).done());
  sink->variables[0].items = kSignal;
  ScriptedUnit& a =
      system.add("a", Describe("a").add("n", ValueType::Int32, Causality::Output).done());
  a.on_initialize = [](ScriptedUnit& self) { self.block(0).numbers<std::int32_t>()[0] = 3; };
  a.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.block(0).numbers<std::int32_t>()[0] = 5;
    return reached(to);
  };
  system.add("b", sink);
  system.wire("a", "n", "b", "mode");
  CHECK_THROWS_WITH(system.build(2, std::chrono::seconds(1)).run(),
                    Contains("unit 'b', variable 'mode', at 1 s: 'a.n' gives it 5") &&
                        Contains("IntegerMappingTransformation"));
}

TEST_CASE("messages are converted, too") {
  ScriptedSystem system;
  const auto sender = Describe("sender")
                          .add("clock", ValueType::Clock, Causality::Output)
                          .add("level", ValueType::Float32, Causality::Output)
                          .clocked_by(0)
                          .done();
  const auto receiver = Describe("receiver")
                            .add("clock", ValueType::Clock, Causality::Input)
                            .add("level", ValueType::Float64, Causality::Input)
                            .clocked_by(0)
                            .done();
  ScriptedUnit& a = system.add("a", sender);
  ScriptedUnit& b = system.add("b", receiver);
  a.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.clock(0) = true;
    self.block(1).numbers<float>()[0] = 1.5F;
    StepResult result = reached(to);
    result.event_handling_needed = true;
    return result;
  };
  a.on_event = [](ScriptedUnit& self) {
    self.clock(0) = false;
    return EventResult{};
  };
  std::vector<double> levels;
  b.on_event = [&](ScriptedUnit& self) {
    if (std::exchange(self.clock(0), false)) levels.push_back(self.number(1));
    return EventResult{};
  };
  system.wire("a", "clock", "b", "clock");
  system.wire("a", "level", "b", "level");
  system.declaration.connections[1].transformation = {Kind::Linear, {10, 1}, {}, {}, {}};
  system.build(1, std::chrono::seconds(1)).run();
  CHECK(levels == std::vector<double>{16});
}

TEST_CASE("a Boolean becomes a number, and a whole number at the end a Boolean") {
  const auto path = [](ValueType from, ValueType to) {
    return std::vector{point("a.y", from), point("b.u", to)};
  };
  for (const ValueType number : {ValueType::Float64, ValueType::Float32, ValueType::Int32}) {
    CHECK(of(path(ValueType::Boolean, number), {{}}).is_identity());
  }
  CHECK(of(path(ValueType::Int32, ValueType::Boolean), {{}}).is_identity());
  CHECK_THAT(reason(path(ValueType::Float64, ValueType::Boolean), {{}}),
             Contains("Float64 and Boolean are different types"));
  CHECK_THAT(reason(path(ValueType::Boolean, ValueType::String), {{}}),
             Contains("one is not converted into the other"));
  CHECK_THAT(reason({point("a.y", ValueType::Int32), point("s.c", ValueType::Boolean),
                     point("b.u", ValueType::Int32)},
                    {{}, {}}),
             Contains("cannot connect 'a.y' to 's.c'"));
  const Conversion scaled = of({point("a.y", ValueType::Boolean), point("s.c", ValueType::Float64),
                                point("b.u", ValueType::Float64)},
                               {{}, linear(3, 0.5)});
  CHECK(converted<double>(true, scaled) == 3.5);
  CHECK(converted<double>(false, scaled) == 0.5);
  CHECK(boolean_conversion(ValueType::Boolean, ValueType::Int8) == "true becomes 1, false 0");
  CHECK(boolean_conversion(ValueType::Boolean, ValueType::Boolean).empty());
}
