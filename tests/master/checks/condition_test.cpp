#include "master/checks/condition.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/master/checks/support.h"

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
