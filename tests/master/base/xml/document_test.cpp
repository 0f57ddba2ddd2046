#include "master/base/xml/document.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string error_in(const std::string& text) {
  return error_of([&] { xml::Document::parse(text, "x.ssd"); });
}

}  // namespace

TEST_CASE("A file that cannot be read is named, with the reason") {
  const std::filesystem::path missing = "/absent/missing.ssd";
  CHECK_THAT(error_of([&] { xml::Document document(missing); }),
             Contains(missing.string() + ": the file does not exist"));
  CHECK_THAT(error_of([&] { xml::Document document("/"); }),
             Contains("this is a folder, not a regular file"));
  CHECK_THAT(error_of([&] { xml::Document document("/proc/self/mem"); }),
             Contains("/proc/self/mem: cannot read the file"));
}

TEST_CASE("What is not well-formed is refused with its line") {
  CHECK_THAT(error_in("<a>\n<b>\n</a>"),
             Contains("x.ssd:3: this is not well-formed XML: </a>, which ends the element of line "
                      "1, before the end tag of <b> of line 2") &&
                 Contains("hint: write </b> before it"));
  CHECK_THAT(error_in("<a x=1/>"),
             Contains("x.ssd:1: this is not well-formed XML: a malformed or doubled attribute"));
  CHECK_THAT(error_in("<a x='1' x='2'/>"), Contains("a malformed or doubled attribute"));
  CHECK_THAT(error_in("<a>\n<!-- ends never"), Contains("x.ssd:2") && Contains("a comment"));
  CHECK_THAT(error_in("<a>\n<b x='&#0;'/></a>"),
             Contains("x.ssd:2: this is not well-formed XML: '&#0;' is no character of XML"));
  CHECK_THAT(error_in("<a>\n\n<b x='\x01'/></a>"),
             Contains("x.ssd:3: this is not well-formed XML: the control character \\x01 is no"));
  CHECK_THAT(error_in("stride"), Contains("text where a tag is expected") || Contains("no XML"));
  CHECK_THAT(error_in(""), Contains("the file holds nothing"));
  CHECK_THAT(error_in("<!-- nothing -->"), Contains("the file holds no XML element"));
  CHECK_THAT(error_in("<a/>\n<b/>"), Contains("x.ssd:2: a second root element <b>"));
  CHECK_THAT(error_in(std::string("<a>\0</a>", 8)), Contains("x.ssd: there is a NUL character"));
  CHECK(error_in("<?xml version='1.0' encoding='utf-8'?><a encoding='x'/>") == "(no error)");
  CHECK(error_in("<?xml version='1.0'?><a encoding='x'/>") == "(no error)");
  CHECK_THAT(error_in("PK\x03\x04..."), Contains("this is a packed archive") && Contains("unpack"));
}

TEST_CASE("A file that was cut off is refused where it ends") {
  const std::string whole = "<a>\n<b x='1'>\n<c y='2'>text</c>\n</b>\n</a>";
  for (std::size_t size = 1; size < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    const auto last = std::count(cut.begin(), cut.end(), '\n') + (cut.ends_with('\n') ? 0 : 1);
    CHECK_THAT(error_in(cut), Contains("x.ssd:" + std::to_string(last) + ": this is not") &&
                                  Contains("the file ends"));
  }
  CHECK_THAT(error_in(whole.substr(0, 14)),
             Contains("before the end tag of <b> of line 2") && Contains("2 elements"));
}

TEST_CASE("A mistake within a tag that comes before one of the tags is the one reported") {
  CHECK_THAT(error_in("<a>\n<b x=1/>\n<c>\n</a>"), Contains("x.ssd:2: ") && Contains("attribute"));
  CHECK_THAT(error_in("<a>\n<b/ >\n<c>\n</a>"), Contains("x.ssd:2: ") && Contains("malformed tag"));
  CHECK_THAT(error_in("<a>\n<b>\n<!-- <c>"), Contains("x.ssd:3: ") && Contains("a comment"));
}

TEST_CASE("Processing instructions are left out, wherever they are") {
  const std::string text =
      "<?xml version='1.0'?>\n<!-- <?x?> -->\n<?tool a='<b>'\n?>\n<a t='<?no?>'><?b "
      "?><c/><![CDATA[<?d?>]]>"
      "<?xml-stylesheet href='x'?>\n</a><?end?>";
  const auto document = xml::Document::parse(text, "x.ssd");
  CHECK(document.text() == text);
  CHECK(document.root().attribute_or("t") == "<?no?>");
  CHECK(document.root().where().line == 5);
  CHECK(document.root().children().size() == 1);
  CHECK_THAT(error_in("<a>\n<?b"), Contains("x.ssd:"));
  CHECK_THAT(error_in("<a>\n<?xml version='1.0'?></a>"),
             Contains("x.ssd:2: ") && Contains("a declaration"));
}

TEST_CASE("NUL characters behind the end of a document are ignored, with a warning") {
  const auto document = xml::Document::parse(std::string("<a/>\n\0\0\n", 8), "x.ssd");
  CHECK(document.text() == "<a/>\n");
  REQUIRE(document.warnings().size() == 1);
  CHECK_THAT(document.warnings()[0], Contains("x.ssd: ") && Contains("NUL"));
}

TEST_CASE("A document's elements stay valid when it is moved") {
  xml::Document first = xml::Document::parse("<a>\n<b/></a>", "x.xml");
  const xml::Element b = *first.root().child("b");
  const xml::Document second = std::move(first);
  CHECK(b.where().file == "x.xml");
  CHECK(b.where().line == 2);
  CHECK(second.root().child("b")->tag() == "<b>");
  CHECK(second.text() == "<a>\n<b/></a>");
}

TEST_CASE("an end tag is not an element") {
  CHECK_THROWS_WITH(xml::Document::parse("<a></b c='1'/></a>", "x.xml"),
                    Contains("x.xml: this is not well-formed XML") && Contains("'/' at its end"));
  CHECK_NOTHROW(xml::Document::parse("<a><!-- </b/> --><![CDATA[</c/>]]><d/></a>", "x.xml"));
}

TEST_CASE("An element has a limited number of attributes") {
  const auto element = [](int attributes, const std::string& text) {
    std::string tag = "<a>\n<!-- <c x='1' -->\n<b";
    for (int i = 0; i < attributes; ++i) tag += " x" + std::to_string(i) + "=\"'<>'\"";
    return tag + ">" + text + "</b></a>";
  };
  std::string quotes;
  for (int i = 0; i < 3000; ++i) quotes += "it's ";
  CHECK(xml::Document::parse(element(1000, quotes), "x.ssd").root().children().size() == 1);
  CHECK_THAT(error_in(element(1001, "")),
             Contains("x.ssd:3: an element with 1001 attributes; 1000 at most are read"));
}

TEST_CASE("Elements that are too deep are no mistake of XML, but are not read") {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "<a>";
  for (int i = 0; i < 200; ++i) text += "</a>";
  CHECK_THAT(error_in(text), Contains("x.ssd:1: more than 100 elements inside each other") &&
                                 !Contains("well-formed"));
}

TEST_CASE("known prefixes may be used without a declaration, with a warning") {
  constexpr xml::Prefix known[] = {{"a", "urn:a"}, {"b", "urn:b"}};
  const auto document = xml::Document::parse(
      "<a:x>\n<b:y xmlns:b='urn:other'><b:z/></b:y>\n<a:w/></a:x>", "x.ssv", known);
  CHECK(document.root().is("urn:a", "x"));
  CHECK(document.root().children()[0].is("urn:other", "y"));
  REQUIRE(document.warnings().size() == 1);
  CHECK_THAT(document.warnings()[0],
             Contains("x.ssv:1: the prefix 'a' of <a:x> is not declared") && Contains("urn:a"));
  const auto plain = xml::Document::parse("<a:x/>", "x.ssv");
  CHECK_THAT(error_of([&] { plain.root().name(); }), Contains("the prefix 'a'"));
}

TEST_CASE("known namespaces may be written with https, or a slash at the end, with a warning") {
  constexpr xml::Prefix known[] = {{"a", "http://a.org/A"}};
  const auto document = xml::Document::parse(
      "<a:x xmlns:a='https://a.org/A'>\n<y xmlns='http://a.org/A/'/>"
      "<z xmlns='https://a.org/a'/></a:x>",
      "x.ssv", known);
  CHECK(document.root().is("http://a.org/A", "x"));
  CHECK(document.root().children()[0].is("http://a.org/A", "y"));
  CHECK(document.root().children()[1].is("https://a.org/a", "z"));
  REQUIRE(document.warnings().size() == 2);
  CHECK_THAT(document.warnings()[1],
             Contains("x.ssv:2: xmlns=\"http://a.org/A/\" is taken for http://a.org/A"));
}

TEST_CASE("An entity that the document defines itself is refused, not taken as text") {
  const std::string text = "<!DOCTYPE a [<!ENTITY n 'motor'>]>\n<a>\n<b x='&n;'/></a>";
  CHECK_THAT(error_in(text), Contains("x.ssd:3: '&n;' is an entity that only a document type") &&
                                 Contains("write what it stands for"));
  CHECK_THAT(error_in("<a x='&nope;'/>"), Contains("x.ssd:1: '&nope;' is an entity"));
}
