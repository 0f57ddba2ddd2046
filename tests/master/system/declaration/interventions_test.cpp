#include "master/system/declaration/interventions.h"

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_unit.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;

namespace {

/// A source, and a unit with what may be changed and what may not.
System changeable_system() {
  auto source = std::make_shared<UnitDescription>();
  auto unit = std::make_shared<UnitDescription>();
  const auto add = [](UnitDescription& to, const std::string& name, Causality causality,
                      Variability variability) {
    Variable& variable = to.variables.emplace_back();
    variable.name = name;
    variable.reference = static_cast<ValueReference>(to.variables.size());
    variable.type = ValueType::Float64;
    variable.causality = causality;
    variable.variability = variability;
  };
  add(*source, "y", Causality::Output, Variability::Continuous);
  add(*unit, "fed", Causality::Input, Variability::Continuous);
  add(*unit, "open", Causality::Input, Variability::Continuous);
  unit->variables.back().unit = "m/s";
  add(*unit, "tunable", Causality::Parameter, Variability::Tunable);
  add(*unit, "fixed", Causality::Parameter, Variability::Fixed);
  add(*unit, "y", Causality::Output, Variability::Continuous);
  SystemDeclaration declaration;
  declaration.components.push_back({"source", source, {}, {}});
  declaration.components.push_back({"unit", unit, {}, {}});
  declaration.connections.push_back({"source", "y", "unit", "fed", false, {}});
  return System(declaration);
}

std::vector<Intervention> resolved(const std::vector<std::string>& sets,
                                   const std::vector<std::string>& forces) {
  std::vector<InterventionDeclaration> declared;
  for (const std::string& text : sets) declared.push_back(parse_set_at(text));
  for (const std::string& text : forces) declared.push_back(parse_force(text));
  return resolve_interventions(changeable_system(), declared, {at(1), at(10)});
}

std::string mistake(const std::vector<std::string>& sets, const std::vector<std::string>& forces) {
  return error_of([&] { resolved(sets, forces); });
}

}  // namespace

TEST_CASE("interventions are sorted by their instants") {
  const auto found = resolved({"unit.open=3@7", "unit.tunable=2.5@1"},
                              {"unit.fed=4@2..3", "unit.fed@8.5..", "unit.fed=1@3..4"});
  REQUIRE(found.size() == 5);
  CHECK(found[0].from == at(1));
  CHECK(found[0].kind == Intervention::Kind::Set);
  CHECK(found[0].value->numbers<double>()[0] == 2.5);
  CHECK(found[1].until == at(3));
  CHECK(found[2].from == at(3));
  CHECK(found[4].kind == Intervention::Kind::Hold);
  CHECK(!found[4].until);
  CHECK(!found[4].value);
}

TEST_CASE("an instant counts picoseconds, and a value may contain the sign before it") {
  CHECK(parse_set_at("a.text=me@home@0.000000000001").from == Time(Duration(1)));
  CHECK(parse_set_at("a.text=me@home@2").value == "me@home");
  KnownNames names;
  for (const char* name : {"a.x", "a.x=y", "a.b=c"}) names.add(name, false);
  CHECK(parse_set_at("a.x=y=5@2", names).variable == "a.x=y");
  CHECK(parse_force("a.x=y=5@1..2", names).value == "5");
  CHECK(parse_force("a.b=c@1..2", names).kind == Intervention::Kind::Hold);
  CHECK(parse_drop("a.b=c@1..2", names).variable == "a.b=c");
  CHECK(parse_corrupt("a.b=c=3,4@1..", names).value == "3,4");
  CHECK(parse_force("a.text=@1..2").kind == Intervention::Kind::Force);
}

TEST_CASE("what is no intervention is an error with the form that is expected") {
  for (const std::string text : {"unit.open=3", "unit.open@3", "=3@4"}) {
    CHECK_THAT(mistake({text}, {}),
               Contains("--set-at " + text + ": expected COMPONENT.VARIABLE="));
  }
  for (const std::string text : {"unit.fed=3", "unit.fed=3@4", "=3@4..5", "@4..5"}) {
    CHECK_THAT(mistake({}, {text}),
               Contains("--force " + text + ": expected COMPONENT.VARIABLE[="));
  }
  CHECK_THAT(mistake({}, {"unit.fed=3@4"}), Contains("write --force unit.fed=3@4.. for a time"));
  CHECK_THAT(mistake({"unit.open=3@soon"}, {}), Contains("'soon' is not a number"));
  CHECK_THAT(mistake({}, {"unit.fed=3@1..-2"}), Contains("--force unit.fed=3@1..-2: "));
}

TEST_CASE("what cannot be changed so is an error with the reason and a way out") {
  CHECK_THAT(mistake({"unit.opne=3@4"}, {}),
             Contains("'unit.opne' is not a variable") && Contains("did you mean 'unit.open'?"));
  CHECK_THAT(mistake({"unit.fed=3@4"}, {}),
             Contains("is fed by 'source.y'") && Contains("--force"));
  CHECK_THAT(mistake({"unit.fixed=3@4"}, {}),
             Contains("is a fixed parameter") && Contains("--set"));
  CHECK_THAT(mistake({"unit.y=3@4"}, {}), Contains("is computed by the unit"));
  CHECK_THAT(mistake({}, {"unit.open=3@4..5"}),
             Contains("is not connected") && Contains("--set-at"));
  CHECK_THAT(mistake({}, {"unit.tunable=3@4..5"}), Contains("is not an input"));
  CHECK_THAT(mistake({"unit.open=much@4"}, {}), Contains("variable 'open'") && Contains("'much'"));
}

TEST_CASE("an instant outside of the run is an error") {
  CHECK_THAT(mistake({"unit.open=3@0.5"}, {}),
             Contains("0.5 s is outside of the run, from 1 s to 10 s") &&
                 Contains("leave it out, or start the run (--start) at 0.5 s or earlier"));
  CHECK_THAT(mistake({}, {"unit.fed=3@0.5..2"}),
             Contains("let it begin at 1 s, where the run does"));
  CHECK_THAT(mistake({}, {"unit.fed=3@0.5..0.7"}), Contains("leave it out, or start"));
  CHECK_THAT(
      mistake({}, {"unit.fed=3@4..11"}),
      Contains("11 s is outside of the run") && Contains("leave the end out for one that lasts"));
  CHECK_THAT(mistake({}, {"unit.fed=3@4..4"}), Contains("it would end at 4 s, and begins at 4 s"));
}

TEST_CASE("a value with a unit of measure is answered with the number that is meant") {
  CHECK_THAT(mistake({"unit.open=9km/h@4"}, {}),
             Contains("the value is a number in 'm/s'") && Contains("2.5"));
  CHECK_THAT(mistake({}, {"unit.fed=5km/h@4..5"}),
             Contains("write the number alone: the variable has no unit of measure"));
}

TEST_CASE("interventions that contradict each other are an error") {
  CHECK_THAT(mistake({"unit.open=3@4", "unit.open=5@4"}, {}), Contains("contradicts this one"));
  CHECK_THAT(mistake({}, {"unit.fed=3@2..5", "unit.fed@4.."}),
             Contains("from 2 s on, contradicts this one, from 4 s on"));
  CHECK_THAT(mistake({}, {"unit.fed=3@2..", "unit.fed=3@9.."}), Contains("contradicts this one"));
}

TEST_CASE("all mistakes are told at once") {
  CHECK_THAT(mistake({"unit.y=3@4", "unit.fixed=3@4"}, {"unit.open@1.."}),
             Contains("3 things do not fit"));
}

namespace {

/// A sender, and a receiver with two clocks.
System talking_system() {
  auto sender = Describe("sender")
                    .add("tick", ValueType::Clock, Causality::Output)
                    .add("bytes", ValueType::Binary, Causality::Output)
                    .clocked_by(0)
                    .add("number", ValueType::Int32, Causality::Output)
                    .clocked_by(0)
                    .done();
  auto receiver = Describe("receiver")
                      .add("tick", ValueType::Clock, Causality::Input)
                      .add("bytes", ValueType::Binary, Causality::Input)
                      .clocked_by(0)
                      .add("number", ValueType::Int32, Causality::Input)
                      .clocked_by(0)
                      .add("open", ValueType::Clock, Causality::Input)
                      .add("unheard", ValueType::Binary, Causality::Input)
                      .clocked_by(3)
                      .input("u")
                      .done();
  SystemDeclaration declaration;
  declaration.components.push_back({"a", sender, {}, {}});
  declaration.components.push_back({"b", receiver, {}, {}});
  for (const char* name : {"tick", "bytes", "number"}) {
    declaration.connections.push_back({"a", name, "b", name, false, {}});
  }
  return System(declaration);
}

std::vector<Intervention> disturbed(const std::vector<InterventionDeclaration>& declared) {
  return resolve_interventions(talking_system(), declared, {at(0), at(10)});
}

}  // namespace

TEST_CASE("messages are disturbed by their inputs or their clocks") {
  const auto found =
      disturbed({parse_drop("b.number@1..2"), parse_delay("b.tick=0.25@2..3"),
                 parse_corrupt("b.bytes@3..4"), parse_corrupt("b.tick=12,16,9@4..")});
  REQUIRE(found.size() == 4);
  for (const Intervention& intervention : found) CHECK(intervention.clock == VariableId{1, 0});
  CHECK(found[0].kind == Intervention::Kind::Drop);
  CHECK(found[0].id == VariableId{1, 2});
  CHECK(found[1].kind == Intervention::Kind::Delay);
  CHECK(found[1].delay == duration_from_seconds(0.25));
  CHECK(found[2].bits == 1);
  CHECK(found[2].header == 0);
  CHECK(found[2].seed == 1);
  CHECK(found[3].bits == 12);
  CHECK(found[3].header == 16);
  CHECK(found[3].seed == 9);
  CHECK(!found[3].until);
}

TEST_CASE("messages that cannot be disturbed so are an error") {
  const auto error = [](const InterventionDeclaration& declared) {
    return error_of([&] { disturbed({declared}); });
  };
  CHECK_THAT(error(parse_drop("b.u@1..")),
             Contains("it cannot be disturbed, since it receives no messages") &&
                 Contains("choose an input clock"));
  CHECK_THAT(error(parse_drop("a.bytes@1..")), Contains("it receives no messages"));
  CHECK_THAT(error(parse_drop("b.open@1..")), Contains("it is not connected"));
  CHECK_THAT(error(parse_drop("b.unheard@1..")), Contains("it is not connected"));
  CHECK_THAT(error(parse_corrupt("b.number@1..")), Contains("it receives no Binary values"));
  CHECK_THAT(error(parse_delay("b.bytes=0@1..")), Contains("a delay of 0 s is not above 0 s"));
  CHECK_THAT(error(parse_delay("b.bytes=soon@1..")), Contains("soon"));
  CHECK_THAT(error(parse_corrupt("b.bytes=0@1..")), Contains("0 bits leave messages as they are"));
  CHECK_THAT(error(parse_corrupt("b.bytes=1,-2@1..")),
             Contains("'-2' is not a number of bytes of a header: expected a whole number"));
  CHECK_THAT(error(parse_force("b.bytes=00@1..")),
             Contains("it cannot be forced, since it is a message") &&
                 Contains("disturb it: <stride:Drop>"));
  CHECK_THAT(error_of([] { parse_drop("b.bytes=1@1.."); }),
             Contains("--drop b.bytes=1@1..: expected COMPONENT.VARIABLE@FROM..[UNTIL]"));
  CHECK_THAT(error_of([] { parse_delay("b.bytes@1.."); }),
             Contains("expected COMPONENT.VARIABLE=SECONDS@"));
  CHECK_THAT(error_of([] { parse_corrupt("b.bytes=1,2,x@1.."); }),
             Contains("expected COMPONENT.VARIABLE[=BITS[,HEADER[,SEED]]]@"));
}

TEST_CASE("two interventions on the messages of one clock contradict each other") {
  CHECK_THAT(error_of([] {
               disturbed({parse_drop("b.bytes@1..3"), parse_delay("b.number=1@2.5..")});
             }),
             Contains("contradicts this one"));
  CHECK(disturbed({parse_drop("b.bytes@1..3"), parse_delay("b.number=1@3..")}).size() == 2);
}
