#include "master/system/ssp/package.h"

#include <catch2/catch.hpp>

#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

const std::string kSet =
    "<v:ParameterSet version='2.0' name='p' "
    "xmlns:v='http://ssp-standard.org/SSP1/SystemStructureParameterValues'><v:Parameters/>"
    "</v:ParameterSet>";

std::string component(const std::string& name, const std::string& source,
                      const std::string& inside = "") {
  return "<ssd:Component name='" + name + "' source='" + source + "'>" + inside +
         "</ssd:Component>\n";
}

std::string bound_to(const std::string& set) {
  return "<ssd:ParameterBindings><ssd:ParameterBinding source='" + set +
         "'/></ssd:ParameterBindings>";
}

std::filesystem::path as_it_is(const std::filesystem::path& path, const core::Location&) {
  return path;
}

archive::Contents pack(const std::filesystem::path& file) {
  Files files;
  return package_contents(file, files, as_it_is);
}

}  // namespace

TEST_CASE("what a scenario names, at any depth, is packed once and named anew") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sub/deep");
  folder.write("a b.fmu", "one");
  folder.write("sub/a b.fmu", "two");
  folder.write("sub/p.ssv", kSet);
  folder.write("sub/s.ssd", ssd_with(component("x", "a%20b.fmu", bound_to("p.ssv"))));
  const std::string text = ssd_with("<!-- kept -->" + component("a", "a%20b.fmu") +
                                    component("again", "sub/../a%20b.fmu", bound_to("sub/p.ssv")) +
                                    component("s", "sub/s.ssd"));
  const archive::Contents contents = pack(folder.write("x.ssd", text));

  std::vector<std::string> names;
  for (const auto& [name, content] : contents) names.push_back(name);
  CHECK(names == std::vector<std::string>{"SystemStructure.ssd", "resources/a b.fmu",
                                          "resources/a b_2.fmu", "resources/p.ssv",
                                          "resources/s.ssd"});
  CHECK(contents.at("resources/a b_2.fmu").file == folder / "sub/a b.fmu");
  const std::string& packed = contents.at("SystemStructure.ssd").text;
  CHECK_THAT(packed, Contains("<!-- kept -->"));

  archive::write_zip(folder / "x.ssp", contents);
  const Scenario scenario = read_scenario(folder / "x.ssp");
  REQUIRE(scenario.sources.size() == 3);
  CHECK(content(scenario.sources[0]) == "one");
  CHECK(scenario.sources[0] == scenario.sources[1]);
  CHECK(content(scenario.sources[2]) == "two");
  CHECK(scenario.system.components[2].name == "s.x");
  CHECK(scenario.warnings.empty());
}

TEST_CASE("parameters that are relative to a component in another file are packed") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sub");
  folder.write("x.fmu", "one");
  folder.write("sub/own.ssv", kSet);
  folder.write("sub/s.ssd", ssd_with(component("x", "../x.fmu")));
  const std::string binding =
      "<ssd:ParameterBindings><ssd:ParameterBinding sourceBase='component' source='own.ssv'/>"
      "</ssd:ParameterBindings>";
  archive::write_zip(folder / "x.ssp",
                     pack(folder.write("x.ssd", ssd_with(component("s", "sub/s.ssd", binding)))));
  CHECK(read_scenario(folder / "x.ssp").warnings.empty());
}

TEST_CASE("the same scenario makes the same package") {
  const TemporaryFolder folder;
  folder.write("a.fmu", "one");
  const auto file = folder.write("x.ssd", ssd_with(component("a", "a.fmu")));
  archive::write_zip(folder / "1.ssp", pack(file));
  archive::write_zip(folder / "2.ssp", pack(file));
  CHECK(content(folder / "1.ssp") == content(folder / "2.ssp"));
}

TEST_CASE("a file that is not there cannot be packed") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(pack(folder.write("x.ssd", ssd_with(component("a", "none.fmu")))),
                    Contains("x.ssd:5: the file '") && Contains("none.fmu' does not exist"));
}

TEST_CASE("further systems are packed under their own names, with their resources once") {
  const TemporaryFolder folder;
  folder.write("a.fmu", "one");
  folder.write("b.fmu", "two");
  const auto main =
      folder.write("main.ssd", ssd_with(component("a", "a.fmu") + component("part", "part.ssd")));
  folder.write("part.ssd", ssd_with(component("x", "b.fmu") + component("m", "small.ssd")));
  const std::vector<std::filesystem::path> variants{
      folder.write("small.ssd", ssd_with(component("a", "a.fmu") + component("b", "b.fmu")))};
  Files files;
  const archive::Contents contents = package_contents(main, files, as_it_is, variants);

  std::vector<std::string> names;
  for (const auto& [name, content] : contents) names.push_back(name);
  CHECK(names == std::vector<std::string>{"SystemStructure.ssd", "resources/a.fmu",
                                          "resources/b.fmu", "resources/part.ssd", "small.ssd"});
  CHECK_THAT(contents.at("resources/part.ssd").text, Contains("source=\"../small.ssd\""));
  archive::write_zip(folder / "x.ssp", contents);
  const Scenario whole = read_scenario(folder / "x.ssp");
  CHECK(whole.system.components.size() == 4);
  CHECK(whole.warnings.empty());
  const Scenario small = read_scenario(folder / "x.ssp/small.ssd");
  REQUIRE(small.sources.size() == 2);
  CHECK(content(small.sources[1]) == "two");
}
