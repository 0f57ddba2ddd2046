#include "master/base/xml/element.h"

#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "tests/error_of.h"

using namespace stride;
using namespace stride::tests;
using Catch::Contains;

TEST_CASE("Namespaces are resolved, whatever the prefixes") {
  const xml::Document document = xml::Document::parse(
      "<a xmlns='one' xmlns:p='two'>\n<p:b/><b/><c xmlns='three' xmlns:p='four'><p:d/></c>"
      "<q:e/></a>",
      "x.xml");
  const xml::Element root = document.root();
  CHECK(root.is("one", "a"));
  const auto children = root.children();
  REQUIRE(children.size() == 4);
  CHECK(children[0].is("two", "b"));
  CHECK(children[0].where().line == 2);
  CHECK(children[1].is("one", "b"));
  CHECK(children[2].is("three", "c"));
  CHECK(children[2].children()[0].is("four", "d"));
  CHECK(children[2].prefix_of("two") == std::nullopt);  // hidden by the inner declaration
  CHECK(children[0].prefix_of("two") == "p");
  CHECK(children[0].prefix_of("one") == "");
  CHECK_THROWS_WITH(children[3].name(), Contains("the prefix 'q' of <q:e> is not declared"));
  CHECK(root.index() == 0);
  CHECK(children[2].children()[0].index() == 4);
  CHECK(children[3].index() == 5);
}

TEST_CASE("Attributes and children that are not known are refused with the nearest name") {
  const xml::Document document = xml::Document::parse(
      "<a xmlns='one' siez='1' id='i' p:q='1' empty='' yes='maybe'>\n<stpe/><b xmlns='x'/>"
      "<twice/><twice/></a>",
      "x.xml");
  const xml::Element root = document.root();
  CHECK_THAT(error_of([&] {
               root.allow_attributes({"size", "empty", "yes"});
             }),
             Contains("x.xml:1: <a> has no attribute 'siez'") && Contains("did you mean 'size'?"));
  CHECK_THAT(error_of([&] {
               root.allow_children({{"one", "step"}, {"one", "b"}});
             }),
             Contains("x.xml:2: <stpe> is not known in <a>") && Contains("did you mean 'step'?"));
  CHECK_THAT(error_of([&] {
               root.allow_children({{"one", "stpe"}, {"one", "b"}});
             }),
             Contains("<b> is in the namespace 'x'") && Contains("it belongs in 'one'"));
  CHECK_THAT(error_of([&] { root.required("none"); }), Contains("<a> needs the attribute 'none'"));
  CHECK_THAT(error_of([&] { root.required("empty"); }), Contains("'empty' of <a> is empty"));
  CHECK_THAT(error_of([&] { root.flag("yes", true); }), Contains("expected true or false"));
  CHECK_THAT(error_of([&] { root.child({"one", "twice"}); }), Contains("a second <twice> in <a>"));
}

TEST_CASE("attributes are read with their defaults") {
  const xml::Document document = xml::Document::parse(
      "<a i=' 3 ' f='0.5' yes='1' no='false' list='1 2  3'><b/><c/><b n='2'/></a>", "unit.xml");
  const xml::Element a = document.root();
  CHECK(a.required_number<int>("i") == 3);
  CHECK(a.number<double>("f") == 0.5);
  CHECK_FALSE(a.number<double>("absent"));
  CHECK(a.attribute_or("absent", "other") == "other");
  CHECK(a.flag("yes"));
  CHECK_FALSE(a.flag("no"));
  CHECK_FALSE(a.flag("absent"));
  CHECK(a.number_list<unsigned>("list") == std::vector<unsigned>{1, 2, 3});
  CHECK(a.children("b").size() == 2);
  CHECK(a.children().size() == 3);
  CHECK(a.child("c")->name() == "c");
  CHECK_FALSE(a.child("d"));
}

TEST_CASE("complaints name file and line") {
  const xml::Document document =
      xml::Document::parse("<a>\n<b i='1.5' f='x' flag='maybe' list='1 two'/>\n</a>", "unit.xml");
  const xml::Element b = *document.root().child("b");
  CHECK_THAT(error_of([&] { b.required("name"); }),
             Contains("unit.xml:2: <b> needs the attribute 'name'"));
  CHECK_THAT(error_of([&] { b.number<int>("i"); }),
             Contains("i=\"1.5\"") && Contains("expected an integer"));
  CHECK_THAT(error_of([&] { b.number<double>("f"); }), Contains("expected a number"));
  CHECK_THAT(error_of([&] { b.flag("flag"); }), Contains("expected true or false"));
  std::vector<std::string> warnings;
  CHECK_THAT(error_of([&] { b.lenient_flag("flag", warnings); }),
             Contains("expected true or false"));
  CHECK_THAT(error_of([&] { b.number_list<int>("list"); }), Contains("list=\"two\""));
}

TEST_CASE("an attribute is known by its namespace, not by its prefix") {
  const xml::Document document = xml::Document::parse(
      "<a xmlns:p='urn:x' xmlns='urn:x' q='0' p:q='1'><b xmlns:r='urn:x' r:q='2'/></a>",
      "unit.xml");
  CHECK(document.root().attribute("urn:x", "q") == "1");
  CHECK(document.root().children()[0].attribute("urn:x", "q") == "2");
  CHECK_FALSE(document.root().attribute("urn:y", "q"));
  CHECK_FALSE(document.root().attribute("urn:x", "absent"));
}

TEST_CASE("a list is split at blanks of any kind") {
  using Words = std::vector<std::string_view>;
  CHECK(xml::split("").empty());
  CHECK(xml::split(" \t\n ").empty());
  CHECK(xml::split("1") == Words{"1"});
  CHECK(xml::split("\n1  22\t333 ") == Words{"1", "22", "333"});
}

TEST_CASE("a number is the whole word and within its type") {
  CHECK(xml::to_number<int>("-7") == -7);
  CHECK(xml::to_number<int>("+7") == 7);
  CHECK(xml::to_number<double>("1e-400") == 0.0);
  CHECK_FALSE(xml::to_number<double>("1e400"));
  CHECK_FALSE(xml::to_number<int>("7x"));
  CHECK_FALSE(xml::to_number<int>(""));
  CHECK_FALSE(xml::to_number<std::uint32_t>("-1"));
  CHECK_FALSE(xml::to_number<std::uint32_t>("4294967296"));
  CHECK(xml::to_number<double>("1e-3") == 1e-3);
  CHECK(xml::to_number<double>("INF") == std::numeric_limits<double>::infinity());
}

TEST_CASE("a flag of other tools is taken with a warning") {
  const auto document =
      xml::Document::parse("<a t='True' f='FALSE' one='1' plain='true'/>", "x.xml");
  const xml::Element a = document.root();
  std::vector<std::string> warnings;
  CHECK(a.lenient_flag("one", warnings));
  CHECK(a.lenient_flag("plain", warnings));
  CHECK_FALSE(a.lenient_flag("absent", warnings));
  CHECK(warnings.empty());
  CHECK(a.lenient_flag("t", warnings));
  CHECK_FALSE(a.lenient_flag("f", warnings));
  CHECK(warnings == std::vector<std::string>{"x.xml:1: t=\"True\" of <a> is taken for true",
                                             "x.xml:1: f=\"FALSE\" of <a> is taken for false"});
}
