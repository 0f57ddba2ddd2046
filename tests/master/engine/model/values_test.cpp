#include "master/engine/model/values.h"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "master/base/state_archive.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

Variable variable(ValueType type, std::size_t size = 1) {
  Variable row = make_variable("v", 0, type, Causality::Parameter);
  row.size = size;
  return row;
}

std::string reason(const Variable& row, const std::string& text) {
  try {
    parse(row, text);
  } catch (const std::invalid_argument& mistake) {
    return mistake.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("each type is parsed and printed back") {
  const auto round_trip = [](ValueType type, const std::string& text) {
    return element_text(parse(variable(type), text), 0);
  };
  CHECK(round_trip(ValueType::Float64, "0.1") == "0.1");
  CHECK(round_trip(ValueType::Float64, "+1e-3") == "0.001");
  CHECK(round_trip(ValueType::Float32, "0.1") == "0.1");
  CHECK(round_trip(ValueType::Float64, "1e-400") == "0");
  CHECK(round_trip(ValueType::Float64, "-1e-400") == "-0");
  CHECK(round_trip(ValueType::Float32, "1e-60") == "0");
  CHECK(round_trip(ValueType::Int8, "-128") == "-128");
  CHECK(round_trip(ValueType::UInt8, "255") == "255");
  CHECK(round_trip(ValueType::Int64, "-9223372036854775808") == "-9223372036854775808");
  CHECK(round_trip(ValueType::UInt64, "18446744073709551615") == "18446744073709551615");
  CHECK(round_trip(ValueType::Boolean, "1") == "true");
  CHECK(round_trip(ValueType::String, "two words") == "two words");
  CHECK(round_trip(ValueType::Binary, "00FFa5") == "00ffa5");
  CHECK(round_trip(ValueType::Binary, "") == "");
}

TEST_CASE("arrays are separated by blanks and keep their order") {
  const ValueBlock block = parse(variable(ValueType::Int16, 3), " 1  -2\n3 ");
  CHECK(element_text(block, 0) == "1");
  CHECK(element_text(block, 1) == "-2");
  CHECK(element_text(block, 2) == "3");
  CHECK(elements_text(block) == "1 -2 3");
  CHECK(elements_text(block, 1, 2) == "-2 3");
  CHECK(elements_text(block, 1, 0) == "");
}

TEST_CASE("an enumeration takes names and numbers") {
  Variable row = variable(ValueType::Enumeration);
  row.items = {{"off", 0}, {"on", 7}};
  CHECK(element_text(parse(row, "on"), 0) == "7");
  CHECK(element_text(parse(row, "7"), 0) == "7");
  CHECK_THAT(reason(row, "maybe"), Contains("expected one of off (0), on (7)"));
  row.items = {{"eco", 1}, {"1", 2}, {"3", 3}};
  CHECK(element_text(parse(row, "1"), 0) == "2");
  CHECK(element_text(parse_start(row, "1"), 0) == "1");
  CHECK(element_text(parse(row, "2"), 0) == "2");
  CHECK(element_text(parse_start(row, "3"), 0) == "3");
  CHECK_THROWS_WITH(parse_start(row, "4"), Contains("expected one of eco (1), 1 (2), 3 (3)"));
}

TEST_CASE("the name of an item may hold blanks") {
  Variable mode = variable(ValueType::Enumeration);
  mode.items = {{"Option 1", 1}, {"Option 2", 2}, {"off", 3}};
  CHECK(parse(mode, "Option 2").numbers<std::int64_t>()[0] == 2);
  CHECK(parse(mode, " Option  2 ").numbers<std::int64_t>()[0] == 2);
  CHECK_THAT(reason(mode, "Option 3"),
             Contains("expected one of Option 1 (1), Option 2 (2), off (3)"));
  mode.size = 4;
  const ValueBlock modes = parse(mode, "Option 2 off 1 Option 1");
  const auto numbers = modes.numbers<std::int64_t>();
  CHECK(std::vector(numbers.begin(), numbers.end()) == std::vector<std::int64_t>{2, 3, 1, 1});
  mode.items.emplace_back("Option", 4);
  CHECK_THAT(reason(mode, "Option 2 off off"),
             Contains("may be the item 'Option 2' or begin with 'Option'"));
}

TEST_CASE("the error of an invalid value has what was expected") {
  CHECK_THAT(reason(variable(ValueType::Float64), "fast"), Contains("expected a Float64 number"));
  CHECK_THAT(reason(variable(ValueType::Float64), "1 2"), Contains("expected one Float64 value"));
  CHECK_THAT(reason(variable(ValueType::Float64), ""), Contains("expected one Float64 value"));
  CHECK_THAT(reason(variable(ValueType::Float64), "1e400"), Contains("within the range"));
  CHECK_THAT(reason(variable(ValueType::UInt8), "256"), Contains("within the range of UInt8"));
  CHECK_THAT(reason(variable(ValueType::UInt8), "-1"), Contains("expected a UInt8 number"));
  CHECK_THAT(reason(variable(ValueType::Int32), "1.5"), Contains("expected an Int32 number"));
  CHECK_THAT(reason(variable(ValueType::Boolean), "yes"), Contains("expected true or false"));
  CHECK_THAT(reason(variable(ValueType::Binary), "abc"), Contains("even number"));
  CHECK_THAT(reason(variable(ValueType::Binary), "zz"), Contains("hexadecimal"));
  CHECK_THAT(reason(variable(ValueType::Float64, 2), "1"), Contains("2 Float64 values"));
}

TEST_CASE("the state of a block is its elements") {
  ValueBlock texts(ValueType::String, 2);
  texts.strings()[0] = "one";
  ValueBlock bytes(ValueType::Binary, 1);
  bytes.binaries()[0] = {1, 2, 3};
  ValueBlock truths(ValueType::Boolean, 3);
  truths.numbers<bool>()[2] = true;
  ValueBlock numbers(ValueType::Float64, 2);
  numbers.numbers<double>()[1] = std::nan("");
  std::vector<ValueBlock> blocks{texts, bytes, truths, numbers};

  stride::core::StateArchive written;
  for (ValueBlock& block : blocks) persist(written, block);
  stride::core::StateArchive read(written.bytes());
  for (const ValueBlock& block : blocks) {
    ValueBlock copy(block.type(), block.size());
    persist(read, copy);
    if (block.type() == ValueType::Float64) {
      CHECK(std::memcmp(copy.bytes(), block.bytes(), 2 * sizeof(double)) == 0);
    } else {
      CHECK(copy == block);
    }
  }
  read.end();

  stride::core::StateArchive again(written.bytes());
  ValueBlock longer(ValueType::String, 3);
  CHECK_THROWS_AS(persist(again, longer), stride::core::BadState);
}
