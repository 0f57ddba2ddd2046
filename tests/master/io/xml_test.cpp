#include "master/io/xml.h"

#include <catch2/catch.hpp>

#include "tests/master/io/support.h"

using namespace stride::io;
using Catch::Contains;

namespace {

std::string error_in(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.write("x.ssd", text);
  return error_of([&] { XmlDocument document(file); });
}

}  // namespace

TEST_CASE("A file that cannot be read is named, with the reason") {
  const TemporaryFolder folder;
  const auto missing = folder / "missing.ssd";
  CHECK_THAT(error_of([&] { XmlDocument document(missing); }),
             Contains(missing.string() + ": the file does not exist"));
  CHECK_THAT(error_of([&] { XmlDocument document(folder / ""); }),
             Contains("this is a folder, expected a file"));
  CHECK_THAT(error_of([&] { XmlDocument document("/proc/self/mem"); }),
             Contains("/proc/self/mem: cannot read the file"));
}

TEST_CASE("What is not well-formed is refused with its line") {
  CHECK_THAT(error_in("<a>\n<b>\n</a>"),
             Contains("x.ssd:2: this is not well-formed XML: an element without its end tag") &&
                 Contains("missing end tag"));
  CHECK_THAT(error_in("<a x=1/>"),
             Contains("x.ssd:1: this is not well-formed XML: a malformed or doubled attribute"));
  CHECK_THAT(error_in("<a x='1' x='2'/>"), Contains("a malformed or doubled attribute"));
  CHECK_THAT(error_in("<a>\n<!-- ends never"), Contains("x.ssd:2") && Contains("a comment"));
  CHECK_THAT(error_in("stride"), Contains("text where a tag is expected") || Contains("no XML"));
  CHECK_THAT(error_in(""), Contains("the file holds nothing"));
  CHECK_THAT(error_in("<!-- nothing -->"), Contains("the file holds no XML element"));
  CHECK_THAT(error_in("<a/>\n<b/>"), Contains("x.ssd:2: a second root element <b>"));
  CHECK_THAT(error_in(std::string("<a>\0</a>", 8)), Contains("this is no text in UTF-8"));
  CHECK_THAT(error_in("\xff\xfe<"), Contains("this is no text in UTF-8"));
  CHECK_THAT(error_in("<?xml version='1.0' encoding='ISO-8859-1'?><a/>"),
             Contains("the encoding 'iso-8859-1' is not read"));
  CHECK(error_in("<?xml version='1.0' encoding='utf-8'?><a encoding='x'/>") == "(no error)");
  CHECK(error_in("<?xml version='1.0'?><a encoding='x'/>") == "(no error)");
  CHECK_THAT(error_in("PK\x03\x04..."), Contains("this is a packed archive") && Contains("unpack"));
}

TEST_CASE("Namespaces are resolved, whatever the prefixes") {
  const TemporaryFolder folder;
  const XmlDocument document(folder.write(
      "x.xml",
      "<a xmlns='one' xmlns:p='two'>\n<p:b/><b/><c xmlns='three' xmlns:p='four'><p:d/></c>"
      "<q:e/></a>"));
  const XmlElement root = document.root();
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
  const TemporaryFolder folder;
  const XmlDocument document(folder.write(
      "x.xml",
      "<a xmlns='one' siez='1' id='i' p:q='1' empty='' yes='maybe'>\n<stpe/><b xmlns='x'/>"
      "<twice/><twice/></a>"));
  const XmlElement root = document.root();
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
  CHECK_THAT(error_of([&] { root.flag("yes", true); }), Contains("neither true nor false"));
  CHECK_THAT(error_of([&] { root.child({"one", "twice"}); }), Contains("a second <twice> in <a>"));
}
