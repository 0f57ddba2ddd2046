#include "master/system/ssp/files.h"

#include <catch2/catch.hpp>

#include "master/base/archive/zip.h"
#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string system_named(const std::string& name) {
  return ssd_with("<ssd:Component name='" + name + "' source='resources/a.fmu'/>");
}

std::filesystem::path package(const TemporaryFolder& folder, const archive::Contents& contents,
                              const std::string& name = "p.ssp") {
  archive::write_zip(folder / name, contents);
  return folder / name;
}

archive::Contents two_variants() {
  return {{"SystemStructure.ssd", {system_named("one"), {}, false}},
          {"Variant.ssd", {system_named("two"), {}, false}}};
}

std::string first_component(const std::filesystem::path& path) {
  return read_scenario(path).system.components.at(0).name;
}

}  // namespace

TEST_CASE("a package is read by its SystemStructure.ssd, or the one that is named in it") {
  const TemporaryFolder folder;
  const auto file = package(folder, two_variants());
  CHECK(first_component(file) == "one");
  CHECK(first_component(file / "Variant.ssd") == "two");
  CHECK_THROWS_WITH(
      read_scenario(file / "Varian.ssd"),
      Contains("p.ssp' has no Varian.ssd; it holds SystemStructure.ssd, Variant.ssd") &&
          Contains("did you mean 'Variant.ssd'?"));
}

TEST_CASE("the system of a package may be in another case, or in the folder that was packed") {
  const TemporaryFolder folder;
  const archive::Content system{system_named("one"), {}, false};
  const auto name = GENERATE(as<std::string>(), "systemstructure.SSD", "pkg/SystemStructure.ssd",
                             "crane.ssd", "pkg/crane.SSD", "a/b/SystemStructure.ssd");
  const archive::Content other{"x", {}, false};
  const auto file = package(
      folder, {{name, system}, {"__MACOSX/pkg/SystemStructure.ssd", other}, {".DS_Store", other}});
  const Scenario scenario = read_scenario(file);
  CHECK(scenario.system.components.at(0).name == "one");
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0],
             Contains("p.ssp' has its SystemStructure.ssd as '" + name + "'"));
}

TEST_CASE("a package with several systems, none of which is called so, asks for the name of one") {
  const TemporaryFolder folder;
  const archive::Content system{system_named("one"), {}, false};
  const auto file = package(folder, {{"a.ssd", system}, {"b.ssd", system}});
  CHECK_THROWS_WITH(read_scenario(file),
                    Contains("p.ssp' has no SystemStructure.ssd; it holds a.ssd, b.ssd") &&
                        Contains("hint: name one of its systems: ") && Contains("p.ssp/a.ssd"));
  CHECK(first_component(file / "b.ssd") == "one");
  const auto nested = package(
      folder, {{"a/SystemStructure.ssd", system}, {"b/SystemStructure.ssd", system}}, "q.ssp");
  CHECK_THROWS_WITH(read_scenario(nested),
                    Contains("pack the contents of each as a package of its own"));
}

TEST_CASE("a file of another kind is named as such") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_scenario(folder.write("car.py", "import stride.unit\n")),
                    Contains("car.py: this is neither a system (.ssd, .ssp), nor a unit") &&
                        Contains("hint: a unit in Python is packed first: python3 -m stride.unit"));
  CHECK_THROWS_WITH(read_scenario(folder.write("x.txt", "time;u\n")),
                    Contains("x.txt: this is neither a system"));
  CHECK_THROWS_WITH(read_scenario(folder.write("x.ssd", "time;u\n")), Contains("well-formed XML"));
  CHECK(first_component(folder.write("x.xml", "\n" + system_named("a"))) == "a");
}

TEST_CASE("an FMU is a scenario of itself") {
  const TemporaryFolder folder;
  const archive::Content content{"<x/>", {}, false};
  const auto file = package(folder, {{"modelDescription.xml", content}},
                            GENERATE(as<std::string>(), "my & unit.fmu", "my & unit.zip"));
  const Scenario scenario = read_scenario(file);
  CHECK(scenario.name == "my & unit");
  CHECK(scenario.system.components.at(0).name == "my & unit");
  CHECK(scenario.sources.at(0) == file);
  folder.write("modelDescription.xml", "<x/>");
  CHECK(std::filesystem::equivalent(read_scenario(folder / "").sources.at(0), folder / ""));
  CHECK_THROWS_WITH(Files().system_file(file),
                    Contains("hint: it is an FMU: 'stride run' runs it"));
}

TEST_CASE("a package in a package that is no archive is named by both") {
  const TemporaryFolder folder;
  const std::string inner = ssd_with("<ssd:Component name='s' source='resources/i.ssp'/>");
  const auto file = package(folder, {{"SystemStructure.ssd", {inner, {}, false}},
                                     {"resources/i.ssp", {"PK\x03\x04 no archive", {}, false}}});
  CHECK_THROWS_WITH(read_scenario(file), Contains("p.ssp/resources/i.ssp' "));
}

TEST_CASE("the folder that a package unpacks to is read like it") {
  const TemporaryFolder folder;
  folder.write("SystemStructure.ssd", system_named("one"));
  CHECK(first_component(folder / "") == "one");
}

TEST_CASE("the error of an archive or folder without a system lists its content") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_scenario(package(folder, {{"resources/a.fmu", {"x", {}, false}}})),
                    Contains("p.ssp' has no SystemStructure.ssd; it holds resources/a.fmu"));
  CHECK_THROWS_WITH(read_scenario(folder / ""), Contains("has no SystemStructure.ssd"));
}

TEST_CASE("what is unpacked goes with the scenario, and complaints name the package") {
  const TemporaryFolder folder;
  const auto file = package(folder, two_variants());
  std::filesystem::path unpacked;
  {
    const Scenario scenario = read_scenario(file);
    unpacked = scenario.sources.at(0).parent_path().parent_path();
    CHECK(std::filesystem::exists(unpacked / "SystemStructure.ssd"));
    CHECK(scenario.system.components.at(0).where.file == file.string() + "/SystemStructure.ssd");
    CHECK(stem(scenario.path) == "p");
  }
  CHECK_FALSE(std::filesystem::exists(unpacked));
}

TEST_CASE("a package can be a component, by one of its variants") {
  const TemporaryFolder folder;
  package(folder, two_variants(), "inner.ssp");
  const auto [source, name] = GENERATE(table<std::string, std::string>(
      {{"inner.ssp", "sub.one"}, {"inner.ssp#Variant.ssd", "sub.two"}}));
  const auto file = folder.write(
      "x.ssd", ssd_with("<ssd:Component name='sub' type='application/x-ssp-package' source='" +
                        source + "'/>"));
  CHECK(first_component(file) == name);
  CHECK_THROWS_WITH(
      read_scenario(folder.write("y.ssd", ssd_with("<ssd:Component name='sub' source='no.ssp'/>"))),
      Contains("y.ssd:5: the system '") && Contains("no.ssp' does not exist"));
  CHECK_THROWS_WITH(
      read_scenario(folder.write(
          "z.ssd", ssd_with("<ssd:Component name='sub' source='inner.ssp#../x.ssd'/>"))),
      Contains("z.ssd:5:") && Contains("at its top"));
}

TEST_CASE("what has been read ahead is not read again, and its warnings come once") {
  const TemporaryFolder folder;
  const auto file = folder.write("a.ssd", "<ssd:a name='old'/>");
  Files files;
  CHECK(files.read_ahead(file).root().attribute("name") == "old");
  folder.write("a.ssd", "<ssd:a name='new'/>");
  CHECK(files.read_ahead(file).root().attribute("name") == "old");
  CHECK(files.documents().empty());
  CHECK(files.document(file).root().attribute("name") == "old");
  CHECK(files.documents().size() == 1);
  CHECK(files.warnings().size() == 1);
  CHECK(files.document(file).root().attribute("name") == "new");
  CHECK_THROWS_WITH(files.read_ahead(folder / "none.ssd"), Contains("does not exist"));
}
