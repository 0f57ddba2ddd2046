#include "units/ground_truth/quantity.h"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using ground_truth::parse_quantity;

TEST_CASE("a quantity has a unit, and its differences have one") {
  const auto quantity =
      parse_quantity(R"(<quantity version="1" unit="degC" difference="K"/>)", "q.xml");
  CHECK(quantity.unit == "degC");
  CHECK(quantity.difference == "K");
  CHECK(parse_quantity(R"(<quantity difference="" unit="" version="1"></quantity>)", "q.xml")
            .unit.empty());
}

TEST_CASE("mistakes are reported with file and line") {
  const auto check = [](const std::string& text, const std::string& message) {
    CAPTURE(text);
    CHECK_THROWS_WITH(parse_quantity(text, "q.xml"), StartsWith("q.xml:") && Contains(message));
  };
  check("<quantity", "expected well-formed XML");
  check("<amount/>", "q.xml:1: <amount>: expected <quantity> as the root");
  check("\n<quantity unit='m' difference='m'/>",
        "q.xml:2: <quantity>: expected the attribute 'version'");
  check("<quantity version='2' unit='m' difference='m'/>", "version=\"2\" is not known");
  check("<quantity version='1' difference='m'/>", "expected the attribute 'unit'");
  check("<quantity version='1' unit='m'/>", "expected the attribute 'difference'");
  check("<quantity version='1' unit='m' difference='m' units='m'/>", "unknown attribute 'units'");
  check("<quantity version='1' unit='m' difference='m'>m</quantity>", "<quantity>: ");
  check("<quantity version='1' unit='m' difference='m'><m/></quantity>",
        "<m>: expected no element");
}

TEST_CASE("a file that is not there") {
  CHECK_THROWS_WITH(ground_truth::read_quantity("/nowhere/quantity.xml"),
                    StartsWith("/nowhere/quantity.xml: cannot be read"));
}
