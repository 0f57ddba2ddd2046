#include "units/xml/text.h"

#include <catch2/catch.hpp>

TEST_CASE("Numbers are as short as they can be, and whole where they are") {
  CHECK(xml::shortest(14.2) == "14.2");
  CHECK(xml::shortest(24) == "24");
  CHECK(xml::shortest(-0.5) == "-0.5");
  CHECK(xml::shortest(0.1 + 0.2) == "0.30000000000000004");
}

TEST_CASE("Words are in quotation marks") {
  CHECK(xml::quoted_list({"on", "off"}) == "'on', 'off'");
  CHECK(xml::quoted_list({}).empty());
}
