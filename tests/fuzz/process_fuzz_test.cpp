// What programs and stride say to each other, damaged: a tag is read as another reader of XML reads
// it, or refused with a column; a declaration is read, or refused with file and line.
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>
#include <tinyxml2.h>

#include <stride/process/tag.h>

#include "tests/fuzz/mutator.h"
#include "tests/scratch_folder.h"
#include "units/process/declaration.h"

using stride::process::Tag;
using stride::process::TagWriter;
using stride::tests::Mutator;
using stride::tests::ScratchFolder;

namespace {

constexpr const char* kTags[] = {
    "<output name=\"adc.value\" value=\"0.5\"/>",
    "<message name='transmit.frame' time='14200449852506' value='26a0ff' />",
    "<log level=\"warning\" text=\"a &lt; b &amp;&quot;c&quot; &#10;&#x20AC; &apos;\"/>",
    "<sync time=\"1000\" next=\"5000\" end=\"false\"/>",
};

void check_same(const Tag& tag, const std::string& line) {
  tinyxml2::XMLDocument document(true, tinyxml2::PRESERVE_WHITESPACE);
  INFO(line);
  REQUIRE(document.Parse(line.data(), line.size()) == tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement* element = document.RootElement();
  REQUIRE(element != nullptr);
  CHECK(tag.name() == element->Name());
  const tinyxml2::XMLAttribute* attribute = element->FirstAttribute();
  for (std::size_t i = 0; i < tag.size(); ++i, attribute = attribute->Next()) {
    REQUIRE(attribute != nullptr);
    CHECK(tag.attribute_name(i) == attribute->Name());
    CHECK(tag.attribute_value(i) == attribute->Value());
  }
  CHECK(attribute == nullptr);
}

}  // namespace

TEST_CASE("mutated tags are read as tinyxml2 reads them, or refused with a column") {
  Mutator mutator(8, "<>/=\"' &;#x10\t\xE2\x82\xAC");
  int accepted = 0;
  int refused = 0;
  Tag tag;
  for (int i = 0; i < 40'000; ++i) {
    const std::string line = mutator.mutate(kTags[i % 4]);
    try {
      tag.parse(line);
    } catch (const std::invalid_argument& error) {
      ++refused;
      REQUIRE(std::string(error.what()).rfind("column ", 0) == 0);
      continue;
    }
    ++accepted;
    if (line.find('\r') == std::string::npos) check_same(tag, line);  // which it makes a line feed
  }
  CHECK(accepted > 2000);
  CHECK(refused > 10'000);
}

TEST_CASE("whatever XML can hold is written so that it reads back") {
  Mutator mutator(9, "<>&\"'\n\t\r; \xC3\x9F");
  int written = 0;
  Tag tag;
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = mutator.mutate("a <b> & \"c\" 'd' ß € 😀");
    std::string line;
    try {
      TagWriter(line, "log").value("text", text).end();
    } catch (const std::invalid_argument&) {
      CHECK(stride::process::first_unfit(text) != std::string::npos);
      continue;
    }
    ++written;
    REQUIRE(line.find('\n') == line.size() - 1);
    tag.parse(line);
    REQUIRE(tag.text("text") == text);
    REQUIRE(line.find('\r') == std::string::npos);
    check_same(tag, line);
  }
  CHECK(written > 2000);
}

TEST_CASE("mutated declarations are read, or refused with file and line") {
  const std::string text =
      "<process version=\"1\" time-unit=\"ns\" may-stop=\"true\">\n<program name=\"x\"/>\n"
      "<argument file=\"a/b.py\" outside=\"true\"/>\n"
      "<parameter name=\"p\" type=\"Float64\" start=\"1\" min=\"0\" max=\"2\" unit=\"m\"/>\n"
      "<input name=\"u\" type=\"Int8\" start=\"-3\"/>\n<output name=\"y\" type=\"Boolean\" "
      "depends-on=\"u\"/>\n"
      "<message-output name=\"m.f\" type=\"Binary\" mime-type=\"a/b\" "
      "start=\"00ff\"/>\n</process>\n";
  const ScratchFolder folder;
  Mutator mutator(10, "<>/=\"'& .-0");
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::ofstream(folder / "process.xml") << mutator.mutate(text);
    try {
      process::load_declaration(folder / "");
      ++accepted;
    } catch (const std::runtime_error& error) {
      ++refused;
      REQUIRE(std::string(error.what()).find("process.xml:") != std::string::npos);
    }
  }
  CHECK(accepted > 10);
  CHECK(refused > 1000);
}
