#include "master/observe/checks/condition.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using Catch::Contains;
using core::ValueBlock;
using core::ValueType;

namespace {

ConditionText range(const std::string& min, const std::string& max) {
  ConditionText text;
  text.min = min;
  text.max = max;
  return text;
}

ConditionText open_range(const std::string& above, const std::string& below) {
  ConditionText text;
  text.above = above;
  text.below = below;
  return text;
}

ConditionText equals(const std::string& value, std::optional<std::string> tolerance = {}) {
  ConditionText text;
  text.equals = value;
  text.tolerance = std::move(tolerance);
  return text;
}

template <class T>
Truth holds(ValueType type, const ConditionText& text, T value) {
  ValueBlock block(type, 2);
  block.numbers<T>()[1] = value;
  return Condition(variable(type), text).holds(block, 1);
}

bool real_holds(const ConditionText& text, double value) {
  return holds(ValueType::Float64, text, value) == Truth::True;
}

template <class T>
double robustness(ValueType type, const ConditionText& text, T value) {
  ValueBlock block(type, 2);
  block.numbers<T>()[1] = value;
  return Condition(variable(type), text).judge(block, 1).robustness;
}

double real_robustness(const ConditionText& text, double value) {
  return robustness(ValueType::Float64, text, value);
}

std::string mistake(ValueType type, const ConditionText& text) {
  try {
    Condition(variable(type), text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(none)";
}

}  // namespace

TEST_CASE("min and max belong to a range, above and below do not") {
  const double next = std::nextafter(1.8, 2);
  const double previous = std::nextafter(1.8, 1);
  CHECK((real_holds(range("1.8", "5"), 1.8) && real_holds(range("1.8", "5"), 5)));
  CHECK((!real_holds(range("1.8", "5"), previous) && !real_holds(range("1.8", "5"), 5.1)));
  CHECK((!real_holds(open_range("1.8", "5"), 1.8) && !real_holds(open_range("1.8", "5"), 5)));
  CHECK((real_holds(open_range("1.8", "5"), next) && real_holds(open_range("1.8", "5"), 4)));
  CHECK(real_holds(range("-1e3", "1e3"), -1000));
}

TEST_CASE("equals, with and without a tolerance") {
  CHECK((real_holds(equals("0.5"), 0.5) && !real_holds(equals("0.5"), 0.25)));
  CHECK((real_holds(equals("0.5", "0.25"), 0.75) && real_holds(equals("0.5", "0.25"), 0.25)));
  CHECK_FALSE(real_holds(equals("0.5", "0.25"), std::nextafter(0.75, 1)));
  CHECK_FALSE(real_holds(equals("0.5", "0.25"), std::numeric_limits<double>::infinity()));
}

TEST_CASE("NaN neither holds nor fails to hold") {
  const double nan = std::nan("");
  CHECK(holds(ValueType::Float64, range("0", "1"), nan) == Truth::NotANumber);
  CHECK(holds(ValueType::Float64, equals("0", "1"), nan) == Truth::NotANumber);
  CHECK(holds(ValueType::Float32, open_range("0", "1"), std::nanf("")) == Truth::NotANumber);
}

TEST_CASE("each type is compared as what it is") {
  CHECK(holds<float>(ValueType::Float32, range("1.8", "2"), 1.8F) == Truth::True);
  const std::int64_t large = (std::int64_t{1} << 53) + 1;
  CHECK(holds(ValueType::Int64, equals(std::to_string(large)), large) == Truth::True);
  CHECK(holds(ValueType::Int64, equals(std::to_string(large)), large - 1) == Truth::False);
  CHECK(holds<std::uint8_t>(ValueType::UInt8, open_range("3", "255"), 254) == Truth::True);
  CHECK(holds(ValueType::Boolean, equals("true"), true) == Truth::True);
  CHECK(holds(ValueType::Boolean, equals("0"), true) == Truth::False);
  ValueBlock text(ValueType::String, 1);
  text.strings()[0] = "on air";
  CHECK(Condition(variable(ValueType::String), equals("on air")).holds(text, 0) == Truth::True);
  CHECK(Condition(variable(ValueType::String), equals("")).holds(text, 0) == Truth::False);
  ValueBlock bytes(ValueType::Binary, 1);
  bytes.binaries()[0] = {0, 0xe8};
  CHECK(Condition(variable(ValueType::Binary), equals("00e8")).holds(bytes, 0) == Truth::True);
  CHECK(Condition(variable(ValueType::Binary), equals("00")).holds(bytes, 0) == Truth::False);
}

TEST_CASE("an enumeration is compared with the name of an item or its number") {
  core::Variable mode = variable(ValueType::Enumeration);
  mode.items = {{"off", 1}, {"on", 2}};
  ValueBlock block(ValueType::Enumeration, 1);
  block.numbers<std::int64_t>()[0] = 2;
  const Condition on(mode, equals("on"));
  CHECK(on.holds(block, 0) == Truth::True);
  CHECK(Condition(mode, equals("1")).holds(block, 0) == Truth::False);
  CHECK(on.text() == "= on");
  CHECK(on.value_text(block, 0) == "on");
}

TEST_CASE("in words, with the unit of measure") {
  const core::Variable voltage = variable(ValueType::Float64, "V");
  CHECK(Condition(voltage, range("1.80", "5")).text() == ">= 1.8 V and <= 5 V");
  CHECK(Condition(voltage, open_range("0", "1")).text() == "> 0 V and < 1 V");
  CHECK(Condition(voltage, equals("3", "0.1")).text() == "= 3 V ± 0.1 V");
  ValueBlock text(ValueType::String, 1);
  text.strings()[0] = "a";
  CHECK(Condition(variable(ValueType::String), equals("b")).value_text(text, 0) == "'a'");
  const Condition bytes(variable(ValueType::Binary), equals("00"));
  CHECK(bytes.value_text(ValueBlock(ValueType::Binary, 1), 0) == "no bytes");
}

TEST_CASE("robustness: the distance to the nearest limit, negative outside") {
  CHECK(real_robustness(range("1", "5"), 1.5) == 0.5);
  CHECK(real_robustness(range("1", "5"), 4.75) == 0.25);
  CHECK(real_robustness(range("1", "5"), -1) == -2);
  CHECK(real_robustness(open_range("1", "5"), 8) == -3);
  CHECK(real_robustness(equals("0.5", "0.25"), 0.625) == 0.125);
  CHECK(real_robustness(equals("0.5", "0.25"), 1) == -0.25);
  CHECK(real_robustness(equals("0.5"), 0.75) == -0.25);
  CHECK(robustness<float>(ValueType::Float32, range("0.5", "2"), 1.5F) == 0.5);
}

TEST_CASE("robustness: at a limit 0, and nearest to it of the right sign") {
  CHECK(real_robustness(range("1", "5"), 1) == 0);
  CHECK(real_robustness(open_range("1", "5"), 5) == 0);
  CHECK((real_robustness(equals("3"), 3) == 0 && !std::signbit(real_robustness(equals("3"), 3))));
  const double least = std::numeric_limits<double>::denorm_min();
  CHECK(real_robustness(range("0", "1"), -least) == -least);
  CHECK(real_robustness(range("2.2250738585072014e-308", "1"),
                        std::nextafter(2.2250738585072014e-308, 0)) == -least);
}

TEST_CASE("robustness: infinities stay, and NaN is infinitely far outside") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(real_robustness(range("0", "1"), kInfinity) == -kInfinity);
  ConditionText above;
  above.above = "0";
  CHECK(real_robustness(above, kInfinity) == kInfinity);
  CHECK(real_robustness(range("-1e308", "1e308"), -1.7e308) < 0);
  CHECK(real_robustness(above, std::nan("")) == -kInfinity);
  CHECK(real_robustness(equals("3", "1"), std::nan("")) == -kInfinity);
}

TEST_CASE("robustness of integers is a whole number, also where doubles do not tell them apart") {
  const std::int64_t large = std::int64_t{1} << 62;
  const auto next = std::to_string(large + 1);
  CHECK(robustness(ValueType::Int64, range(next, next), large) == -1);
  CHECK(robustness(ValueType::Int64, range("-9223372036854775808", "5"),
                   std::numeric_limits<std::int64_t>::max()) == -9223372036854775802.0);
  CHECK(robustness<std::uint64_t>(ValueType::UInt64, range("1", "18446744073709551615"), 0) == -1);
  CHECK(robustness<std::uint8_t>(ValueType::UInt8, open_range("3", "255"), 250) == 5);
  CHECK(robustness<std::int8_t>(ValueType::Int8, equals("-3"), 2) == -5);
}

TEST_CASE("robustness of what has no order tells only whether the condition holds") {
  CHECK(robustness(ValueType::Boolean, equals("true"), true) == 1);
  CHECK(robustness(ValueType::Boolean, equals("true"), false) == -1);
  core::Variable mode = variable(ValueType::Enumeration);
  mode.items = {{"off", 1}, {"on", 7}};
  ValueBlock block(ValueType::Enumeration, 1);
  block.numbers<std::int64_t>()[0] = 7;
  CHECK(Condition(mode, equals("on")).judge(block, 0).robustness == 1);
  CHECK(Condition(mode, equals("off")).judge(block, 0).robustness == -1);
  const ValueBlock text(ValueType::String, 1);
  CHECK(Condition(variable(ValueType::String), equals("a")).judge(text, 0).robustness == -1);
  const ValueBlock bytes(ValueType::Binary, 1);
  CHECK(Condition(variable(ValueType::Binary), equals("")).judge(bytes, 0).robustness == 1);
}

TEST_CASE("limits are those of the attributes, in the variable's type") {
  const auto limits = Condition(variable(ValueType::Int32), range("1", "5")).limits();
  REQUIRE(limits.size() == 2);
  CHECK((limits[0].name == "min" && limits[1].name == "max"));
  CHECK(limits[1].value.numbers<std::int32_t>()[0] == 5);
  const auto near = Condition(variable(ValueType::Float64), equals("1", "0.5")).limits();
  REQUIRE(near.size() == 2);
  CHECK((near[0].name == "equals" && near[1].name == "tolerance"));
}

TEST_CASE("what makes no sense is refused") {
  CHECK_THAT(mistake(ValueType::Float64, {}),
             Contains("expected min, max, above, below or equals"));
  CHECK_THAT(mistake(ValueType::Boolean, {}), Contains("compares with nothing; expected equals"));
  CHECK_THAT(mistake(ValueType::Float64, range("2", "1")),
             Contains("no value fits min 2 and max 1"));
  CHECK(mistake(ValueType::Float64, range("1", "1")) == "(none)");
  CHECK_THAT(mistake(ValueType::Float64, open_range("1", "1")),
             Contains("no value fits above 1 and below 1"));
  CHECK_THAT(mistake(ValueType::Float64, range("nan", "1")),
             Contains("min: 'nan' is not a finite"));
  CHECK_THAT(mistake(ValueType::Float64, range("0", "inf")),
             Contains("max: 'inf' is not a finite"));
  CHECK_THAT(mistake(ValueType::Float64, range("low", "1")), Contains("min: 'low' is not a value"));
  CHECK_THAT(mistake(ValueType::UInt8, equals("256")), Contains("within the range of UInt8"));
  CHECK_THAT(mistake(ValueType::Boolean, equals("yes")), Contains("true or false"));
  CHECK_THAT(mistake(ValueType::Boolean, range("false", "true")),
             Contains("a Boolean has no order; expected equals"));
  CHECK_THAT(mistake(ValueType::Clock, range("false", "true")), Contains("a Clock has no order"));
  CHECK_THAT(mistake(ValueType::Int32, equals("3", "1")), Contains("for real numbers"));
  CHECK_THAT(mistake(ValueType::Float64, equals("3", "-1")),
             Contains("not a number of at least 0"));
  ConditionText both = range("0", "1");
  both.equals = "1";
  CHECK_THAT(mistake(ValueType::Float64, both), Contains("exclude each other"));
  ConditionText lonely = range("0", "1");
  lonely.tolerance = "1";
  CHECK_THAT(mistake(ValueType::Float64, lonely), Contains("for equals, which is missing"));
}
