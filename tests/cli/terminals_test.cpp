// Terminals of two units, connected as one.
#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Two integrators in a row, whose input and output are terminals with a member "signal", the
/// second one's by another name if it is given.
struct Integrators {
  Workspace workspace;

  explicit Integrators(const std::string& annotation, const std::string& member = "signal")
      : workspace(
            Parts{component("first", "first") + component("second", "second"), "", annotation}) {
    add("first", "Out", "y", "signal");
    add("second", "In", "u", member);
  }
  void add(const std::string& name, const std::string& terminal, const std::string& variable,
           const std::string& member) const {
    const stride::importer::UnpackedFmu unpacked(test_fmu("faulty"));
    fs::copy(unpacked.folder(), workspace / name, fs::copy_options::recursive);
    workspace.scratch().write(
        name + "/terminalsAndIcons/terminalsAndIcons.xml",
        "<fmiTerminalsAndIcons fmiVersion=\"3.0\"><Terminals><Terminal name=\"" + terminal +
            "\" matchingRule=\"plug\"><TerminalMemberVariable variableName=\"" + variable +
            "\" memberName=\"" + member + "\"/></Terminal></Terminals></fmiTerminalsAndIcons>");
  }
  Outcome check() const { return workspace.stride({"check", "test.ssd"}); }
};

std::string connection_of(const std::string& start, const std::string& start_terminal,
                          const std::string& end, const std::string& end_terminal) {
  return "<stride:TerminalConnection startElement=\"" + start + "\" startTerminal=\"" +
         start_terminal + "\" endElement=\"" + end + "\" endTerminal=\"" + end_terminal + "\"/>\n";
}

}  // namespace

TEST_CASE("terminals are connected from outputs to inputs, whichever is named first") {
  for (const std::string& annotation : {connection_of("first", "Out", "second", "In"),
                                        connection_of("second", "In", "first", "Out")}) {
    const Integrators units(annotation);
    const Outcome outcome = units.check();
    CHECK(outcome.err == "");
    CHECK_THAT(outcome.out, Contains("1 connection,") && Contains("first.y  second.u"));
    CHECK(units.workspace.run({"--quiet"}).exit_code == 0);
  }
}

TEST_CASE("'stride inspect' lists terminals with their members") {
  const Integrators units("");
  const Outcome outcome = units.workspace.stride({"inspect", "first"});
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, Contains("terminal  kind  matching rule  member  variable\n") &&
                              Contains("\n  Out             plug           signal  y\n"));
}

TEST_CASE("'stride inspect' shows the variables of a unit whose terminals are malformed") {
  const Integrators units("");
  units.workspace.scratch().write("first/terminalsAndIcons/terminalsAndIcons.xml", "<broken");
  const Outcome outcome = units.workspace.stride({"inspect", "first"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("variable"));
  CHECK_THAT(outcome.err, Contains("warning: ") && Contains("terminalsAndIcons.xml"));
}

TEST_CASE("a terminal or a component that is not there has the nearest that is") {
  const std::string terminal = connection_of("first", "Outt", "second", "In");
  const Integrators misspelt(terminal);
  CHECK_THAT(input_error_of(misspelt.check()),
             Contains(misspelt.workspace.at("<stride:TerminalConnection") +
                      "unit 'first': the unit has no terminal 'Outt'") &&
                 Contains("'Out'"));
  CHECK_THAT(input_error_of(Integrators(connection_of("frist", "Out", "second", "In")).check()),
             Contains("there is no component 'frist'") && Contains("first"));
}

TEST_CASE("terminals that do not match are an error with what is missing") {
  const Integrators units(connection_of("first", "Out", "second", "In"), "pressure");
  CHECK_THAT(input_error_of(units.check()),
             Contains("cannot connect the terminals of 'first' and 'second': the terminal 'In' has "
                      "no member 'signal', which the other needs"));
}

TEST_CASE("complete writes the connections that terminals make, once") {
  const Integrators units(connection_of("first", "Out", "second", "In"));
  REQUIRE(units.workspace.stride({"complete", "test.ssd"}).exit_code == 0);
  const std::string completed = read(units.workspace / "test.ssd");
  CHECK_THAT(completed, Contains("<ssd:Connection startElement=\"first\" startConnector=\"y\" "
                                 "endElement=\"second\" endConnector=\"u\"/>"));
  REQUIRE(units.workspace.stride({"complete", "test.ssd"}).exit_code == 0);
  CHECK(read(units.workspace / "test.ssd") == completed);
  const Outcome outcome = units.check();
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, Contains("1 connection,"));
}
