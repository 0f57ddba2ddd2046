#include "master/base/xml/encoding.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "tests/error_of.h"

using namespace stride;
using namespace stride::tests;
using namespace std::string_literals;
using Catch::Contains;

namespace {

const std::string kText = "<?xml version=\"1.0\"?>\n<a>\n\n<b name=\"Gr\u00f6\u00dfe\u20ac\"/></a>";
const std::string kName = "Gr\u00f6\u00dfe\u20ac";

/// kText, in units of this many bytes, of which the first holds the lowest bits or the highest
/// ones.
std::string wide(std::size_t size, bool little_endian, bool mark) {
  std::string bytes;
  std::u32string text = U"<?xml version=\"1.0\"?>\n<a>\n\n<b name=\"Gr\u00f6\u00dfe\u20ac\"/></a>";
  if (mark) text.insert(0, 1, U'\ufeff');
  for (const char32_t c : text) {
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = little_endian ? i : size - 1 - i;
      bytes += static_cast<char>(c >> (8 * byte));
    }
  }
  return bytes;
}

std::string declared(const std::string& encoding, const std::string& name) {
  return "<?xml version='1.0' encoding='" + encoding + "' standalone='yes'?>\n<a name='" + name +
         "'/>";
}

std::string name_in(const std::string& bytes) {
  return xml::Document::parse(bytes, "x.xml").root().required("name");
}

}  // namespace

TEST_CASE("texts of wide characters are read, with a byte order mark or without") {
  const std::size_t size = GENERATE(2, 4);
  const bool little_endian = GENERATE(true, false);
  const bool mark = GENERATE(true, false);
  const std::string bytes = wide(size, little_endian, mark);
  CHECK(xml::decode(bytes, "x.xml").text == kText);
  const auto document = xml::Document::parse(bytes, "x.xml");
  CHECK(document.warnings().empty());
  const xml::Element b = *document.root().child("b");
  CHECK(b.required("name") == kName);
  CHECK(b.where().line == 4);
}

TEST_CASE("the declared encoding is the one that is read, and the text declares UTF-8") {
  CHECK(name_in(declared("ISO-8859-1",
                         "Gr\xf6\xdf"
                         "e")) == "Gr\u00f6\u00dfe");
  CHECK(name_in(declared("iso-8859-15", "\xa4")) == "\u20ac");
  CHECK(name_in(declared("Windows-1252", "\x80")) == "\u20ac");
  CHECK(name_in(declared("Shift_JIS", "\x83\x82\x83\x66\x83\x8b")) == "\u30e2\u30c7\u30eb");
  CHECK(name_in(declared("GB18030", "\xc4\xa3\xd0\xcd")) == "\u6a21\u578b");
  CHECK(name_in(declared("utf8", "\u00f6")) == "\u00f6");
  CHECK(name_in(declared("US-ASCII", "o")) == "o");
  CHECK(name_in(declared("UTF-16", "\u00f6")) == "\u00f6");  // evidently not UTF-16
  CHECK(name_in("\xef\xbb\xbf" + declared("ISO-8859-1", "\u00f6")) == "\u00f6");
  CHECK(xml::decode(declared("ISO-8859-1", "\xf6"), "x.xml").text == declared("UTF-8", "\u00f6"));
  CHECK(xml::decode(declared("ISO-8859-1", "\xf6"), "x.xml").warning.empty());
}

TEST_CASE("what is in UTF-8 stays as it is, to the byte") {
  for (const std::string& text : {declared("utf-8", "\u00f6"), "\xef\xbb\xbf"s + kText, kText,
                                  "<a encoding='latin1'/>"s, "<?xml version='1.0' encoding="s}) {
    CHECK(xml::decode(text, "x.xml").text == text);
  }
}

TEST_CASE("wrongly declared bytes are taken for Windows-1252, with a warning for the first line") {
  const std::string bytes =
      "<?xml version='1.0' encoding='UTF-8'?>\n<a\nname='\u00f6 \xf6 \x80 \x81'/>";
  const auto document = xml::Document::parse(bytes, "x.xml");
  CHECK(document.root().required("name") == "\u00f6 \u00f6 \u20ac \ufffd");
  CHECK_THAT(document.warnings().at(0),
             Contains("x.xml:3: ") && Contains("no UTF-8") && Contains("taken for Windows-1252"));
}

TEST_CASE("bytes that are none of the declared encoding are replaced, with a warning") {
  const auto document =
      xml::Document::parse(declared("Shift_JIS", "\x83\x82 \xff\xff \x83\x66"), "x.xml");
  CHECK(document.root().required("name") == "\u30e2 \ufffd\ufffd \u30c7");
  CHECK_THAT(document.warnings().at(0), Contains("x.xml:2: ") && Contains("shift_jis"));
  const std::string half = wide(2, true, true) + "x";
  CHECK_THAT(xml::decode(half, "x.xml").warning, Contains("x.xml:4: ") && Contains("UTF-16LE"));
  const std::string lone_surrogate = "<\0a\0\0\xd8/\0>\0"s;
  CHECK(xml::decode(lone_surrogate, "x.xml").text == "<a\ufffd/>");
}

TEST_CASE("an encoding that iconv does not know is refused, also with its settings") {
  const std::string name = GENERATE("klingon", "", "UTF-8//IGNORE", "ISO-8859-1//TRANSLIT", "../x");
  CHECK_THAT(error_of([&] { xml::decode(declared(name, "x"), "x.xml"); }),
             Contains("x.xml:1: the encoding '") && Contains("' is not known") &&
                 Contains("with the encoding UTF-8"));
}
