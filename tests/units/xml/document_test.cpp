#include "units/xml/document.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

using Catch::Contains;
using xml::Document;

TEST_CASE("A document gives its root, and outlives a move") {
  Document first = Document::parse("<list version=\"1\">\n<item/>\n</list>", "x.xml", "list");
  const Document document = std::move(first);
  CHECK(document.root().name() == "list");
  REQUIRE(document.root().children().size() == 1);
  CHECK_THROWS_WITH(document.root().children().front().fail("no"), "x.xml:2: <item>: no");
}

TEST_CASE("What is no such document is refused with file, line and what was expected") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"", "x.xml:"},
      {"<list version=\"1\">\n<item>", "expected well-formed XML"},
      {"<!-- nothing -->", "x.xml:1: expected <list> as the root"},
      {"\n<lists version=\"1\"/>", "x.xml:2: <lists>: expected <list> as the root"},
      {"<list/>", "expected the attribute 'version'"},
      {"<list version=\"2\"/>", "version=\"2\" is not known: expected 1"},
      {"<list version=\"1\" size=\"3\"/>", "unknown attribute 'size': expected 'version'"},
  }));
  INFO(text);
  CHECK_THROWS_WITH(Document::parse(text, "x.xml", "list"),
                    Contains("x.xml:") && Contains(message));
}

TEST_CASE("A root may have further attributes") {
  const std::string text = "<list version=\"1\" size=\"3\"/>";
  CHECK(Document::parse(text, "x.xml", "list", {"size"}).root().number("size") == 3);
  CHECK_THROWS_WITH(Document::parse(text, "x.xml", "list", {"length"}),
                    Contains("unknown attribute 'size'"));
}

TEST_CASE("A file is read, and one that is not there is named") {
  CHECK_THROWS_WITH(
      Document::load("/nowhere/x.xml", "list"),
      "/nowhere/x.xml: cannot be read: expected a file with <list> in it (No such file or "
      "directory)");
  std::string name = (std::filesystem::temp_directory_path() / "stride-test-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const std::string file = name + "/x.xml";
  std::ofstream(file) << "<list version=\"1\"/>";
  CHECK(Document::load(file, "list").root().children().empty());
  std::filesystem::remove_all(name);
}
