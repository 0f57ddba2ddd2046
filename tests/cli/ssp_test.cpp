// What the System Structure and Parameterization standard says about values and connections, in a
// run.
#include "master/base/archive/zip.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string value(const std::string& name, const std::string& number) {
  return "<ssv:Parameter name=\"" + name + "\"><ssv:Float64 value=\"" + number +
         "\"/></ssv:Parameter>\n";
}

std::string parameter_set(const std::string& parameters) {
  return "<ssv:ParameterSet version=\"2.0\" name=\"p\" "
         "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" "
         "xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\"><ssv:Parameters>\n" +
         parameters + "</ssv:Parameters></ssv:ParameterSet>";
}

std::string bindings(const std::string& parameters, const std::string& attributes = "") {
  return "<ssd:ParameterBindings><ssd:ParameterBinding " + attributes + "><ssd:ParameterValues>" +
         parameter_set(parameters) +
         "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>\n";
}

/// A connector of a system, or a connection of one, on a line of its own.
std::string system_connector(const std::string& name, const std::string& kind) {
  return "<ssd:Connector name=\"" + name + "\" kind=\"" + kind +
         "\"><ssc:Float64/></ssd:Connector>\n";
}
std::string connection_element(const std::string& attributes) {
  return "<ssd:Connection " + attributes + "/>\n";
}
std::string start_of(const std::string& connector) {
  return "startConnector=\"" + connector + "\" ";
}
std::string start_of(const std::string& element, const std::string& connector) {
  return "startElement=\"" + element + "\" " + start_of(connector);
}
std::string end_of(const std::string& connector) { return "endConnector=\"" + connector + "\""; }
std::string end_of(const std::string& element, const std::string& connector) {
  return "endElement=\"" + element + "\" " + end_of(connector);
}

struct System {
  std::string connectors = "";
  std::string elements = "";
  std::string connections = "";
  std::string parameters = "";
};

std::string system_text(const std::string& name, const System& system) {
  return "<ssd:System name=\"" + name + "\"><ssd:Connectors>\n" + system.connectors +
         "</ssd:Connectors>" + (system.parameters.empty() ? "" : bindings(system.parameters)) +
         "<ssd:Elements>\n" + system.elements + "</ssd:Elements><ssd:Connections>\n" +
         system.connections + "</ssd:Connections></ssd:System>\n";
}

std::string text_of(const System& system, const std::string& behind = "",
                    const std::string& stop = " stopTime=\"0.01\"") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<ssd:SystemStructureDescription version=\"2.0\" name=\"test\" "
         "xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\" "
         "xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\" "
         "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">\n" +
         system_text("root", system) + behind + "<ssd:DefaultExperiment" + stop +
         "/>\n</ssd:SystemStructureDescription>\n";
}

/// The last value of a signal in a run that must be good.
double last(const Workspace& workspace, const std::string& signal, Arguments further = {}) {
  further.insert(further.end(), {"--quiet", "--no-report", "--signals", signal});
  const Outcome outcome = workspace.run(further);
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return workspace.signals().numbers(signal).back();
}

}  // namespace

TEST_CASE("a connection from a system's connector decides over a value for the element") {
  const Workspace workspace(
      text_of({.connectors = system_connector("K", "parameter") + system_connector("U", "input"),
               .elements = component("f", "gain.fmu"),
               .connections = connection_element(start_of("K") + end_of("f", "k")) +
                              connection_element(start_of("U") + end_of("f", "u")),
               .parameters =
                   value("K", "30") + value("U", "-20") + value("f.k", "10") + value("f.u", "5")}));
  CHECK(last(workspace, "f.k") == 30);
  CHECK(last(workspace, "f.y") == -600);
  CHECK(last(workspace, "f.k", {"--set", "f.k=2"}) == 2);
  CHECK(last(workspace, "f.k", {"--set", "K=3"}) == 3);
}

TEST_CASE("a calculated parameter and a constant may be connected to a parameter") {
  const std::string chain = connection_element(start_of("a", "twice") + end_of("b", "k")) +
                            connection_element(start_of("b", "twice") + end_of("c", "k")) +
                            connection_element(start_of("a", "seven") + end_of("d", "k"));
  const std::string units = component("c", "gain.fmu") + component("b", "gain.fmu") +
                            component("a", "gain.fmu") + component("d", "gain.fmu");
  const Workspace workspace(
      text_of({.elements = units, .connections = chain, .parameters = value("a.k", "3")}));
  CHECK(last(workspace, "c.k") == 12);
  CHECK(last(workspace, "c.twice") == 24);
  CHECK(last(workspace, "d.k") == 7);
  CHECK(last(workspace, "c.k", {"--isolate"}) == 12);
  const Workspace wrong(
      text_of({.elements = units,
               .connections = connection_element(start_of("a", "y") + end_of("b", "k"))}));
  CHECK_THAT(input_error_of(wrong.run()), Contains("'b.k' is not an input but parameter"));
}

TEST_CASE("an output of the system that its input leads to is recorded") {
  const Workspace workspace(
      text_of({.connectors = system_connector("I", "input") + system_connector("O", "output"),
               .elements = component("a", "gain.fmu"),
               .connections = connection_element(start_of("I") + end_of("O")),
               .parameters = value("I", "4")}));
  CHECK(last(workspace, "O") == 4);
  CHECK(workspace.run({"--no-report"}).exit_code == 0);
  CHECK(workspace.signals().has("O"));
}

TEST_CASE("connectors of inner systems are recorded on demand") {
  const std::string inner = system_text(
      "s", {.connectors = system_connector("u", "input") + system_connector("y", "output"),
            .elements = component("c", "gain.fmu"),
            .connections = connection_element(start_of("u") + end_of("c", "u")) +
                           connection_element(start_of("c", "y") + end_of("y"))});
  const Workspace workspace(
      text_of({.elements = component("a", "gain.fmu") + inner,
               .connections = connection_element(start_of("a", "seven") + end_of("s", "u"))}));
  CHECK(last(workspace, "s.u") == 7);
  CHECK(last(workspace, "s.y") == 7);
  CHECK(workspace.run({"--no-report"}).exit_code == 0);
  CHECK_FALSE(workspace.signals().has("s.y"));
}

TEST_CASE("a connection that leads nowhere is a warning in check and run") {
  const Workspace workspace(
      text_of({.elements = system_text("s", {.connectors = system_connector("o", "output"),
                                             .elements = component("a", "gain.fmu")}) +
                           component("c", "gain.fmu"),
               .connections = connection_element(start_of("s", "o") + end_of("c", "u"))}));
  const std::string place = workspace.at(start_of("s", "o"));
  for (const Outcome& outcome : {workspace.run(), workspace.stride({"check", "test.ssd"})}) {
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains(place + "the connector 's.o' has no source"));
  }
}

TEST_CASE("what has one name twice is said in check and run") {
  const auto errors = [](const std::string& text) {
    const Workspace workspace(text);
    const std::string error = input_error_of(workspace.run());
    CHECK(input_error_of(workspace.stride({"check", "test.ssd"})) == error);
    return error;
  };
  const std::string unit = component("a", "gain.fmu");
  CHECK_THAT(
      errors(text_of({.elements = unit, .parameters = value("a.k", "1") + value("a.k", "2")})),
      Contains("test.ssd:") && Contains("two parameters are named 'a.k'"));
  CHECK_THAT(errors(text_of({.elements = unit},
                            "<ssd:Units><ssc:Unit name=\"L\"><ssc:BaseUnit m=\"1\"/></ssc:Unit>"
                            "<ssc:Unit name=\"L\"><ssc:BaseUnit m=\"2\"/></ssc:Unit></ssd:Units>")),
             Contains("two units of measure are named 'L'"));
  CHECK_THAT(
      errors(text_of({.elements = component("B.C", "gain.fmu") +
                                  system_text("B", {.elements = component("C", "gain.fmu")})})),
      Contains("two components are named 'B.C'"));
}

TEST_CASE("the name of an enumeration's item may hold blanks") {
  const Workspace workspace(text_of({.elements = component("f", "gain.fmu")}));
  CHECK(last(workspace, "f.mode_out", {"--set", "f.mode=Option 2"}) == 2);
  CHECK(last(workspace, "f.mode_out", {"--set-at", "f.mode=Option 2@0.005"}) == 2);
}

TEST_CASE("names that hold a '=' are set, held and replaced by name") {
  const Workspace workspace(text_of({.elements = component("a=b", "gain.fmu")}));
  CHECK(last(workspace, "a=b.c=d", {"--set", "a=b.k=1=2.5"}) == 2.5);
  CHECK(last(workspace, "a=b.c=d", {"--set-at", "a=b.k=1=3@0.005"}) == 3);
  CHECK(last(workspace, "a=b.y", {"--swap", "a=b=gain.fmu", "--set", "a=b.u=2"}) == 2);
}

TEST_CASE("parameters of the command line may be mapped") {
  const Workspace workspace(text_of({.elements = component("a", "gain.fmu")}));
  workspace.scratch().write("p.ssv", parameter_set(value("gain", "5") + value("other", "6")));
  workspace.scratch().write(
      "p.ssm",
      "<ssm:ParameterMapping version=\"2.0\" "
      "xmlns:ssm=\"http://ssp-standard.org/SSP1/SystemStructureParameterMapping\">"
      "<ssm:MappingEntry source=\"gain\" target=\"a.k\"/></ssm:ParameterMapping>");
  CHECK(last(workspace, "a.k", {"--parameters", "p.ssv:p.ssm"}) == 5);
  CHECK_THAT(input_error_of(workspace.run({"--parameters", "p.ssv:none.ssm"})),
             Contains("none.ssm"));
}

TEST_CASE("check needs no stop time") {
  const Workspace workspace(text_of({.elements = component("a", "gain.fmu")}, "", ""));
  const Outcome outcome = workspace.stride({"check", "test.ssd"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("from 0 s on, without a stop time"));
  CHECK_THAT(input_error_of(workspace.run()), Contains("there is no stop time"));
}

TEST_CASE("check and inspect list the systems of a package") {
  const Workspace workspace(text_of({.elements = component("a", "gain.fmu")}));
  stride::archive::Contents contents;
  contents["SystemStructure.ssd"].text = text_of({.elements = component("a", "gain.fmu")});
  contents["Other.ssd"].text = text_of({.elements = component("b", "gain.fmu")});
  stride::archive::write_zip(workspace / "p.ssp", contents);
  for (const char* command : {"check", "inspect"}) {
    const Outcome outcome = workspace.stride({command, "p.ssp"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("Variants") && Contains("p.ssp/Other.ssd") &&
                                Contains("p.ssp/SystemStructure.ssd"));
  }
  CHECK_THAT(workspace.stride({"inspect", "p.ssp/Other.ssd"}).out, Contains("b"));
}

TEST_CASE("what is completed has the sizes that the scenario gives") {
  const Workspace workspace(
      text_of({.elements = component("a", "resizable.fmu"),
               .parameters = "<ssv:Parameter name=\"a.n\"><ssv:UInt64 value=\"3\"/></ssv:Parameter>"
                             "<ssv:Parameter name=\"a.u\"><ssv:Float64><ssv:Value value=\"1\"/>"
                             "<ssv:Value value=\"2\"/><ssv:Value value=\"3\"/></ssv:Float64>"
                             "<ssc:Dimension size=\"3\"/></ssv:Parameter>"}));
  CHECK(workspace.stride({"complete", "test.ssd"}).exit_code == 0);
  CHECK_THAT(read(workspace / "test.ssd"), Contains("<ssc:Dimension size=\"3\"/></ssd:Connector>"));
  const Outcome outcome = workspace.run({"--no-report"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("a.y[3]").back() == 3);
}

TEST_CASE("a scenario that uses one of its systems more than once is completed beside itself") {
  std::string inner = system_text("s", {.elements = component("c", "gain.fmu")});
  inner.insert(inner.find(" name=") + 1, "id=\"s\" ");
  const Workspace workspace(text_of({.elements = inner + component("t", "#s")}));
  const Outcome outcome = workspace.stride({"complete", "test.ssd", "-o", "whole.ssd"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.stride({"check", "whole.ssd"}).exit_code == 0);
}

TEST_CASE("a value in a unit of measure that nothing defines is an error that names near ones") {
  const std::string binding =
      "<ssv:Parameter name=\"a.time_constant\"><ssv:Float64 value=\"2\" "
      "unit=\"UNIT\"/></ssv:Parameter>\n";
  const auto error = [&](const std::string& unit) {
    std::string text = binding;
    text.replace(text.find("UNIT"), 4, unit);
    const Workspace workspace(
        text_of({.elements = component("a", "minimal.fmu"), .parameters = text}));
    return input_error_of(workspace.run());
  };
  CHECK_THAT(error("sek"), Contains("the value is in 'sek', the variable in 's'; nothing defines "
                                    "'sek'") &&
                               Contains("did you mean 'sec'?"));
  CHECK_THAT(error("fortnight"), Contains("known are: s, ") && Contains("min"));
  CHECK_THAT(error("m"), !Contains("nothing defines") && Contains("in the variable's unit"));
}

TEST_CASE("names in connectors and parameters that nothing defines are said") {
  const std::string connectors =
      "<ssd:Connectors><ssd:Connector name=\"mode\" kind=\"input\"><ssc:Enumeration name=\"none\"/>"
      "</ssd:Connector></ssd:Connectors>";
  const Workspace workspace(
      text_of({.elements = component("a", "gain.fmu", connectors),
               .parameters = "<ssv:Parameter name=\"a.k\"><ssv:Float64 value=\"2\" unit=\"sack\"/>"
                             "</ssv:Parameter>\n"}));
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("nothing defines the enumeration 'none'") &&
                              Contains("nothing defines 'sack', the unit of measure of the value"));
  const Workspace misspelt(
      text_of({.elements = component("a", "gain.fmu",
                                     "<ssd:Connectors><ssd:Connector name=\"u\" kind=\"input"
                                     "\"><ssc:Float64 units=\"m\"/></ssd:Connector>"
                                     "</ssd:Connectors>")}));
  CHECK_THAT(input_error_of(misspelt.run()),
             Contains("has no attribute 'units'") && Contains("did you mean 'unit'?"));
}

TEST_CASE("a number with its unit of measure on the command line gets the right form as a hint") {
  const Workspace workspace(
      text_of({.elements = component("a", "minimal.fmu") + component("g", "gain.fmu")}));
  const auto error = [&](const std::string& set) {
    return input_error_of(workspace.run({"--set", set}));
  };
  const std::string in = "the value is a number in 's', the variable's unit of measure";
  CHECK_THAT(error("a.time_constant=90ms"), Contains(in + ": 0.09\n"));
  CHECK_THAT(error("a.time_constant=2 min"), Contains(in + ": 120\n"));
  CHECK_THAT(error("a.time_constant=3foo"), Contains(in + "; nothing defines 'foo'"));
  CHECK_THAT(error("a.time_constant=3m"), Contains(in + ", and 'm' cannot be converted"));
  CHECK_THAT(error("g.k=3m"), Contains("write the number alone"));
  CHECK_THAT(error("a.time_constant=1,5"), Contains("hint: numbers have a decimal point: 1.5"));
}

TEST_CASE("an output of the system without a value is said to be left out") {
  const Workspace workspace(
      text_of({.connectors = system_connector("I", "input") + system_connector("O", "output") +
                             system_connector("P", "output"),
               .elements = component("a", "gain.fmu"),
               .connections = connection_element(start_of("I") + end_of("O"))}));
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("the output 'O' is not recorded, since the input 'I'") &&
                              Contains("--set I=VALUE") &&
                              Contains("nothing is connected to the output 'P'"));
  CHECK_FALSE(workspace.signals().has("O"));
  CHECK_THAT(workspace.run({"--set", "I=3"}).err, !Contains("'O'"));
}
