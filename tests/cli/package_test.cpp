// Scenarios in packages, and systems in systems, from outside.
#include <algorithm>

#include <catch2/catch.hpp>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/archive/zip.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Contains;

namespace {

/// The second low-pass is in a system of its own, behind a gain.
Parts nested_filters() {
  Parts parts;
  parts.components =
      component("first", "minimal.fmu") +
      "<ssd:System name=\"inner\"><ssd:Connectors>"
      "<ssd:Connector name=\"u\" kind=\"input\"/><ssd:Connector name=\"y\" kind=\"output\"/>"
      "</ssd:Connectors><ssd:Elements>" +
      component("second", "minimal.fmu") +
      "</ssd:Elements><ssd:Connections>"
      "<ssd:Connection startConnector=\"u\" endElement=\"second\" endConnector=\"u\">"
      "<ssc:LinearTransformation factor=\"2\" offset=\"1\"/></ssd:Connection>"
      "<ssd:Connection startElement=\"second\" startConnector=\"y\" endConnector=\"y\"/>"
      "</ssd:Connections></ssd:System>\n" +
      component("third", "minimal.fmu");
  parts.connections = connection("first.y", "inner.u") + connection("inner.y", "third.u");
  return parts;
}

const Arguments kFirst{"--set", "first.u=1"};

}  // namespace

TEST_CASE("a system in a system runs as its components do") {
  const Workspace nested(nested_filters());
  REQUIRE(nested.run(kFirst).exit_code == 0);
  const Csv signals = nested.signals();
  CHECK(signals.titles() ==
        std::vector<std::string>{"time", "first.y", "inner.second.y", "third.y"});
  CHECK_THAT(nested.stride({"check", "test.ssd"}).out, Contains("× 2 + 1"));
}

TEST_CASE("what leaves the root system is recorded under its name, converted") {
  Parts parts = two_filters();
  std::string text = scenario_text(parts);
  const std::string root = "<ssd:System name=\"root\">";
  text.insert(text.find(root) + root.size(),
              "<ssd:Connectors><ssd:Connector name=\"level\" kind=\"output\"/></ssd:Connectors>");
  text.insert(text.find("</ssd:Connections>"),
              "<ssd:Connection startElement=\"second\" startConnector=\"y\" "
              "endConnector=\"level\"><ssc:LinearTransformation factor=\"-2\"/></ssd:Connection>");
  const Workspace workspace(text);
  REQUIRE(workspace.run(kFirst).exit_code == 0);
  const auto inside = workspace.signals().numbers("second.y");
  const auto outside = workspace.signals().numbers("level");
  REQUIRE(inside.size() == outside.size());
  CHECK(inside.back() > 0);
  for (std::size_t i = 0; i < inside.size(); ++i) CHECK(outside[i] == -2 * inside[i]);
  REQUIRE(workspace.run({"--signals", "level"}).exit_code == 0);
  CHECK(workspace.signals().titles() == std::vector<std::string>{"time", "level"});
}

TEST_CASE("a value for a connector of a system is set where it leads") {
  const Workspace nested(nested_filters());
  CHECK(nested.run({"--set", "inner.u=3", "--signals", "inner.second.u"}).exit_code == 0);
  CHECK_THAT(input_error_of(nested.run({"--set", "inner.secnd.u=3"})),
             Contains("--set inner.secnd.u=3: ") && Contains("did you mean 'second'?"));
}

TEST_CASE("a scenario is packed with its units, and gives the same results") {
  const Workspace plain(nested_filters());
  REQUIRE(plain.run(kFirst).exit_code == 0);
  REQUIRE(plain.stride({"pack", "test.ssd", "-o", "test.ssp"}).exit_code == 0);

  const Scratch elsewhere;
  fs::copy_file(plain / "test.ssp", elsewhere / "moved.ssp");
  Arguments arguments{"run", "moved.ssp", "--out", "out"};
  arguments.insert(arguments.end(), kFirst.begin(), kFirst.end());
  const Outcome outcome = run_program(arguments, elsewhere.path());
  REQUIRE(outcome.exit_code == 0);
  CHECK(read(elsewhere / "out" / "signals.csv") == plain.result("signals.csv"));
}

TEST_CASE("nothing is left of a package that was run, well or not") {
  const Workspace workspace(nested_filters());
  REQUIRE(workspace.stride({"pack", "test.ssd", "-o", "test.ssp"}).exit_code == 0);
  CHECK(workspace.stride({"run", "test.ssp"}).exit_code == 0);
  CHECK(fs::exists(workspace / "results/test/signals.csv"));
  CHECK(workspace.left_behind().empty());
  CHECK(workspace.stride({"run", "test.ssp", "--set", "nobody.u=1"}).exit_code == 2);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("the error of a package without a system lists its content") {
  const Workspace workspace(nested_filters());
  stride::archive::write_zip(workspace / "odd.ssp", {{"resources/notes.txt", {"x", {}, false}}});
  CHECK_THAT(input_error_of(workspace.stride({"run", "odd.ssp"})),
             Contains("'odd.ssp' has no SystemStructure.ssd; it holds resources/notes.txt"));
}

TEST_CASE("a mistake in a package is named by the package's name") {
  const Workspace workspace(nested_filters());
  stride::archive::write_zip(workspace / "odd.ssp", {{"SystemStructure.ssd", {"<a>", {}, false}}});
  CHECK_THAT(input_error_of(workspace.stride({"check", "odd.ssp"})),
             Contains("odd.ssp/SystemStructure.ssd:1: this is not well-formed XML"));
}

TEST_CASE("a package is completed as a package") {
  const Workspace workspace(nested_filters());
  REQUIRE(workspace.stride({"pack", "test.ssd", "-o", "test.ssp"}).exit_code == 0);
  REQUIRE(workspace.stride({"complete", "test.ssp"}).exit_code == 0);
  CHECK(workspace.stride({"run", "test.ssp"}).exit_code == 0);
  const std::string once = read(workspace / "test.ssp");
  REQUIRE(workspace.stride({"complete", "test.ssp"}).exit_code == 0);
  CHECK(read(workspace / "test.ssp") == once);
}

TEST_CASE("a value without a variable is ignored with a warning") {
  Parts parts = two_filters();
  parts.components =
      component("first", "minimal.fmu",
                "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
                "<v:ParameterSet version=\"2.0\" name=\"p\" "
                "xmlns:v=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">"
                "<v:Parameters><v:Parameter name=\"time_constnt\"><v:Real value=\"1\"/>"
                "</v:Parameter></v:Parameters></v:ParameterSet></ssd:ParameterValues>"
                "</ssd:ParameterBinding></ssd:ParameterBindings>") +
      component("second", "minimal.fmu");
  const Workspace workspace(parts);
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("unit 'first', variable 'time_constnt'") &&
                              Contains("did you mean 'time_constant'?") &&
                              Contains("is ignored, as SSP requires"));
}

namespace {

std::vector<std::string> top_files_of(const Workspace& workspace, const std::string& package) {
  const Scratch folder;
  stride::archive::UnpackedArchive unpacked(workspace / package, "a package", {});
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(unpacked.folder())) {
    if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

TEST_CASE("a package is packed with all of its systems, or with the one that is named") {
  const Workspace workspace(two_filters());
  const std::string one = scenario_text({component("alone", "minimal.fmu")});
  stride::archive::write_zip(workspace / "var.ssp",
                             {{"SystemStructure.ssd", {scenario_text(two_filters()), {}, false}},
                              {"Short.ssd", {one, {}, false}},
                              {"extra/org.example/note.txt", {"kept", {}, false}}});
  const auto pack = [&](const std::string& from) {
    return workspace.stride({"pack", from, "-o", "new.ssp"});
  };
  REQUIRE(pack("var.ssp").exit_code == 0);
  CHECK(top_files_of(workspace, "new.ssp") ==
        std::vector<std::string>{"Short.ssd", "SystemStructure.ssd"});
  CHECK_THAT(read(workspace / "new.ssp"), Contains("extra/org.example/note.txt"));
  CHECK(workspace.stride({"run", "new.ssp/Short.ssd", "--quiet"}).exit_code == 0);
  REQUIRE(pack("var.ssp/Short.ssd").exit_code == 0);
  CHECK(top_files_of(workspace, "new.ssp") == std::vector<std::string>{"SystemStructure.ssd"});
  CHECK_THAT(workspace.stride({"inspect", "new.ssp"}).out, Contains("1 component, 0 connections"));
  CHECK_THAT(input_error_of(pack("var.ssp/Shrt.ssd")), Contains("did you mean 'Short.ssd'?"));
  CHECK_THAT(input_error_of(pack("none.ssd")), Contains("none.ssd"));
}
