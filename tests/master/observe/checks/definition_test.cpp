#include "master/observe/checks/definition.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;

TEST_CASE("both ends of an interval belong to it, exactly") {
  const Window limited = window(1, 2);
  const Duration tick(1);
  CHECK_FALSE(limited.contains(at(1) - tick));
  CHECK(limited.contains(at(1)));
  CHECK(limited.contains(at(2)));
  CHECK_FALSE(limited.contains(at(2) + tick));
  CHECK((limited.is_past(at(2) + tick) && !limited.is_past(at(2))));
  CHECK((limited.has_begun(at(1)) && !limited.has_begun(at(1) - tick)));
}

TEST_CASE("what is not limited goes from the start to the end") {
  CHECK(window({}, {}).contains(at(0)));
  CHECK(window({}, 5).contains(at(0)));
  CHECK(window(5, {}).contains(Time::max()));
  CHECK_FALSE(window({}, {}).is_past(Time::max()));
}

TEST_CASE("in words") {
  CHECK(window({}, {}).text() == "");
  CHECK(window(1, {}).text() == " from 0.001 s");
  CHECK(window({}, 2500).text() == " up to 2.5 s");
  CHECK(window(1, 2500).text() == " from 0.001 s to 2.5 s");
  CHECK(std::string(name(Kind::Eventually)) == "eventually");
  CHECK(std::string(name(Kind::Answer)) == "answer");
}
