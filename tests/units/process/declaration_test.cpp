// What is declared of a program.
#include "units/process/declaration.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "tests/units/resource_folder.h"

using namespace process;
using Catch::Contains;
using stride::tests::ResourceFolder;
using stride::tests::ScratchFolder;

namespace {

Declaration declared(const std::string& text) {
  const ResourceFolder folder("process.xml", text);
  return load_declaration(folder.path());
}

std::string with(const std::string& line) {
  return "<process version=\"1\">\n<program name=\"true\"/>\n" + line + "\n</process>\n";
}

}  // namespace

TEST_CASE("a declaration with a bit of everything") {
  const Declaration d = declared(
      "<process version=\"1\" description=\"a pump\" may-stop=\"true\" split-invariant=\"true\" "
      "trace=\"true\" time-unit=\"ns\" maximum-step=\"0.5\">\n"
      "<program name=\"python3\"/><argument text=\"-u\"/><argument file=\"src/pump.py\"/>\n"
      "<argument file=\"../table.csv\" outside=\"true\"/><file file=\"notes.txt\"/>\n"
      "<parameter name=\"gain\" type=\"Float64\" start=\"1.5\" min=\"0\" max=\"2\" unit=\"V\"/>\n"
      "<input name=\"on\" type=\"Boolean\"/>\n"
      "<output name=\"y\" type=\"Float32\" depends-on=\"on\" description=\"flow\"/>\n"
      "<message-input name=\"in.frame\" type=\"Binary\" mime-type=\"x/y\"/>\n"
      "<message-output name=\"text\" clock=\"tick\" type=\"String\"/>\n</process>");
  CHECK(d.description == "a pump");
  CHECK((d.may_stop && d.split_invariant && d.has_trace));
  CHECK(d.time_unit == stride::Duration(1000));
  CHECK(d.maximum_step == stride::Duration(500'000'000'000));
  REQUIRE(d.command.size() == 4);
  CHECK(d.command[2].text == "pump.py");
  CHECK(d.command[2].kind == Word::Kind::Resource);
  CHECK(d.command[3].kind == Word::Kind::Outside);
  REQUIRE(d.variables.size() == 5);
  CHECK(std::get<double>(d.variables[0].start) == 1.5);
  CHECK(d.variables[1].is_discrete);
  CHECK_FALSE(d.variables[2].is_discrete);
  CHECK(*d.variables[2].depends_on == std::vector<std::string>{"on"});
  CHECK(d.variables[3].clock == "in.clock");
  CHECK(d.variables[4].clock == "tick");
}

TEST_CASE("arrays have dimensions") {
  const Declaration d = declared(with(
      "<input name=\"pose\" type=\"Float32\" dimensions=\"2 3\" unit=\"m\" start=\"1 2 3 4 5 6\"/>"
      "<output name=\"pixels\" type=\"UInt8\" dimensions=\"4\"/>"));
  CHECK(d.variables[0].dimensions == std::vector<std::size_t>{2, 3});
  CHECK_FALSE(d.variables[0].is_discrete);
  CHECK(std::get<std::valarray<float>>(d.variables[0].start)[5] == 6);
  CHECK(std::get<std::valarray<std::uint8_t>>(d.variables[1].start).size() == 4);
  CHECK(d.variables[1].is_discrete);
}

TEST_CASE("units of measure and differences are declared") {
  const Declaration d =
      declared(with("<unit-of-measure name=\"oven\" factor=\"10\" unit=\"degC\" offset=\"50\"/>"
                    "<unit-of-measure name=\"same\" unit=\"m\"/>"
                    "<input name=\"rise\" type=\"Float64\" unit=\"oven\" relative=\"true\"/>"));
  REQUIRE(d.units_of_measure.size() == 2);
  CHECK(d.units_of_measure[0].name == "oven");
  CHECK(d.units_of_measure[0].factor == 10);
  CHECK(d.units_of_measure[0].in == "degC");
  CHECK(d.units_of_measure[0].offset == 50);
  CHECK(d.units_of_measure[1].factor == 1);
  CHECK(d.variables[0].is_relative);
}

TEST_CASE("mistakes in a declaration are reported with file and line") {
  const auto [line, expected] = GENERATE(table<std::string, std::string>({
      {"<knob/>", "process.xml:3: <knob>: not known here: expected <program>"},
      {"<program name=\"true\"/>", "expected one <program>"},
      {"<argument/>", "expected either 'file' or 'text'"},
      {"<argument text=\"a\" outside=\"true\"/>", "outside: expected where there is a 'file' only"},
      {"<input type=\"Float64\"/>", "expected the attribute 'name'"},
      {"<input name=\"u\"/>", "expected the attribute 'type'"},
      {"<input name=\"u\" type=\"Real\"/>",
       "type=\"Real\" is not known: expected Float32, Float64, Int8"},
      {"<input name=\"u\" type=\"Int8\" start=\"200\"/>", "'200' is not a valid Int8"},
      {"<input name=\"u\" type=\"Int8\" size=\"3\"/>", "unknown attribute 'size'"},
      {"<input name=\"u\" type=\"Int8\" variability=\"continuous\"/>", "expected discrete"},
      {"<input name=\"u\" type=\"Int8\" dimensions=\"2\" start=\"1\"/>",
       "has 1 elements; expected 2"},
      {"<input name=\"u\" type=\"Int8\" dimensions=\"2 0\"/>",
       "expected from 1 to 1048576 elements"},
      {"<input name=\"u\" type=\"Int8\" dimensions=\"65536 65536\"/>",
       "expected from 1 to 1048576 elements"},
      {"<input name=\"u\" type=\"Int8\" dimensions=\"2x3\"/>", "'2x3' is not a valid UInt32"},
      {"<input name=\"u\" type=\"Int8\" dimensions=\"\"/>", "expected a number for each"},
      {"<input name=\"u\" type=\"String\" dimensions=\"2\"/>",
       "dimensions: expected of numbers and Booleans only"},
      {"<input name=\"\" type=\"Int8\"/>", "expected a name"},
      {"<input name=\"u\" type=\"String\" unit=\"m\"/>", "unit: expected of numbers only"},
      {"<input name=\"u\" type=\"Int8\" relative=\"true\"/>",
       "relative: expected of Float32 and Float64 only"},
      {"<unit-of-measure name=\"x\"/>", "expected the attribute 'unit'"},
      {"<output name=\"y\" type=\"Int8\" depends-on=\"x\"/>", "there is no <input name=\"x\"/>"},
      {"<message-output name=\"y\" type=\"String\"/>",
       "expected the attribute 'clock', or a name such as"},
      {"<message-output name=\"y.a\" type=\"String\" mime-type=\"a/b\"/>",
       "expected of a Binary only"},
      {"<message-output name=\"y.a\" type=\"String\"/>\n<message-output name=\"y.b\" "
       "type=\"String\"/>",
       "process.xml:4: <message-output>: 'y.clock' is declared twice"},
  }));
  CHECK_THROWS_WITH(declared(with(line)), Contains(expected));
}

TEST_CASE("mistakes of the whole") {
  CHECK_THROWS_WITH(declared("<process version=\"1\"/>"), Contains("expected <program file="));
  CHECK_THROWS_WITH(declared("<process version=\"1\" time-unit=\"min\"/>"),
                    Contains("expected ps, ns, us, ms or s"));
  CHECK_THROWS_WITH(declared("<process version=\"1\" may-stop=\"yes\"/>"),
                    Contains("'yes' is not a valid Boolean"));
  CHECK_THROWS_WITH(declared("<process version=\"1\" maximum-step=\"0\"/>"),
                    Contains("more than 0"));
  CHECK_THROWS_WITH(declared("<unit version=\"1\"/>"), Contains("expected <process> as the root"));
  CHECK_THROWS_WITH(declared("<process version=\"2\"/>"), Contains("expected 1"));
  CHECK_THROWS_WITH(load_declaration(""), Contains("stride pack"));
  const ScratchFolder empty;
  CHECK_THROWS_WITH(load_declaration(empty / ""), Contains("process.xml: cannot be read"));
}

TEST_CASE("files are in the resources, or where the declaration was") {
  const ScratchFolder resources, origin;
  std::ofstream(resources / "packed") << "";
  std::ofstream(origin / "table") << "";
  std::ofstream(resources / "origin.txt") << (origin / "sub").string() << '\n';
  Declaration d;
  d.command = {{Word::Kind::Text, "python3"},
               {Word::Kind::Resource, "packed"},
               {Word::Kind::Outside, "../table"}};
  CHECK(command_line(d, resources / "", "") ==
        std::vector<std::string>{"python3", (resources / "packed").string(),
                                 (origin / "table").string()});
  CHECK(command_line(d, resources / "", "pypy").front() == "pypy");
  d.command[1].text = "gone";
  CHECK_THROWS_WITH(command_line(d, resources / "", ""),
                    Contains("gone") && Contains("stride pack"));
  d.command[1] = {Word::Kind::Outside, "../gone"};
  CHECK_THROWS_WITH(command_line(d, resources / "", ""), Contains("outside of the unit"));
}
