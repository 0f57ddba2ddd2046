#include "master/xml/writer.h"

#include <catch2/catch.hpp>

using stride::xml::Writer;

TEST_CASE("elements, attributes and texts, with what XML wants escaped") {
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
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"1?2\">a\tb\nc?[0m</a>\n");
}
