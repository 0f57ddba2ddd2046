#include "master/study/campaign/plan_check.h"

#include <catch2/catch.hpp>

#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Catch::Contains;

namespace {

Plan planned(const CampaignFolder& folder) {
  Campaign read = folder.read();
  const CampaignScenario scenario(read, "1.0");
  Plan plan(std::move(read), scenario.kinds(), scenario.fingerprints());
  check_plan(plan, scenario);
  return plan;
}

Plan planned(const std::string& text) { return planned(CampaignFolder(text)); }

std::string plan_error(const std::string& text) {
  return error_of([&] { planned(text); });
}

std::string set_error(const std::string& parameter, std::initializer_list<const char*> values) {
  return plan_error(campaign_text(deterministic(value_set(parameter, values))));
}

std::string draw_error(const std::string& parameter, const std::string& distribution) {
  return plan_error(campaign_text(stochastic(drawn(parameter, distribution), "500")));
}

const std::string kWire =
    "<stride:Intervention name='wire'><stride:Force variable='c.u' value='2' from='0.5' until='1'/>"
    "</stride:Intervention>";

std::string wire_error(const std::string& variation) {
  return plan_error(campaign_text(variation, kWire));
}

}  // namespace

TEST_CASE("numbers have the form of their variables") {
  const Plan plan = planned(campaign_text(
      stochastic(drawn("a.float64", uniform("0", "1")) + drawn("a.float32", uniform("0", "1")) +
                 drawn("a.int8", uniform("-3", "3")) +
                 drawn("a.uint64", "<PoissonDistribution expectedValue='5'/>") +
                 drawn("a.matrix[2,1]", uniform("0", "1")) +
                 drawn("a.colour",
                       "<ProbabilityDistributionSet><Element value='red' weight='1'/>"
                       "<Element value='4' weight='1'/></ProbabilityDistributionSet>") +
                 drawn("wire.from", uniform("0", "0.5"))),
      kWire + "<stride:Seed variables='a.int16 a.uint32'/>"));
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const Case row = plan.at(i);
    CHECK(row.values[0]->size() > 10);
    CHECK(std::to_string(std::stoi(*row.values[2])) == *row.values[2]);
    CHECK(std::to_string(std::stoul(*row.values[3])) == *row.values[3]);
    CHECK(row.values[6]->size() <= 14);
    const int seed = std::stoi(*row.values[7]);
    CHECK((seed >= 1 && seed <= 32767));
    CHECK(std::stoul(*row.values[8]) <= 4294967295UL);
  }
}

TEST_CASE("names that are not there are found with their lines, and with what is near") {
  CHECK_THAT(set_error("d.u", {"1"}), Contains("c.xosc:6: ") && Contains("'d"));
  CHECK_THAT(set_error("b.time_constat", {"1"}),
             Contains("c.xosc:6: unit 'b', variable 'time_constat'") && Contains("time_constant"));
  CHECK_THAT(set_error("a.matrix[3,1]", {"1"}), Contains("c.xosc:6: ") && Contains("matrix"));
  std::string text = campaign_text(deterministic(value_set("b.u", {"1"})));
  text.replace(text.find("x.ssd"), 5, "y.ssd");
  CHECK_THAT(plan_error(text), Contains("c.xosc:4: the scenario") && Contains("does not exist"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_set("b.u", {"1"})),
                                      "<stride:Aggregate name='n' signal='b.z' function='max'/>")),
             Contains("c.xosc:10: 'b.z' is not a signal with a number"));
  CHECK_THAT(
      plan_error(campaign_text(deterministic(value_set("b.u", {"1"})),
                               "<stride:Aggregate name='n' signal='b.y' function='at' at='2'/>")),
      Contains("c.xosc:10: 2 s is outside of the run, from 0 s to 1 s"));
}

TEST_CASE("texts that do not fit are all found, each with its line") {
  CHECK_THAT(
      set_error("b.time_constant", {"1", "-1"}),
      Contains("c.xosc:6: unit 'b', variable 'time_constant': the value -1 is out of range"));
  CHECK_THAT(set_error("a.int8", {"1", "1.5"}), Contains("'1.5' is not a value for it"));
  CHECK_THAT(set_error("a.colour", {"red", "pink"}),
             Contains("expected one of red (1), green (2), blue (4)"));
  CHECK_THAT(set_error("a.boolean", {"maybe"}), Contains("expected true or false"));
  const std::string both = plan_error(campaign_text(
      deterministic(value_set("b.time_constant", {"-1"}) + "\n" + value_set("a.int8", {"200"}))));
  CHECK_THAT(both,
             Contains("there are 2 mistakes") && Contains("c.xosc:6: ") && Contains("c.xosc:7: "));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_range("a.int8", "0", "0.5", "2")))),
             Contains("'0.5' is not a value for it"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_range("a.int8", "100", "10", "140")))),
             Contains("'140' is not a value for it"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_range("a.colour", "1", "1", "4")))),
             Contains("'3' is not a value for it"));
}

TEST_CASE("of drawn numbers the least and the greatest are looked at") {
  CHECK_THAT(draw_error("b.time_constant", "<NormalDistribution expectedValue='1' variance='1'/>"),
             Contains("c.xosc:6: unit 'b', variable 'time_constant': the value -") &&
                 Contains("is out of range, expected at least 1e-09, which some case has") &&
                 Contains("limit the distribution by a <Range>"));
  CHECK_THAT(draw_error("a.gain", uniform("0", "11")), Contains("expected at most 10"));
  CHECK(draw_error("a.gain", uniform("0", "10")) == "(no error)");
  CHECK_THAT(draw_error("a.int8", uniform("0", "1000")), Contains("within the range of Int8"));
  CHECK_THAT(draw_error("a.boolean", uniform("0", "1")), Contains("'a.boolean' is not a number"));
  CHECK_THAT(draw_error("a.matrix", uniform("0", "1")), Contains("'a.matrix' is not a number"));
}

TEST_CASE("parameters without effect, and two for one variable, are mistakes") {
  CHECK_THAT(set_error("c.u", {"1"}),
             Contains("c.xosc:6: 'c.u' is connected to 'b.y', whose value replaces this one"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_set("a.matrix", {"1 2 3 4 5 6"}) + "\n" +
                                                    value_set("a.matrix[1,2]", {"1"})))),
             Contains("c.xosc:7: 'a.matrix' and 'a.matrix[1,2]' are two sources for one variable"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_set("b.u", {"1"})),
                                      "<stride:Seed variables='a.string'/>")),
             Contains("c.xosc:10: 'a.string' is not a number, so it can be no seed"));
}

TEST_CASE("swaps are checked with each unit") {
  const auto swap = [](const std::string& file, const std::string& name = "device") {
    return "<stride:Swap name='" + name +
           "' component='b'><stride:Unit name='own'/><stride:Unit name='other' file='" + file +
           "'/></stride:Swap>";
  };
  const auto devices = [](const std::string& name = "device") {
    return deterministic(value_set("b.time_constant", {"1"}) + value_set(name, {"own", "other"}));
  };
  const std::string minimal = (unit_folder() / "minimal.fmu").string();
  const std::string types = (test_unit_folder() / "types.fmu").string();
  const Plan plan = planned(campaign_text(devices(), swap(minimal)));
  CHECK(plan.fingerprints().alternatives.size() == 1);
  CHECK(plan.hash(plan.at(0)) == plan.hash(plan.at(1)));  // the same unit
  CHECK_THAT(plan_error(campaign_text(devices(), swap(types))), Contains("'b'"));
  CHECK_THAT(plan_error(campaign_text(devices(), swap("nowhere.fmu"))),
             Contains("c.xosc:10: ") && Contains("nowhere.fmu"));
  CHECK_THAT(
      plan_error(campaign_text(deterministic(value_set("device", {"ohter"})), swap(minimal))),
      Contains("c.xosc:6: the swap 'device' has no unit 'ohter'") &&
          Contains("did you mean 'other'?"));
  CHECK_THAT(plan_error(campaign_text(devices("a"), swap(minimal, "a"))),
             Contains("a component of the scenario has the name of the swap 'a'"));
}

TEST_CASE("the interventions of each case are checked") {
  CHECK(wire_error(deterministic(value_set("wire.from", {"0", "0.75"}))) == "(no error)");
  CHECK_THAT(wire_error(deterministic(value_set("wire.from", {"0", "1"}))),
             Contains("it would end at 1 s, and begins at 1 s (case 1)"));
  CHECK_THAT(wire_error(stochastic(drawn("wire.until", uniform("0", "3")), "20")),
             Contains("is outside of the run") && Contains("(case "));
  CHECK_THAT(wire_error(deterministic(value_set("wire.value", {"high"}))),
             Contains("'high' is not a value for it"));
  CHECK_THAT(wire_error(deterministic(value_set("wire.enabled", {"perhaps"}))),
             Contains("'wire.enabled' of case 0: 'perhaps' is neither true nor false"));
  CHECK_THAT(plan_error(campaign_text(deterministic(value_set("b.u", {"1"})),
                                      "<stride:Intervention name='w'><stride:Force variable='b.u' "
                                      "from='0'/></stride:Intervention>")),
             Contains("c.xosc:10: unit 'b', variable 'u': it cannot be forced"));
}

TEST_CASE("fingerprints are of contents, not of paths") {
  const std::string text = campaign_text(deterministic(value_set("b.u", {"1"})));
  const CampaignFolder one(text), other(text);
  const Plan plan = planned(one);
  CHECK(plan.fingerprints().files.size() == 1);
  CHECK(plan.fingerprints().files.contains("x.ssd"));
  CHECK(plan.fingerprints().units.size() == 3);
  CHECK(planned(other).fingerprints().files == plan.fingerprints().files);
  std::string scenario = content(other / "x.ssd");
  scenario.replace(scenario.find("stopTime='1'"), 12, "stopTime='2'");
  other.write("x.ssd", scenario);
  CHECK(planned(other).fingerprints().files != plan.fingerprints().files);
  CHECK(planned(other).hash(planned(other).at(0)) != plan.hash(plan.at(0)));
}
