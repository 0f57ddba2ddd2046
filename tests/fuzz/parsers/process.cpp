// What programs and stride say to each other.
#include <array>

#include <fcntl.h>
#include <sys/mman.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <stride/process/program.h>
#include <stride/process/tag.h>

#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"
#include "units/process/declaration.h"
#include "units/process/model.h"

namespace stride::tests {
namespace {

using stride::process::Tag;
using stride::process::TagWriter;

/// It is as another reader of XML reads it.
void ensure_same(const Tag& tag, const std::string& line) {
  tinyxml2::XMLDocument document(true, tinyxml2::PRESERVE_WHITESPACE);
  ensure(document.Parse(line.data(), line.size()) == tinyxml2::XML_SUCCESS, "a tag is XML");
  const tinyxml2::XMLElement* element = document.RootElement();
  ensure(element != nullptr && tag.name() == element->Name(), "it has its name");
  const tinyxml2::XMLAttribute* attribute = element->FirstAttribute();
  for (std::size_t i = 0; i < tag.size(); ++i, attribute = attribute->Next()) {
    ensure(attribute != nullptr && tag.attribute_name(i) == attribute->Name() &&
               tag.attribute_value(i) == attribute->Value(),
           "it has its attributes");
  }
  ensure(attribute == nullptr, "it has no others");
}

void read_tag(const std::string& bytes) {
  refusing<std::invalid_argument>("column ", [&] {
    Tag tag;
    tag.parse(bytes);
    // tinyxml2 makes a line feed of a carriage return
    if (bytes.find('\r') == std::string::npos) ensure_same(tag, bytes);
  });
}

/// Whatever XML can hold is written so that it reads back.
void write_tag(const std::string& bytes) {
  std::string line;
  try {
    TagWriter(line, "log").value("text", bytes).end();
  } catch (const std::invalid_argument& error) {
    ensure(stride::process::first_unfit(bytes) != std::string::npos, "XML cannot hold it");
    throw Refusal(error.what());
  }
  ensure(line.find('\n') == line.size() - 1, "a tag is a line");
  ensure(line.find('\r') == std::string::npos, "a line has no carriage return");
  Tag tag;
  tag.parse(line);
  ensure(tag.text("text") == bytes, "the text reads back");
  ensure_same(tag, line);
}

void read_declaration(const std::string& bytes) {
  const auto folder = write_file("declaration/process.xml", bytes).parent_path();
  refusing<std::runtime_error>("process.xml:",
                               [&] { ::process::load_declaration(folder.string() + "/"); });
}

const ::process::Declaration& declaration() {
  static const ::process::Declaration read = [] {
    const auto file = write_file(
        "cat/process.xml",
        "<process version=\"1\">\n<program name=\"cat\"/>\n<output name=\"y\" type=\"Float64\"/>\n"
        "<output name=\"n\" type=\"Int8\"/>\n"
        "<output name=\"a\" type=\"Float32\" dimensions=\"2\"/>\n<message-output name=\"m.f\" "
        "type=\"Binary\"/>\n"
        "</process>\n");
    return ::process::load_declaration(file.parent_path().string() + "/");
  }();
  return read;
}

void read_answers(const std::string& bytes) {
  const auto file = write_file("answers", bytes);
  std::vector<::process::Value> values;
  for (const auto& variable : declaration().variables) values.push_back(variable.start);
  refusing<std::runtime_error>("the program 'cat answers' ", [&] {
    ::process::Session session(declaration(), values, {"/bin/cat", file.string()}, {},
                               [](bool, const std::string&) {});
    session.start({"it", "", "", ""}, Time(Duration(7)));
    session.step(Time(Duration(1000)), true);
  });
}

class Probe : public stride::process::Program {
 public:
  Probe(int in, int out) : Program(in, out) {
    parameter("p", p_);
    input("u", u_);
    output("y", u_);
    message_input<std::string>("m", [this](const std::string& text) { send("o", now(), text); });
  }

 private:
  Time step(Time to, bool) override { return to; }
  double p_ = 0;
  std::int16_t u_ = 0;
};

void read_commands(const std::string& bytes) {
  const int in = ::open(write_file("commands", bytes).c_str(), O_RDONLY | O_CLOEXEC);
  const int out = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const int code = Probe(in, out).run();
  for (const int each : {in, out}) ::close(each);
  if (code != 0) throw Refusal("the program has ended with an error");
}

const Registration kProcessParsers("process",
                                   {
                                       {.name = "tag",
                                        .read = read_tag,
                                        .seed_files = {"tests/fuzz/seeds/tag"},
                                        .alphabet = "<>/=\"' &;#x10\t\xE2\x82\xAC"},
                                       {.name = "tag_writer",
                                        .read = write_tag,
                                        .seeds = {"a <b> & \"c\" 'd' ß € 😀"},
                                        .alphabet = "<>&\"'\n\t\r; \xC3\x9F"},
                                       {.name = "process_declaration",
                                        .read = read_declaration,
                                        .seed_files = {"tests/fuzz/seeds/declaration",
                                                       "units/process/resources/process.xml"},
                                        .alphabet = "<>/=\"'& .-0"},
                                       {.name = "process_answers",
                                        .read = read_answers,
                                        .seed_files = {"tests/fuzz/seeds/answers"},
                                        .alphabet = "<>/=\"'& -0123456789\n"},
                                       {.name = "process_commands",
                                        .read = read_commands,
                                        .seed_files = {"tests/fuzz/seeds/commands"},
                                        .alphabet = "<>/=\"'& -0123456789\n"},
                                   });

}  // namespace
}  // namespace stride::tests
