// Files as other tools write them, in a run: character encodings, prefixes, sources.
#include <cmath>

#include "master/base/archive/zip.h"
#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const std::string kDeclared = "encoding=\"UTF-8\"";

/// A workspace whose unit "unit" has an umlaut in its description, which is "file" as text.
struct Umlaut {
  Workspace workspace{Parts{component("unit", "unit", "<!-- \xC3\xA4 -->")}};

  Umlaut() {
    fs::copy(stride::importer::UnpackedFmu(test_fmu("fmi2_relaxation")).folder(),
             workspace / "unit", fs::copy_options::recursive);
    const std::string text = read(workspace / "unit/modelDescription.xml");
    write(replaced(text, "what x goes to", "was x \xC3\xA4ndert"));
  }
  std::string text() const { return read(workspace / "unit/modelDescription.xml"); }
  void write(const std::string& text) {
    workspace.scratch().write("unit/modelDescription.xml", text);
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  }
};

/// A text of characters below 256, a byte each.
std::string latin1(const std::string& utf8) {
  std::string bytes;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    if (lead < 0x80) {
      bytes += utf8[i];
    } else {
      bytes += static_cast<char>((lead & 3) << 6 | (static_cast<unsigned char>(utf8[++i]) & 63));
    }
  }
  return bytes;
}

std::string utf16(const std::string& utf8) {
  std::string bytes = "\xFF\xFE";
  for (const char c : latin1(utf8)) bytes += {c, '\0'};
  return bytes;
}

}  // namespace

TEST_CASE("a description in another encoding is read without a warning") {
  Umlaut umlaut;
  const std::string utf8 = umlaut.text();
  const std::string bytes =
      GENERATE_COPY(latin1(Umlaut::replaced(utf8, kDeclared, "encoding='ISO-8859-1'")),
                    latin1(Umlaut::replaced(utf8, kDeclared, "encoding=\"windows-1252\"")),
                    utf16(Umlaut::replaced(utf8, kDeclared, "encoding=\"UTF-16\"")));
  umlaut.write(bytes);
  const Outcome outcome = umlaut.workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  const Outcome shown = umlaut.workspace.stride({"inspect", "unit"});
  CHECK_THAT(shown.out, Contains("was x \xC3\xA4ndert"));
}

TEST_CASE("bytes of another encoding than the declared one are a warning with the line") {
  Umlaut umlaut;
  umlaut.write(latin1(umlaut.text()));
  const Outcome outcome = umlaut.workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: ") && Contains("unit/modelDescription.xml:8: "));
}

TEST_CASE("a variable name that is there twice is a warning, and an error where it is used") {
  Umlaut unit;
  unit.write(
      Umlaut::replaced(unit.text(), "</ModelVariables>",
                       "<ScalarVariable name=\"x\" valueReference=\"77\"><Real/></ScalarVariable>\n"
                       "</ModelVariables>"));
  const Outcome outcome = unit.workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: ") && Contains("the variable name 'x' is used twice"));
  for (const char* use : {"--set=unit.x=1", "--signals=unit.x"}) {
    CHECK_THAT(input_error_of(unit.workspace.run({use})),
               Contains("unit 'unit', variable 'x': several variables of its model") &&
                   Contains("hint: give each variable"));
  }
}

TEST_CASE("a system file and its values in another encoding are read, and where they are wrong") {
  const Workspace workspace(
      Parts{component("unit", "fmi2_relaxation.fmu",
                      "<ssd:ParameterBindings><ssd:ParameterBinding source=\"values.ssv\"/>"
                      "</ssd:ParameterBindings>")});
  const std::string values =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<ssv:ParameterSet version=\"1.0\" name=\"Gr\xC3\xB6\xC3\x9F"
      "en\">\n"
      "<ssv:Parameters><ssv:Parameter name=\"u\"><ssv:Real value=\"3\"/></ssv:Parameter>\n"
      "</ssv:Parameters></ssv:ParameterSet>\n";
  workspace.scratch().write("values.ssv", latin1(values));
  const Outcome outcome = workspace.run({"--quiet"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("values.ssv:2: ") && Contains("ssv"));
  CHECK(workspace.signals().numbers("unit.x").back() > 1.5);
}

TEST_CASE("a system as tools write it runs, with a warning for each thing that has one meaning") {
  const std::string step =
      "<ssd:Annotations><ssc:Annotation type=\"com.opensimulationplatform\">"
      "<osp:SimulationInformation xmlns:osp=\"urn:osp\"><osp:FixedStepAlgorithm "
      "baseStepSize=\"0.05\"/></osp:SimulationInformation></ssc:Annotation></ssd:Annotations>";
  const std::string other =
      "<ssd:Annotations><ssc:Annotation type=\"com.other.tool\"><tool:Colour "
      "xmlns:tool=\"urn:tool\" rgb=\"0 0 255\"/></ssc:Annotation></ssd:Annotations>";
  Workspace workspace(
      {component("unit", "units\\relaxation.fmu",
                 "<ssd:Connectors><ssd:Connector name=\"u\" kind=\"Input\"><ssc:Real/>" + other +
                     "</ssd:Connector></ssd:Connectors>"
                     "<ssd:ParameterBindings><ssd:ParameterBinding source=\"my%20values.ssv\"/>"
                     "</ssd:ParameterBindings>" +
                     other),
       "", "", "<ssd:DefaultExperiment>" + step + "</ssd:DefaultExperiment>\n"});
  fs::create_directories(workspace / "resources/units");
  fs::copy_file(test_fmu("fmi2_relaxation"), workspace / "resources/units/relaxation.fmu");
  workspace.scratch().write(
      "my values.ssv",
      "<?xml version=\"1.0\"?>\n<ssv:ParameterSet version=\"1.0\" "
      "name=\"values\">\n<ssv:Parameters>"
      "<ssv:Parameter name=\"u\"><ssv:Real value=\"3\"/></ssv:Parameter></ssv:Parameters>\n"
      "</ssv:ParameterSet>\n");
  const Outcome outcome = workspace.run({"--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("my values.ssv:2: ") && Contains("0.05"));
  CHECK_THAT(outcome.err, Contains("kind=\"Input\" of <ssd:Connector> is taken for input"));
  const auto times = workspace.signals().numbers("time");
  CHECK(times.size() == 21);  // to the unit's own stop time
  CHECK(workspace.signals().numbers("unit.x").back() == Approx(3 - 2 * std::exp(-2)));
}

TEST_CASE("a Boolean is connected to a Real, as 1 or 0, with a warning for the connection") {
  const Workspace workspace(
      Parts{component("valve", "fmi2_types.fmu",
                      "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
                      "<ssv:ParameterSet "
                      "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" "
                      "version=\"1.0\" name=\"p\"><ssv:Parameters><ssv:Parameter name=\"boolean\">"
                      "<ssv:Boolean value=\"true\"/></ssv:Parameter></ssv:Parameters>"
                      "</ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding>"
                      "</ssd:ParameterBindings>") +
                component("tank", "fmi2_relaxation.fmu") + component("other", "fmi2_types.fmu"),
            connection("valve.boolean.echo", "tank.u") +
                connection("valve.boolean.echo", "other.integer") +
                connection("valve.integer.echo", "other.boolean")});
  const Arguments hosting = GENERATE(Arguments{"--quiet"}, Arguments{"--quiet", "--isolate"});
  const Outcome outcome = workspace.run(hosting);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("test.ssd:") &&
                 Contains("'valve.boolean.echo', a value of the type Boolean, is connected to "
                          "'tank.u' of the type Float64: true becomes 1, false 0") &&
                 Contains("'other.boolean' of the type Boolean: 0 becomes false"));
  CHECK(workspace.signals().numbers("tank.x").back() == 1);  // where it starts; else it falls to 0
  CHECK(workspace.signals().numbers("other.integer.echo").back() == 1);
  const Outcome completed = workspace.stride({"complete", "test.ssd", "-o", "completed.ssd"});
  CHECK(completed.exit_code == 0);
  CHECK(workspace.stride({"run", "completed.ssd", "--quiet", "--out", "again"}).exit_code == 0);
}

TEST_CASE("a source whose name differs by case or composition from one file's means this file") {
  const auto [source, name] = GENERATE(table<std::string, std::string>(
      {{"Plain.fmu", "plain.fmu"}, {"gr\u00F6\u00DFe.fmu", "gro\u0308\u00DFe.fmu"}}));
  const Workspace workspace(Parts{component("unit", source)});
  fs::copy_file(test_fmu("fmi2_relaxation"), workspace / name);
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("is taken for the file '" + name + "'"));
  fs::copy_file(workspace / name, workspace / "PLAIN.fmu");
  if (source == "Plain.fmu") {
    CHECK_THAT(input_error_of(workspace.run()), Contains("did you mean"));
  }
}

TEST_CASE(
    "a mapping applies to the end of a connection whose type it is for, and check prints it") {
  const auto inverted = [](std::string connection) {
    connection.replace(connection.rfind("/>"), 2,
                       "><ssc:BooleanMappingTransformation><ssc:MapEntry source=\"true\" "
                       "target=\"false\"/><ssc:MapEntry source=\"false\" target=\"true\"/>"
                       "</ssc:BooleanMappingTransformation></ssd:Connection>");
    return connection;
  };
  const Workspace workspace(
      Parts{component("valve", "fmi2_types.fmu") + component("other", "fmi2_types.fmu"),
            inverted(connection("valve.boolean.echo", "other.integer")) +
                inverted(connection("valve.integer.echo", "other.boolean"))});
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.1"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("other.integer.echo").back() == 1);
  const std::string checked = workspace.stride({"check", "test.ssd"}).out;
  CHECK_THAT(checked, Contains("  0 → 1, 1 → 0") && Contains("Boolean 0 → 1, 1 → 0"));
}

TEST_CASE("a value is converted between a Boolean and a number, as on a connection") {
  const auto value = [](const std::string& name, const std::string& text) {
    return "<ssv:Parameter name=\"" + name + "\">" + text + "</ssv:Parameter>";
  };
  const Workspace workspace(
      Parts{component("unit", "fmi2_types.fmu",
                      "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
                      "<ssv:ParameterSet "
                      "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" "
                      "version=\"1.0\" name=\"p\"><ssv:Parameters>" +
                          value("boolean", "<ssv:Real value=\"1.0\"/>") +
                          value("integer", "<ssv:Boolean value=\"true\"/>") +
                          "</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
                          "</ssd:ParameterBinding></ssd:ParameterBindings>")});
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.1"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("'1.0' is taken for true") && Contains("'true' is taken for 1"));
  CHECK(workspace.signals().numbers("unit.integer.echo").back() == 1);
}

TEST_CASE("a run of a system that ends where it starts has initial values, however it is said") {
  Parts parts{component("unit", "fmi2_relaxation.fmu")};
  parts.experiment = "<ssd:DefaultExperiment startTime=\"1\" stopTime=\"1\"/>\n";
  const Workspace workspace(parts);
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("the run ends where it starts, at 1 s"));
}

TEST_CASE("an FMU runs alone, with its own stop time, and is checked") {
  const Workspace workspace("");
  fs::copy_file(test_fmu("fmi2_relaxation"), workspace / "my unit.fmu");
  const auto [file, hosting] =
      GENERATE(table<std::string, std::string>({{"my unit.fmu", "--no-report"},
                                                {"my unit.fmu", "--isolate"},
                                                {"fmi2_relaxation.fmu", "--no-report"}}));
  const std::string name = fs::path(file).stem();
  const Outcome outcome =
      workspace.stride({"run", file, hosting, "--set", name + ".u=3", "--out", "out", "--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(workspace.signals().numbers(name + ".x").back() == Approx(3 - 2 * std::exp(-2)));
  const Outcome check = workspace.stride({"check", file});
  CHECK(check.exit_code == 0);
  CHECK_THAT(check.out, Contains(name));
}

TEST_CASE("an FMU is no scenario that could be completed, or packed from its folder") {
  const Workspace workspace("");
  fs::copy(stride::importer::UnpackedFmu(test_fmu("fmi2_relaxation")).folder(), workspace / "unit",
           fs::copy_options::recursive);
  fs::copy_file(test_fmu("fmi2_relaxation"), workspace / "unit.fmu");
  const std::string before = read(workspace / "unit.fmu");
  CHECK_THAT(input_error_of(workspace.stride({"complete", "unit.fmu"})), Contains("it is an FMU"));
  CHECK(read(workspace / "unit.fmu") == before);
  CHECK_THAT(input_error_of(workspace.stride({"pack", "unit", "-o", "unit.ssp"})),
             Contains("it is an FMU"));
  CHECK_THAT(workspace.stride({"run", "unit", "--out", "unit.fmu"}).err, Contains("unit.fmu"));
  CHECK(read(workspace / "unit.fmu") == before);
}

TEST_CASE("an FMU whose folder was packed runs, with a warning that names it") {
  const Workspace workspace(Parts{component("unit", "outer")});
  fs::create_directories(workspace / "outer/__MACOSX");
  fs::copy(stride::importer::UnpackedFmu(test_fmu("fmi2_relaxation")).folder(),
           workspace / "outer/inner", fs::copy_options::recursive);
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.1"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains(workspace.at("outer") + "'outer' has its modelDescription.xml as "
                                              "'inner/modelDescription.xml'; expected at its top"));
}

TEST_CASE("a linked system file finds its units beside the link, or beside the file itself") {
  const Workspace workspace(Parts{component("unit", "my.fmu")});
  fs::create_directories(workspace / "links");
  fs::create_symlink("../test.ssd", workspace / "links/linked.ssd");
  const Arguments missing{"run", "links/linked.ssd"};
  CHECK_THAT(input_error_of(workspace.stride(missing)),
             Contains("there is no unit 'links/my.fmu', or '") &&
                 Contains((workspace / "my.fmu").string() + "'"));
  const std::string place = GENERATE(as<std::string>(), "my.fmu", "links/my.fmu");
  fs::copy_file(test_fmu("fmi2_relaxation"), workspace / place);
  const Outcome outcome =
      workspace.stride({"run", "links/linked.ssd", "--quiet", "--stop", "0.1", "--out", "out"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.stride({"pack", "links/linked.ssd", "-o", "p.ssp"}).exit_code == 0);
}

TEST_CASE("each source of a linked system is looked for beside the link, then beside the file") {
  Workspace workspace(Parts{component("first", "links%20/near.fmu") +
                            component("second", "far.fmu") + component("third", "inner.fmu") +
                            component("fourth", "../up.fmu")});
  for (const char* folder : {"a/links /links ", "a/links /resources", "resources"}) {
    fs::create_directories(workspace / folder);
  }
  fs::create_symlink("../../test.ssd", workspace / "a/links /linked.ssd");
  for (const char* place :
       {"a/links /links /near.fmu", "far.fmu", "resources/inner.fmu", "a/up.fmu"}) {
    fs::copy_file(test_fmu("fmi2_relaxation"), workspace / place);
  }
  const Outcome outcome =
      workspace.stride({"run", "a/links /linked.ssd", "--quiet", "--stop", "0.1", "--out", "out"});
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.stride({"pack", "a/links /linked.ssd", "-o", "p.ssp"}).exit_code == 0);
}

TEST_CASE("a source that leads out of a package is told as it is written") {
  const Workspace workspace(Parts{component("unit", "../units/my.fmu")});
  fs::copy_file(workspace / "test.ssd", workspace / "SystemStructure.ssd");
  const auto document = workspace / "SystemStructure.ssd";
  stride::archive::Contents contents;
  contents["SystemStructure.ssd"].file = document;
  stride::archive::write_zip(workspace / "p.ssp", contents);
  CHECK_THAT(input_error_of(workspace.stride({"run", "p.ssp"})),
             Contains("p.ssp/SystemStructure.ssd:") &&
                 Contains("source=\"../units/my.fmu\" leads out of the package 'p.ssp'") &&
                 Contains("stride pack"));
}

TEST_CASE("a system with namespaces, flags and an experiment as they are written by mistake runs") {
  std::string text = scenario_text(
      Parts{component("first", " minimal.fmu ") + component("second", "minimal.fmu"),
            connection("first.y", "second.u"), "",
            "<ssd:DefaultExperiment stopTime=\"1\" stepSize=\"0.25\" tolerance=\"1e-4\"/>\n"});
  text = Umlaut::replaced(text, "http://ssp-standard.org/SSP1/SystemStructureDescription",
                          "https://ssp-standard.org/SSP1/SystemStructureDescription");
  text = Umlaut::replaced(text, "<ssd:Connection ",
                          "<ssd:Connection suppressUnitConversion=\"True\" ");
  const Workspace workspace(text);
  const Outcome outcome = workspace.run({"--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(
      outcome.err,
      Contains("SystemStructureDescription\" is taken for http://") &&
          Contains("suppressUnitConversion=\"True\" of <ssd:Connection> is taken for true") &&
          Contains("the step is 0.25 s, as stepSize of <ssd:DefaultExperiment>") &&
          Contains("the tolerance of <ssd:DefaultExperiment> is ignored"));
  CHECK(workspace.signals().numbers("time").size() == 5);
  const Outcome completed = workspace.stride({"complete", "test.ssd", "-o", "completed.ssd"});
  INFO(completed.err);
  CHECK(completed.exit_code == 0);
  CHECK_THAT(read(workspace / "completed.ssd"), !Contains("https:"));
  CHECK(workspace.stride({"run", "completed.ssd", "--quiet", "--out", "again"}).exit_code == 0);
}

TEST_CASE("a connection against the direction of its variables is used, with a warning") {
  const Workspace workspace(
      Parts{component("first", "minimal.fmu") + component("second", "minimal.fmu"),
            connection("second.u", "first.y")});
  const Outcome outcome = workspace.run({"--set", "first.u=1"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains(workspace.at("<ssd:Connection ") +
                                   "the connection starts at 'second.u', which is input"));
  CHECK(workspace.signals().numbers("second.y").back() > 0.1);
}
