#include "master/fmi/xml.h"

#include <limits>

#include "tests/master/fmi/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

struct Parsed {
  explicit Parsed(const char* text) { REQUIRE(document.Parse(text) == tinyxml2::XML_SUCCESS); }
  fmi::Element root() const { return {*document.RootElement(), file}; }
  tinyxml2::XMLDocument document;
  std::string file = "unit.xml";
};

}  // namespace

TEST_CASE("a list is split at blanks of any kind") {
  using Words = std::vector<std::string_view>;
  CHECK(fmi::split("").empty());
  CHECK(fmi::split(" \t\n ").empty());
  CHECK(fmi::split("1") == Words{"1"});
  CHECK(fmi::split("\n1  22\t333 ") == Words{"1", "22", "333"});
}

TEST_CASE("a number is the whole word and within its type") {
  CHECK(fmi::to_number<int>("-7") == -7);
  CHECK(fmi::to_number<int>("+7") == 7);
  CHECK_FALSE(fmi::to_number<int>("7x"));
  CHECK_FALSE(fmi::to_number<int>(""));
  CHECK_FALSE(fmi::to_number<std::uint32_t>("-1"));
  CHECK_FALSE(fmi::to_number<std::uint32_t>("4294967296"));
  CHECK(fmi::to_number<double>("1e-3") == 1e-3);
  CHECK(fmi::to_number<double>("INF") == std::numeric_limits<double>::infinity());
}

TEST_CASE("attributes are read with their defaults") {
  const Parsed xml("<a i=' 3 ' f='0.5' yes='1' no='false' list='1 2  3'><b/><c/><b n='2'/></a>");
  const fmi::Element a = xml.root();
  CHECK(a.required_number<int>("i") == 3);
  CHECK(a.number<double>("f") == 0.5);
  CHECK_FALSE(a.number<double>("absent"));
  CHECK(a.flag("yes"));
  CHECK_FALSE(a.flag("no"));
  CHECK_FALSE(a.flag("absent"));
  CHECK(a.number_list<unsigned>("list") == std::vector<unsigned>{1, 2, 3});
  CHECK(a.children("b").size() == 2);
  CHECK(a.children().size() == 3);
  CHECK(a.child("c")->name() == "c");
  CHECK_FALSE(a.child("d"));
}

TEST_CASE("an element is known by its namespace, not by its prefix") {
  const Parsed xml("<a xmlns:p='urn:x'><p:b/><b/><c xmlns='urn:x'><b/></c><q:b/></a>");
  const auto children = xml.root().children();
  CHECK(children[0].is("urn:x", "b"));
  CHECK_FALSE(children[0].is("urn:x", "c"));
  CHECK_FALSE(children[0].is("", "b"));
  CHECK(children[1].is("", "b"));
  CHECK_FALSE(children[1].is("urn:x", "b"));
  CHECK(children[2].child("b")->is("urn:x", "b"));
  CHECK_FALSE(children[3].is("urn:x", "b"));
}

TEST_CASE("complaints name file and line") {
  const Parsed xml("<a>\n<b i='1.5' f='x' flag='maybe' list='1 two'/>\n</a>");
  const fmi::Element b = *xml.root().child("b");
  CHECK_THAT(input_error([&] { b.required_text("name"); }),
             Contains("unit.xml:2: <b> has no attribute 'name'"));
  CHECK_THAT(input_error([&] { b.number<int>("i"); }),
             Contains("i=\"1.5\"") && Contains("expected an integer"));
  CHECK_THAT(input_error([&] { b.number<double>("f"); }), Contains("expected a number"));
  CHECK_THAT(input_error([&] { b.flag("flag"); }), Contains("expected true or false"));
  CHECK_THAT(input_error([&] { b.number_list<int>("list"); }), Contains("list=\"two\""));
}

TEST_CASE("an attribute is known by its namespace, not by its prefix") {
  const Parsed xml(
      "<a xmlns:p='urn:x' xmlns='urn:x' q='0' p:q='1'><b xmlns:r='urn:x' r:q='2'/></a>");
  CHECK(xml.root().text("urn:x", "q") == "1");
  CHECK(xml.root().child("b")->text("urn:x", "q") == "2");
  CHECK_FALSE(xml.root().text("urn:y", "q"));
  CHECK_FALSE(xml.root().text("urn:x", "absent"));
}

TEST_CASE("a document is parsed, or the error has its place") {
  const fmi::Document document("<a>\n<b/>\n</a>", "unit.xml");
  CHECK(document.root().child("b")->where().line == 2);
  CHECK_THAT(input_error([] { fmi::Document("<a>\n<b></a>", "unit.xml"); }),
             Contains("unit.xml:2") && Contains("not well-formed: mismatched element"));
  CHECK_THAT(input_error([] { fmi::Document("<!-- nothing -->", "unit.xml"); }),
             Contains("unit.xml") && Contains("the document is empty"));
  CHECK_THAT(input_error([] { fmi::read_text("/absent.xml", "map", "absent.xml"); }),
             Contains("absent.xml") && Contains("the map cannot be read"));
}
