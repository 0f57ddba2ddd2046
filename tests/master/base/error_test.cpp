#include "master/base/error.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;

TEST_CASE("an error names file, line, unit, variable and time, and gives a hint") {
  const Error error(Error::Kind::Run, {{"a.ssd", 7}, "sensor", "led", time_from_seconds(1.5)},
                    "it broke", "mend it");
  CHECK(std::string(error.what()) ==
        "a.ssd:7: unit 'sensor', variable 'led', at 1.5 s: it broke\n  hint: mend it");
}

TEST_CASE("an error leaves out what is not known") {
  CHECK(std::string(Error(Error::Kind::Input, {}, "no").what()) == "no");
  CHECK(std::string(Error(Error::Kind::Input, {{"a.ssd", 0}, {}, {}, {}}, "no").what()) ==
        "a.ssd: no");
}

TEST_CASE("names in an error make no lines, and its length is limited") {
  const std::string long_name(100'000, 'x');
  const Error error(Error::Kind::Input, {{"a\nb.ssd", 7}, "u\nstride: error: v", long_name, {}},
                    "'x\nstride: error: y'");
  const std::string text = error.what();
  CHECK(text.substr(0, 47) == "a\\x0ab.ssd:7: unit 'u\\x0astride: error: v', var");
  CHECK(text.find("\nstride") == std::string::npos);
  CHECK(text.size() < 1000);
  CHECK(error.context().variable == long_name);
}

TEST_CASE("a list of names is shortened where that leaves out two or more") {
  const std::vector<std::string> names{"a", "b", "c", "d"};
  CHECK(abridged({}, 2).empty());
  CHECK(abridged(names, 4) == "a, b, c, d");
  CHECK(abridged(names, 3) == "a, b, c, d");
  CHECK(abridged(names, 2) == "a, b and 2 more");
}

TEST_CASE("NUL does not end the text of an error") {
  const Error error(Error::Kind::Input, {}, std::string("found 'a\0b', which is wrong", 26));
  CHECK(std::string(error.what()) == "found 'a\\x00b', which is wron");
}
