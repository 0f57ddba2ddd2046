#include "master/util/error.h"

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
