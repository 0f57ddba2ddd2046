#include "master/loader/fmu/description/terminals.h"

#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::match_terminals;
using importer::Terminal;
using importer::TerminalPair;

namespace {

using Pairs = std::vector<TerminalPair>;

Terminal terminal(const std::string& rule, const std::string& prefix,
                  const std::vector<std::string>& members) {
  Terminal terminal{prefix, "kind", rule, {}};
  for (const std::string& member : members) {
    terminal.members.push_back({prefix + "." + member, member});
  }
  return terminal;
}

std::string mismatch(const Terminal& first, const Terminal& second) {
  return input_error([&] { match_terminals(first, second); });
}

}  // namespace

TEST_CASE("terminals are read, nested ones behind those around them") {
  const Scratch scratch;
  CHECK(importer::read_terminals(scratch.path(), "tank.fmu").empty());
  scratch.write("terminalsAndIcons/terminalsAndIcons.xml",
                "<fmiTerminalsAndIcons fmiVersion=\"3.0\"><Terminals>"
                "<Terminal name=\"Plug\" matchingRule=\"plug\" terminalKind=\"electric\">"
                "<TerminalMemberVariable variableName=\"u\" memberName=\"voltage\"/>"
                "<TerminalMemberVariable variableName=\"i\"/>"
                "<Terminal name=\"Case\" matchingRule=\"bus\"/></Terminal>"
                "</Terminals></fmiTerminalsAndIcons>");
  const auto terminals = importer::read_terminals(scratch.path(), "tank.fmu");
  REQUIRE(terminals.size() == 2);
  CHECK(terminals[0].name == "Plug");
  CHECK(terminals[0].kind == "electric");
  CHECK(terminals[0].matching_rule == "plug");
  REQUIRE(terminals[0].members.size() == 2);
  CHECK(terminals[0].members[0].variable == "u");
  CHECK(terminals[0].members[0].name == "voltage");
  CHECK(terminals[0].members[1].name == "i");
  CHECK(terminals[1].name == "Plug.Case");
}

TEST_CASE("plugs match by the names of all members, buses by those that both have") {
  const std::vector<std::string> both{"a", "b"};
  CHECK(match_terminals(terminal("plug", "x", both), terminal("plug", "y", {"b", "a"})) ==
        Pairs{{"x.a", "y.a"}, {"x.b", "y.b"}});
  CHECK_THAT(mismatch(terminal("plug", "x", both), terminal("plug", "y", {"a"})),
             Contains("the terminal 'y' has no member 'b'"));
  CHECK_THAT(mismatch(terminal("plug", "x", {"a"}), terminal("plug", "y", both)),
             Contains("the terminal 'x' has no member 'b'"));
  CHECK(match_terminals(terminal("bus", "x", both), terminal("bus", "y", {"b", "c"})) ==
        Pairs{{"x.b", "y.b"}});
}

TEST_CASE("sequences match by their order") {
  CHECK(match_terminals(terminal("sequence", "x", {"a", "b"}),
                        terminal("sequence", "y", {"c", "d"})) ==
        Pairs{{"x.a", "y.c"}, {"x.b", "y.d"}});
  CHECK_THAT(mismatch(terminal("sequence", "x", {"a"}), terminal("sequence", "y", {})),
             Contains("the terminal 'x' has 1 members, and 'y' has 0"));
}

TEST_CASE("what one transceiver sends the other receives") {
  const std::string rule = "org.fmi-ls-bus.transceiver";
  const Terminal node =
      terminal(rule, "node", {"Tx_Data", "Rx_Data", "Tx_Clock", "Rx_Clock", "Bus_Notifications"});
  const Terminal bus = terminal(rule, "bus", {"Tx_Data", "Rx_Data", "Tx_Clock", "Rx_Clock"});
  CHECK(match_terminals(node, bus) == Pairs{{"node.Tx_Data", "bus.Rx_Data"},
                                            {"node.Tx_Clock", "bus.Rx_Clock"},
                                            {"node.Rx_Data", "bus.Tx_Data"},
                                            {"node.Rx_Clock", "bus.Tx_Clock"}});
  CHECK_THAT(mismatch(node, terminal(rule, "bus", {"Rx_Data"})),
             Contains("the terminal 'bus' has no member 'Rx_Clock'"));
}

TEST_CASE("rules that differ or are not known are refused") {
  CHECK_THAT(mismatch(terminal("plug", "x", {}), terminal("bus", "y", {})),
             Contains("'x' has the matching rule 'plug', and 'y' has 'bus'"));
  CHECK_THAT(mismatch(terminal("own", "x", {}), terminal("own", "y", {})),
             Contains("the matching rule 'own' of the terminal 'x' is not known"));
}
