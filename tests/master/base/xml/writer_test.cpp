#include "master/base/xml/writer.h"

#include <catch2/catch.hpp>

using stride::xml::Writer;

TEST_CASE("elements, attributes and texts are written with the escapes of XML") {
  Writer xml;
  xml.open("a");
  xml.attribute("name", "1 < 2 & \"3\"");
  xml.open("b");
  xml.text("<&>");
  xml.close();
  xml.open("c");
  xml.close();
  xml.close();
  CHECK(xml.document() ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<a name=\"1 &lt; 2 &amp; &quot;3&quot;\">\n"
        "    <b>&lt;&amp;&gt;</b>\n"
        "    <c/>\n"
        "</a>\n");
}

TEST_CASE("what XML cannot hold is replaced") {
  Writer xml;
  xml.open("a");
  xml.attribute("x", std::string("1\x01") + "2");
  xml.text("a\tb\nc\x1b[0m");
  xml.close();
  CHECK(xml.document() ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"1\uFFFD2\">a\tb\nc\uFFFD[0m</a>\n");
}

TEST_CASE("what is not valid UTF-8, and what is not a character of XML, is replaced") {
  const auto [text, expected] = GENERATE(table<std::string, std::string>({
      {"a\xff=1", "a\uFFFD=1"},
      {"\xef\xbf\xbe|\xef\xbf\xbf|\xef\xbf\xbd", "\uFFFD|\uFFFD|\uFFFD"},
      {"cut \xe2\x82", "cut \uFFFD\uFFFD"},
      {"\xed\xa0\x80", "\uFFFD\uFFFD\uFFFD"},
      {std::string("a\0b", 3), "a\uFFFDb"},
      {"\u20AC \U0001F600", "\u20AC \U0001F600"},
  }));
  Writer xml;
  xml.open("a");
  xml.attribute("x", text);
  xml.text(text);
  xml.close();
  CHECK(xml.document() == "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"" + expected + "\">" +
                              expected + "</a>\n");
}
