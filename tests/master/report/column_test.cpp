#include "master/report/column.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace stride::report;
using Catch::Contains;
using stride::core::ValueType;

namespace {

using Doubles = std::vector<double>;
using Integers = std::vector<std::int32_t>;
using Booleans = std::vector<std::uint8_t>;
using Words = std::vector<std::string>;

Column filled(Column column, const Words& fields, bool is_quoted = false) {
  for (const std::string& field : fields) column.append({field, is_quoted});
  return column;
}
Column of(ValueType type, const Words& fields, bool is_quoted = false) {
  return filled(Column(SignalInfo{"a.x", "m", type, true}), fields, is_quoted);
}
Column deduced(const Words& fields) { return filled(Column("a.x", "m"), fields); }

template <class Values>
Values values(const Column& column) {
  REQUIRE(std::holds_alternative<Values>(column.values()));
  return std::get<Values>(column.values());
}
Words texts(const Column& column) {
  REQUIRE(std::holds_alternative<Texts>(column.values()));
  const Texts& held = std::get<Texts>(column.values());
  Words words;
  for (const auto i : held.indices()) words.push_back(held.distinct()[static_cast<std::size_t>(i)]);
  return words;
}

std::string refusal(ValueType type, const std::string& field) {
  try {
    of(type, {field});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("numbers read back as their bits, infinities and NaN, too") {
  const Doubles found =
      values<Doubles>(of(ValueType::Float64,
                         {"0.1", "-0", "5e-324", "inf", "-inf", "nan", "1.7976931348623157e+308"}));
  CHECK(found[0] == 0.1);
  CHECK((found[1] == 0 && std::signbit(found[1])));
  CHECK(found[2] == std::numeric_limits<double>::denorm_min());
  CHECK(found[3] == std::numeric_limits<double>::infinity());
  CHECK(found[4] == -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(found[5]));
  CHECK(found[6] == std::numeric_limits<double>::max());
}

TEST_CASE("integers are as narrow as they can be") {
  CHECK(values<Integers>(of(ValueType::UInt64, {"1", "2147483647"})) == Integers{1, 2147483647});
  CHECK(values<Integers>(of(ValueType::Enumeration, {"-3"})) == Integers{-3});
  CHECK(values<Doubles>(of(ValueType::UInt32, {"-1", "4294967295"})) == Doubles{-1, 4294967295});
  CHECK(values<Doubles>(of(ValueType::Int64, {"9007199254740992", "7"})) == Doubles{0x1p53, 7});
}

TEST_CASE("integers that no double has are texts") {
  CHECK(texts(of(ValueType::Int64, {"5", "-9007199254740993", "5"})) ==
        Words{"5", "-9007199254740993", "5"});
  CHECK(texts(of(ValueType::UInt64, {"3000000000", "18446744073709551615", "1"})) ==
        Words{"3000000000", "18446744073709551615", "1"});
}

TEST_CASE("Booleans and texts") {
  CHECK(values<Booleans>(of(ValueType::Boolean, {"true", "false"})) == Booleans{1, 0});
  CHECK(texts(of(ValueType::String, {"say \"\"no\"\"", "", "b"}, true)) ==
        Words{"say \"no\"", "", "b"});
  CHECK(texts(of(ValueType::Binary, {"00ff", "0a", "00ff"})) == Words{"00ff", "0a", "00ff"});
}

TEST_CASE("a value has the text of the file, in whatever form it is held") {
  CHECK(of(ValueType::Float64, {"0.1", "-0", "nan"}).text(1) == "-0");
  CHECK(of(ValueType::Float64, {"0.1", "-0", "nan"}).text(2) == "nan");
  CHECK(of(ValueType::Boolean, {"false", "true"}).text(1) == "true");
  CHECK(of(ValueType::Int32, {"-7"}).text(0) == "-7");
  CHECK(of(ValueType::UInt32, {"7", "4294967295"}).text(1) == "4294967295");
  CHECK(of(ValueType::UInt64, {"7", "18446744073709551615"}).text(0) == "7");
  CHECK(of(ValueType::String, {"a", "b", "a"}).text(2) == "a");
}

TEST_CASE("a signal that does not change continuously is stepped") {
  CHECK_FALSE(of(ValueType::Float64, {}).is_stepped());
  CHECK(of(ValueType::Int32, {}).is_stepped());
  CHECK(Column(SignalInfo{"a.x", "", ValueType::Float64, false}).is_stepped());
}

TEST_CASE("what is not of the type is refused, and the text says what was expected") {
  CHECK_THAT(refusal(ValueType::Float64, "1.5x"),
             Contains("expected a number (the type is Float64), found '1.5x'"));
  CHECK_THAT(refusal(ValueType::Float64, ""), Contains("found ''"));
  CHECK_THAT(refusal(ValueType::Int32, "1.5"), Contains("expected an integer"));
  CHECK_THAT(refusal(ValueType::UInt64, "18446744073709551616"), Contains("expected an integer"));
  CHECK_THAT(refusal(ValueType::Boolean, "1"), Contains("expected true or false"));
  CHECK_THAT(refusal(ValueType::Int32, std::string(100, 'x')), Contains("xxx…'"));
  CHECK_THAT(refusal(ValueType::Int32, std::string("1\0x", 3)), Contains("found '1\\x00x'"));
}

TEST_CASE("without run.json the type follows from the fields") {
  CHECK(deduced({"true", "false"}).type() == ValueType::Boolean);
  CHECK(values<Doubles>(deduced({"1", "1e-9"})) == Doubles{1, 1e-9});
  const Column mixed = deduced({"0.1", "1e+20", "0a0b"});
  CHECK(mixed.type() == ValueType::String);
  CHECK(texts(mixed) == Words{"0.1", "1e+20", "0a0b"});
  CHECK(texts(deduced({"true", "7"})) == Words{"true", "7"});
  CHECK(deduced({}).size() == 0);
}

TEST_CASE("without run.json digits that a double does not have make a column one of texts") {
  for (const char* text : {"007", "00", "-01", "9223372036854775807", "9007199254740993"}) {
    INFO(text);
    const Column column = deduced({"1", text});
    CHECK(column.type() == ValueType::String);
    CHECK(texts(column) == Words{"1", text});
  }
  for (const char* text : {"0", "-0", "0.5", "-1e300", "9007199254740992", "inf", "nan"}) {
    INFO(text);
    CHECK(deduced({text}).type() == ValueType::Float64);
  }
}

TEST_CASE("rows are kept from one on") {
  Column column = of(ValueType::Int32, {"0", "1", "2", "3", "4"});
  const std::vector<std::size_t> rows = {2, 4};
  column.keep(2, rows);
  CHECK(values<Integers>(column) == Integers{0, 1, 2, 4});
  column.keep(3, {});
  CHECK(column.size() == 3);
}

TEST_CASE("texts of rows that are gone go, and the others stay what they are") {
  Column column = of(ValueType::String, {"a", "b", "c", "d", "b", "e"});
  const std::vector<std::size_t> rows = {3, 4};
  column.keep(1, rows);
  CHECK(texts(column) == Words{"a", "d", "b"});
  column.drop_unused_texts();
  CHECK(std::get<Texts>(column.values()).distinct() == Words{"a", "b", "d"});
  column.append({"b", false});
  column.append({"c", false});
  CHECK(texts(column) == Words{"a", "d", "b", "b", "c"});
  CHECK(std::get<Texts>(column.values()).distinct().size() == 4);
}

TEST_CASE("texts of rows that are gone do not pile up") {
  Column column = of(ValueType::String, {"first"});
  for (int i = 0; i < 1000; ++i) {
    column.append({std::to_string(i), false});
    column.keep(1, {});
    CHECK(std::get<Texts>(column.values()).distinct().size() <= 2);
  }
}
