#include "units/reader/idle.h"

#include <string>

#include <catch2/catch.hpp>

#include "tests/units/reader/programs.h"

using namespace reader;
using namespace reader::tests;
using stride::Duration;
using stride::Time;

namespace {

/// Two axes at rest; both move from 2 s to 3 s, and the second also from 5 s to 6 s.
Program movements() {
  Program program;
  program.axes = {"shoulder", "elbow"};
  program.waypoints = {{at(1), {0.5, 0.1}},
                       {at(2), {0.5, 0.1}},
                       {at(3), {1.0, 0.2}},
                       {at(5), {1.0, 0.2}},
                       {at(6), {1.0, 0.3}}};
  return program;
}

}  // namespace

TEST_CASE("Axes rest until the waypoint from which one of them moves") {
  const Program p = movements();
  CHECK(axes_rest_until(p, at(0)) == at(2));
  CHECK(axes_rest_until(p, at(1.5)) == at(2));
  CHECK(axes_rest_until(p, at(3)) == at(5));
  CHECK(axes_rest_until(p, at(4.9)) == at(5));
  CHECK(axes_rest_until(p, at(6)) == Time::max());
  CHECK(axes_rest_until(p, at(100)) == Time::max());
}

TEST_CASE("Axes that move do not rest") {
  const Program p = movements();
  for (const double time : {2.0, 2.5, 5.0, 5.999}) {
    CHECK(axes_rest_until(p, at(time)) == at(time));
  }
  CHECK(axes_rest_until(p, at(3) - kPicosecond) == at(3) - kPicosecond);
}

TEST_CASE("Axes that tremble never rest") {
  Program p = movements();
  p.variation.tremor = {0.0, 0.0};
  CHECK(axes_rest_until(p, at(0)) == at(2));
  p.variation.tremor = {0.0, 1e-6};
  CHECK(axes_rest_until(p, at(0)) == at(0));
}

TEST_CASE("A robot without axes rests for ever") {
  CHECK(axes_rest_until(program_with(""), at(0)) == Time::max());
}

TEST_CASE("A reader is idle until its antenna, a command or the end of one is due") {
  Reader reader(program_with(R"(<command at="2" name="read_temperature" timeout="0.05"/>)"));
  CHECK(idle_until(reader, at(0)) == at(1));
  CHECK(idle_until(reader, at(1)) == at(2));
  CHECK(idle_until(reader, at(2)) == at(2));  // due
  REQUIRE(reader.transmit(at(2)));
  CHECK(idle_until(reader, at(2)) == reader.state().give_up_at);
  reader.advance(reader.state().give_up_at);
  CHECK(idle_until(reader, at(3)) == at(9));
  CHECK(idle_until(reader, at(9)) == Time::max());
}

TEST_CASE("A reader whose axes move first is idle until then") {
  Program p = movements();
  p.antenna = {{at(1), at(9), 0.5}};
  const Reader reader(p);
  CHECK(idle_until(reader, at(1)) == at(2));
  CHECK(idle_until(reader, at(3)) == at(5));
  CHECK(idle_until(reader, at(6)) == at(9));
}
