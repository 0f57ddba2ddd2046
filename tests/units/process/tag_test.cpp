// Lines of the protocol.
#include <catch2/catch.hpp>

#include <stride/process/tag.h>

using namespace stride::process;
using Catch::Contains;

namespace {

Tag parsed(const std::string& line) {
  static std::string kept;  // which the tag refers to
  kept = line;
  Tag tag;
  tag.parse(kept);
  return tag;
}

}  // namespace

TEST_CASE("a tag has a name and attributes") {
  const Tag tag = parsed(R"( <output name='adc.value' value = "0.5" /> )");
  CHECK(tag.name() == "output");
  REQUIRE(tag.size() == 2);
  CHECK(tag.attribute_name(0) == "name");
  CHECK(tag.attribute_value(0) == "adc.value");
  CHECK(tag.value<double>("value") == 0.5);
  CHECK_FALSE(tag.has("time"));
  CHECK_THROWS_WITH(tag.text("time"), "expected the attribute 'time'");
  CHECK_NOTHROW(tag.allow_only({"value", "name"}));
  CHECK_THROWS_WITH(tag.allow_only({"value"}), "unknown attribute 'name'; expected value");
  CHECK(parsed("<end/>\r\n").size() == 0);
}

TEST_CASE("references are characters") {
  CHECK(parsed(R"(<a b="&lt;&gt;&amp;&quot;&apos;&#10;&#x20AC;&#x1F600;x"/>)").text("b") ==
        "<>&\"'\n€😀x");
  for (const char* bad :
       {"&;", "&#;", "&#x;", "&nbsp;", "&#0;", "&#xD800;", "&#x110000;", "&# 1;"}) {
    CHECK_THROWS_WITH(parsed(std::string("<a b=\"..") + bad + "\"/>"),
                      Contains("column 9: expected a reference"));
  }
  CHECK_THROWS_WITH(parsed("<a b=\"R&D\"/>"),
                    "column 8: expected &amp; in the place of & in a value, "
                    "or a reference");
}

TEST_CASE("what is not a tag is refused where it stops being one") {
  const auto [line, expected] = GENERATE(table<std::string, std::string>({
      {"", "column 1: expected '<'"},
      {"hello", "column 1: expected '<'"},
      {"< a/>", "column 2: expected a name"},
      {"<1/>", "column 2: expected a name"},
      {"<a", "column 3: expected a blank or '/>'"},
      {"<a>", "column 3: expected a blank or '/>'"},
      {"<a/", "column 4: expected '>'"},
      {"<a b/>", "column 5: expected '='"},
      {"<a b=1/>", "column 6: expected a value in quotation marks"},
      {"<a b=\"1/>", "column 7: expected a closing quotation mark"},
      {"<a b=\"1\"c=\"2\"/>", "column 9: expected a blank or '/>'"},
      {"<a b=\"1\" b=\"2\"/>", "column 11: expected no second attribute 'b'"},
      {"<a b=\"<\"/>", "column 7: expected &lt; in the place of < in a value"},
      {"<a b=\"\x01\"/>", "column 7: expected a character of XML in UTF-8"},
      {"<a b=\"\xFF\"/>", "column 7: expected a character of XML in UTF-8"},
      {"<a/><b/>", "column 5: expected the end of the line behind the tag"},
      {"<a></a>", "column 3: expected a blank or '/>'"},
  }));
  CHECK_THROWS_WITH(parsed(line), expected);
}

TEST_CASE("a tag can be read again and again") {
  Tag tag;
  tag.parse(R"(<a b="&lt;" c="2" d="3"/>)");
  CHECK(tag.text("b") == "<");
  tag.parse(R"(<b c="plain"/>)");
  CHECK(tag.size() == 1);
  CHECK(tag.text("c") == "plain");
  CHECK_FALSE(tag.has("b"));
  CHECK_THROWS(tag.parse("<c d=\"1\""));
  tag.parse("<d/>");
  CHECK(tag.size() == 0);
}

TEST_CASE("what is written reads back") {
  const std::string text = "a \"b\" <c> & 'd'\n\r\te €";
  std::string line;
  TagWriter(line, "message")
      .value("name", "x.y")
      .value("time", 14200358702064)
      .value("value", text)
      .end();
  CHECK(line ==
        "<message name=\"x.y\" time=\"14200358702064\" value=\"a &quot;b&quot; &lt;c> &amp; "
        "'d'&#10;&#13;&#9;e €\"/>\n");
  CHECK(parsed(line).text("value") == text);
  CHECK_THROWS_WITH(TagWriter(line, "a").value("b", std::string("\x02")),
                    Contains("a Binary can hold it"));
}
