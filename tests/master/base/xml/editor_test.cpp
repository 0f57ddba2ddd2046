#include "master/base/xml/editor.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"

using namespace stride::xml;

TEST_CASE("Elements are found in document order, whatever is between them") {
  const std::string text =
      "<?xml version='1.0'?><!-- <no/> --><a x='>' y=\"</a>\"><b/><![CDATA[<no>]]><c>t</c ></a>";
  const auto places = element_places(text);
  REQUIRE(places.size() == 3);
  const auto of = [&](std::size_t from, std::size_t to) { return text.substr(from, to - from); };
  CHECK(of(places[0].begin, places[0].start_tag_end) == "<a x='>' y=\"</a>\">");
  CHECK(of(places[0].end_tag, places[0].end) == "</a>");
  CHECK(of(places[1].begin, places[1].end) == "<b/>");
  CHECK(places[1].is_empty_tag);
  CHECK(of(places[2].begin, places[2].end) == "<c>t</c >");
  CHECK(of(places[2].start_tag_end, places[2].end_tag) == "t");
}

TEST_CASE("Children are added with the file's own indentation and line ends") {
  const std::string text =
      "<a>\r\n   <b x='1' />\r\n   <c>\r\n      <d/> <!-- last -->\r\n   </c>\r\n</a>\r\n";
  Editor editor(text);
  editor.prepend_children(1, {"<new>\n\t<x/>\n</new>"});
  editor.append_children(2, {"<e/>", "<f/>"});
  editor.insert_behind(2, "<g/>");
  editor.add_attribute(0, "y", "1 < \"2\"");
  CHECK(editor.result() ==
        "<a y=\"1 &lt; &quot;2&quot;\">\r\n   <b x='1'>\r\n      <new>\r\n         <x/>\r\n      "
        "</new>\r\n   </b>\r\n   <c>\r\n      <d/> <!-- last -->\r\n      <e/>\r\n      <f/>\r\n   "
        "</c>\r\n   <g/>\r\n</a>\r\n");
}

TEST_CASE("The value of an attribute is replaced, and nothing else") {
  const std::string text = "<a x = 'y=\"1\"'\n  y=\"2\" xy='3'/>";
  const auto with = [&](const char* name) {
    Editor editor(text);
    editor.set_attribute(0, name, "<&>");
    return editor.result();
  };
  CHECK(with("x") == "<a x = \"&lt;&amp;&gt;\"\n  y=\"2\" xy='3'/>");
  CHECK(with("y") == "<a x = 'y=\"1\"'\n  y=\"&lt;&amp;&gt;\" xy='3'/>");
  CHECK(with("xy") == "<a x = 'y=\"1\"'\n  y=\"2\" xy=\"&lt;&amp;&gt;\"/>");
}

TEST_CASE("Elements on one line stay well-formed") {
  const std::string text = "<a><b></b><c><d/></c></a>";
  Editor first(text);
  first.prepend_children(1, {"<x/>"});
  CHECK(first.result() == "<a><b>\n  <x/>\n</b><c><d/></c></a>");
  Editor second(text);
  second.prepend_children(2, {"<x/>"});
  CHECK(second.result() == "<a><b></b><c>\n  <x/>\n  <d/></c></a>");
  Editor third(text);
  third.append_children(2, {"<x/>"});
  CHECK(third.result() == "<a><b></b><c><d/>\n  <x/>\n</c></a>");
  Editor none(text);
  none.prepend_children(1, {});
  none.append_children(2, {});
  CHECK(none.result() == text);
}

TEST_CASE("A value with control characters and markup is read as it was written") {
  const std::string value = "a\r\nb\tc\rd <&> \"e\" 'f'";
  const std::string text = "<a x='1'/>";
  Editor editor(text);
  editor.add_attribute(0, "y", value);
  editor.set_attribute(0, "x", value);
  const auto document = Document::parse(editor.result(), "");
  CHECK(document.root().attribute("x") == value);
  CHECK(document.root().attribute("y") == value);
}

TEST_CASE("A text of one long line is edited in a time that grows as its length") {
  constexpr std::size_t kElements = 200'000;  // hours, if each edit reads the line
  std::string text = "<a>";
  for (std::size_t i = 0; i < kElements; ++i) text += "<b><c/></b>";
  text += "</a>";
  Editor editor(text);
  for (std::size_t i = 0; i < kElements; ++i) {
    editor.append_children(2 * i + 1, {"<d/>"});
    editor.prepend_children(2 * i + 2, {"<e/>"});
  }
  const std::string result = editor.result();
  CHECK(result.starts_with("<a><b><c>\n  <e/>\n</c>\n  <d/>\n</b><b>"));
}
