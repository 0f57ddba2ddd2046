// What programs and stride say to each other, damaged: a tag is read as another reader of XML reads
// it, or refused with a column; a declaration is read, or refused with file and line.
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>
#include <tinyxml2.h>
#include <unistd.h>

#include <stride/process/program.h>
#include <stride/process/tag.h>

#include "tests/fuzz/mutator.h"
#include "tests/scratch_folder.h"
#include "units/process/declaration.h"
#include "units/process/model.h"

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

TEST_CASE("mutated answers are taken, or refused with the program's name") {
  const ScratchFolder folder;
  std::ofstream(folder / "process.xml")
      << "<process version=\"1\">\n<program name=\"cat\"/>\n<output name=\"y\" type=\"Float64\"/>\n"
         "<output name=\"n\" type=\"Int8\"/>\n<message-output name=\"m.f\" type=\"Binary\"/>\n"
         "</process>\n";
  const process::Declaration declaration = process::load_declaration(folder / "");
  const std::string answers =
      "<output name=\"y\" value=\"0.5\"/>\n<output name=\"n\" value=\"-3\"/>\n"
      "<log level=\"info\" text=\"on\"/>\n<message name=\"m.f\" time=\"7\" value=\"00ff\"/>\n"
      "<sync time=\"7\" next=\"12\"/>\n<time-unit picoseconds=\"1000\"/>\n"
      "<output name=\"n\" value=\"4\"/>\n<sync time=\"1\" end=\"false\"/>\n";
  const std::string file = (folder / "answers").string();
  Mutator mutator(11, "<>/=\"'& -0123456789\n");
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::ofstream(file) << mutator.mutate(answers);
    std::vector<process::Value> values;
    for (const auto& variable : declaration.variables) values.push_back(variable.start);
    try {
      process::Session session(declaration, values, {"/bin/cat", file}, {},
                               [](bool, const std::string&) {});
      session.start({"it", "", "", ""}, stride::Time(stride::Duration(7)));
      session.step(stride::Time(stride::Duration(1000)), true);
      ++accepted;
    } catch (const std::runtime_error& error) {
      ++refused;
      REQUIRE(std::string(error.what()).rfind("the program 'cat answers' ", 0) == 0);
    }
  }
  CHECK(accepted > 0);
  CHECK(refused > 100);
}

TEST_CASE("mutated commands are obeyed, or answered with an error") {
  class Probe : public stride::process::Program {
   public:
    Probe(int in, int out) : Program(in, out) {
      parameter("p", p_);
      input("u", u_);
      output("y", u_);
      message_input<std::string>("m", [this](const std::string& text) { send("o", now(), text); });
    }

   private:
    stride::Time step(stride::Time to, bool) override { return to; }
    double p_ = 0;
    std::int16_t u_ = 0;
  };
  const std::string commands =
      "<open protocol=\"1\" instance=\"i\" resources=\"/r\"/>\n<time-unit picoseconds=\"10\"/>\n"
      "<parameter name=\"p\" value=\"1.5\"/>\n<input name=\"u\" value=\"2\"/>\n<start "
      "time=\"0\"/>\n"
      "<message name=\"m\" time=\"0\" value=\"a&lt;b\"/>\n<step size=\"0\" may-stop=\"false\"/>\n"
      "<step size=\"100\" may-stop=\"true\"/>\n<end/>\n";
  Mutator mutator(12, "<>/=\"'& -0123456789\n");
  int succeeded = 0;
  int failed = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = mutator.mutate(commands);
    int in[2], out[2];
    REQUIRE((::pipe(in) == 0 && ::pipe(out) == 0));
    REQUIRE(::write(in[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    ::close(in[1]);
    ++(Probe(in[0], out[1]).run() == 0 ? succeeded : failed);
    for (const int each : {in[0], out[0], out[1]}) ::close(each);
  }
  CHECK(succeeded > 100);
  CHECK(failed > 500);
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
  for (int i = 0; i < 1000; ++i) {
    std::ofstream(folder / "process.xml") << mutator.mutate(text);
    try {
      process::load_declaration(folder / "");
      ++accepted;
    } catch (const std::runtime_error& error) {
      ++refused;
      REQUIRE(std::string(error.what()).find("process.xml:") != std::string::npos);
    }
  }
  CHECK(accepted > 0);
  CHECK(refused > 500);
}
