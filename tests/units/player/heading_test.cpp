#include "units/player/heading.h"

#include <catch2/catch.hpp>

using namespace player;
using Catch::Contains;

TEST_CASE("a heading is a name, a unit of measure and what the values are") {
  const Heading plain = parse_heading("speed");
  CHECK(plain.name == "speed");
  CHECK(plain.unit.empty());
  CHECK(!plain.type);
  CHECK(!plain.course);

  const Heading whole = parse_heading("car.speed [km/h]: Float32 hold");
  CHECK(whole.name == "car.speed");
  CHECK(whole.unit == "km/h");
  CHECK(whole.type == Type::Float32);
  CHECK(whole.course == Course::Hold);
}

TEST_CASE("the words of a heading have any order, and one of them is enough") {
  const Heading both = parse_heading("frame.data:event Binary");
  CHECK(both.type == Type::Binary);
  CHECK(both.course == Course::Event);
  CHECK(parse_heading("gear: Int8").type == Type::Int8);
  CHECK(parse_heading("level [V]:linear").course == Course::Linear);
}

TEST_CASE("what is in quotes, and an index of an array, belongs to the name") {
  CHECK(parse_heading("'a: b'").name == "'a: b'");
  CHECK(parse_heading("'a: b' [m]: Int8").name == "'a: b'");
  const Heading element = parse_heading("pose[1,2] [m]");
  CHECK(element.name == "pose[1,2]");
  CHECK(element.unit == "m");
  CHECK(parse_heading("pose[1]").unit.empty());
}

TEST_CASE("a heading that is spelt otherwise is refused with what was meant") {
  const std::pair<const char*, const char*> kMistakes[] = {
      {"x: int", "'int' behind the colon is neither a type nor a course; did you mean 'Int32'?"},
      {"x: float64", "did you mean 'Float64'?"},
      {"x: Bool hold", "did you mean 'Boolean'?"},
      {"x: STRING", "did you mean 'String'?"},
      {"x: Linear", "did you mean 'linear'?"},
      {"x: Float64 held", "did you mean 'hold'?"},
      {"x: furlong", "expected NAME [UNIT]: TYPE COURSE"},
      {"x: Enumeration", "'Enumeration' behind the colon is neither"},
      {"x: Float64 Float32", "'Float32' is a second type; expected one"},
      {"x: hold linear", "'linear' is a second course; expected one"},
      {"x[m/s]", "did you mean 'x [m/s]'?"},
      {"x (m/s)", "did you mean 'x [m/s]'?"},
      {"x(m/s)", "did you mean 'x [m/s]'?"},
      {"a b",
       "expected parts of letters, digits and '_', joined by dots, or anything else in "
       "single quotes: 'a b'"},
      {"2nd", "in single quotes: '2nd'"},
      {"x [", "in single quotes: 'x ['"},
      {"'", "is not a name of FMI"},
      {"time", "'time' is the name of the first column"},
      {"time [ms]", "'time' is the name of the first column"},
  };
  for (const auto& [text, expected] : kMistakes) {
    CHECK_THROWS_WITH(parse_heading(text), Contains(expected));
  }
}

TEST_CASE("a heading without a name is refused") {
  CHECK_THROWS_WITH(parse_heading(" "), Contains("no name"));
  CHECK_THROWS_WITH(parse_heading(": Int32"), Contains("no name"));
}

TEST_CASE("a heading for the time in another form is told in this one") {
  const std::pair<const char*, const char*> kForms[] = {
      {"time (s)", "'time [s]'"},  {"TIME", "'time'"},         {"t", "'time'"},
      {"Time[ms]", "'time [ms]'"}, {"time_sec", "'time [s]'"}, {"time [hours]", "'time [h]'"},
      {"seconds", "'time [s]'"}};
  for (const auto& [text, meant] : kForms) {
    INFO(text);
    CHECK_THROWS_WITH(parse_time_heading(text), Contains(std::string("did you mean ") + meant));
  }
  CHECK_THROWS_WITH(parse_time_heading("time [m]"), !Contains("did you mean"));
}

TEST_CASE("the first column is the time, in a unit of time") {
  CHECK(parse_time_heading("time") == 1'000'000'000'000);
  CHECK(parse_time_heading("Time [ms]") == 1'000'000'000);
  CHECK(parse_time_heading("time [h]") == 3'600'000'000'000'000);
  for (const char* text : {"t", "time [m]", "", "speed"}) {
    CHECK_THROWS_WITH(parse_time_heading(text), Contains("expected 'time', in seconds"));
  }
}
