#include "units/xml/element.h"

#include <string>

#include <catch2/catch.hpp>

#include "units/xml/document.h"

using Catch::Contains;
using xml::Document;
using xml::Element;

namespace {

Document with(const std::string& attributes, const std::string& inside = "") {
  return Document::parse(
      "<list version=\"1\">\n<item " + attributes + ">" + inside + "</item></list>", "x.xml",
      "list");
}

}  // namespace

TEST_CASE("Attributes have types") {
  const Document document =
      with("text=\"a b\" number=\"-2.5e-3\" decimal=\"17\" hexadecimal=\"0xFF\" time=\"0.25\"");
  const Element item = document.root().children().front();
  CHECK(item.text("text") == "a b");
  CHECK(item.number("number") == -2.5e-3);
  CHECK(item.number("none", 4.0) == 4.0);
  CHECK(item.number_within("number", -2.5e-3, 0) == -2.5e-3);
  CHECK(item.whole_number("decimal", 0, 17) == 17);
  CHECK(item.whole_number("hexadecimal", 0, 255) == 255);
  CHECK(item.time("time") == stride::time_from_seconds(0.25));
  CHECK(item.has("text"));
  CHECK_FALSE(item.has("none"));
}

TEST_CASE("A wrong attribute is reported with file, line and element") {
  const Document document = with("number=\"2,5\" time=\"-1\" whole=\"3.5\" large=\"256\"");
  const Element item = document.root().children().front();
  const std::string where = "x.xml:2: <item>: ";
  CHECK_THROWS_WITH(item.text("none"), where + "expected the attribute 'none'");
  CHECK_THROWS_WITH(item.number("number"), Contains(where + "number=\"2,5\" is not a number"));
  CHECK_THROWS_WITH(item.number("number", 1.0), Contains("is not a number"));
  CHECK_THROWS_WITH(item.time("time"), where + "time=\"-1\": expected 0 to 1e15 seconds");
  CHECK_THROWS_WITH(item.whole_number("whole", 0, 9), Contains("a whole number from 0 to 9"));
  CHECK_THROWS_WITH(item.whole_number("large", 0, 255), Contains("a whole number from 0 to 255"));
  CHECK_THROWS_WITH(item.number_within("large", 0, 0.5),
                    where + "large=\"256\": expected 0 to 0.5");
}

TEST_CASE("What must not be there is refused") {
  const auto item = [](const Document& document) { return document.root().children().front(); };
  const Document two = with("a=\"1\" b=\"2\"");
  CHECK_NOTHROW(item(two).allow_only_leaf({"b", "a"}));
  CHECK_THROWS_WITH(item(two).allow_only({"a", "c"}),
                    Contains("unknown attribute 'b': expected 'a', 'c'"));
  CHECK_THROWS_WITH(item(two).allow_only({}), Contains("expected none"));
  CHECK_THROWS_WITH(item(with("", "text")).allow_only({}), Contains("expected no text"));
  const Document nested = with("", "<!-- no matter --><part/>");
  CHECK_NOTHROW(item(nested).allow_only({}));
  CHECK_THROWS_WITH(item(nested).allow_only_leaf({}),
                    Contains("expected no element inside <item>"));
}
