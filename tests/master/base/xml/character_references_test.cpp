#include "master/base/xml/character_references.h"

#include <string>

#include <catch2/catch.hpp>

using stride::xml::find_bad_character;
using stride::xml::find_bad_reference;

TEST_CASE("references to characters of XML are good") {
  for (const std::string text :
       {"", "&amp;&lt;", "&#9;&#10;&#13;", "&#x20;&#xD7FF;&#xE000;&#xFFFD;", "&#x10000;&#x10fFfF;",
        "&#0000065;", "<!-- &#0; -->", "<![CDATA[&#0;]]>", "<?p &#0;?>", "<!-- ends never &#0;",
        "&apos;&quot;&gt;", "a & b", "a&b", "&;", "<!-- &name; -->", "<![CDATA[&name;]]>"}) {
    CAPTURE(text);
    CHECK_FALSE(find_bad_reference(text));
  }
}

TEST_CASE("the first reference to no character is found") {
  for (const std::string bad :
       {"&#0;", "&#x0;", "&#8;", "&#27;", "&#x1F;", "&#xD800;", "&#xDFFF;", "&#xFFFE;", "&#xFFFF;",
        "&#x110000;", "&#99999999999;", "&#;", "&#x;", "&#12a;", "&#-1;", "&#+65;", "&#65"}) {
    CAPTURE(bad);
    CHECK(find_bad_reference("<a x='" + bad + "'>&#65;</a>") == 6);
  }
  CHECK(find_bad_reference("<!-- &#0; -->&#0;") == 13);
}

TEST_CASE("the first reference to an entity of a document type definition is found") {
  for (const std::string bad : {"&name;", "&Amp;", "&a-b.c:d_1;", "&größe;"}) {
    CAPTURE(bad);
    CHECK(find_bad_reference("<a x='" + bad + "'>&amp;</a>") == 6);
  }
}

TEST_CASE("the first control character that is not in XML is found") {
  CHECK_FALSE(find_bad_character("a\tb\r\nc \x7f ü"));
  for (const char bad : {'\x00', '\x01', '\x08', '\x0b', '\x1b', '\x1f'}) {
    CHECK(find_bad_character(std::string("<a>\n") + bad + "</a>") == 4);
  }
}
