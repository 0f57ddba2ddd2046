#include "master/study/campaign/plan.h"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Catch::Contains;
using KindType = ValueKind::Type;

namespace {

std::string row_text(const Plan& plan, std::uint64_t index) {
  std::string text;
  for (const Text& value : plan.at(index).values) {
    text += (text.empty() ? "" : " ") + value.value_or("-");
  }
  return text;
}

const std::string kSwapAndWire =
    "<stride:Swap name='device' component='s'><stride:Unit name='old'/>"
    "<stride:Unit name='new' file='new.fmu'/></stride:Swap>"
    "<stride:Intervention name='wire'><stride:Force variable='a.u' value='2' from='0.5' "
    "until='1'/></stride:Intervention>";

}  // namespace

TEST_CASE("a deterministic plan has all combinations, of which the last factor changes fastest") {
  const Plan plan = plan_of(campaign_text(
      deterministic(value_set("a.x", {"1", "2"}) +
                    "<DeterministicMultiParameterDistribution><ValueSetDistribution>"
                    "<ParameterValueSet><ParameterAssignment parameterRef='a.p' value='p'/>"
                    "</ParameterValueSet><ParameterValueSet>"
                    "<ParameterAssignment parameterRef='a.q' value='q'/></ParameterValueSet>"
                    "</ValueSetDistribution></DeterministicMultiParameterDistribution>" +
                    value_range("a.y", "0.1", "0.1", "0.3"))));
  REQUIRE(plan.size() == 12);
  CHECK(row_text(plan, 0) == "1 p - 0.1");
  CHECK(row_text(plan, 1) == "1 p - 0.2");
  CHECK(row_text(plan, 3) == "1 - q 0.1");
  CHECK(row_text(plan, 11) == "2 - q 0.3");
  std::set<std::string> rows;
  for (std::uint64_t i = 0; i < 12; ++i) rows.insert(row_text(plan, i));
  CHECK(rows.size() == 12);
}

TEST_CASE("a case is the same whatever was asked before, by whatever plan object") {
  const std::string text = campaign_text(
      stochastic(drawn("a.x", uniform("0", "1")) +
                     drawn("a.y", "<NormalDistribution expectedValue='1' variance='4'/>"),
                 "100"),
      "<stride:Sampling method='sobol'/><stride:Seed variables='a.seed b.seed'/>");
  const Plan plan = plan_of(text), other = plan_of(text);
  std::vector<std::string> rows;
  for (std::uint64_t i = 0; i < 100; ++i) rows.push_back(row_text(plan, i));
  for (const std::uint64_t i : {99, 17, 0, 42, 17}) {
    CHECK(row_text(plan, i) == rows[i]);
    CHECK(row_text(other, i) == rows[i]);
    CHECK(plan.hash(plan.at(i)) == other.hash(other.at(i)));
    CHECK(plan.at(i).seed == other.at(i).seed);
  }
}

TEST_CASE("whole numbers that limits cannot tell apart are not drawn") {
  const auto plan = [](const std::string& distribution) {
    plan_of(campaign_text(stochastic(drawn("a.x", distribution))), KindType::Whole);
  };
  CHECK_THROWS_WITH(plan(uniform("9007199254740993", "9007199254740996")),
                    Contains("from 2^53 on cannot be drawn"));
  CHECK_THROWS_WITH(plan(uniform("-9223372036854775808", "0")), Contains("2^53"));
  CHECK_NOTHROW(plan(uniform("-9007199254740991", "9007199254740991")));
}

TEST_CASE("more runs leave those that were there as they are, if they are independent") {
  const auto text = [](const char* runs) {
    return campaign_text(stochastic(drawn("a.x", uniform("0", "1")), runs),
                         "<stride:Seed variables='a.seed'/>");
  };
  const Plan few = plan_of(text("10")), many = plan_of(text("1000"));
  for (std::uint64_t i = 0; i < 10; ++i) {
    CHECK(row_text(few, i) == row_text(many, i));
    CHECK(few.hash(few.at(i)) == many.hash(many.at(i)));
  }
}

TEST_CASE("the random seed changes every draw, and each case has a seed of its own") {
  const std::string text = campaign_text(stochastic(drawn("a.x", uniform("0", "1")), "1000"),
                                         "<stride:Seed variables='a.s b.s'/>");
  std::string other_text = text;
  other_text.replace(other_text.find("randomSeed='7'"), 14, "randomSeed='8'");
  const Plan plan = plan_of(text), other = plan_of(other_text);
  std::set<std::uint64_t> seeds;
  std::set<std::string> of_units;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case row = plan.at(i);
    CHECK(row.values[0] != other.at(i).values[0]);
    CHECK(row.values[1] != row.values[2]);
    seeds.insert(row.seed);
    of_units.insert({*row.values[1], *row.values[2]});
  }
  CHECK(seeds.size() == 1000);
  CHECK(of_units.size() == 2000);
}

TEST_CASE("a request holds start values, swaps and interventions") {
  const Plan plan = plan_of(
      campaign_text(deterministic(value_set("a.x", {"1"}) + value_set("device", {"old", "new"}) +
                                  value_set("wire.value", {"3"}) +
                                  value_set("wire.enabled", {"true", "false"})),
                    kSwapAndWire),
      KindType::Text);
  const auto request = plan.request(plan.at(2));
  CHECK(request.scenario.filename() == "x.ssd");
  REQUIRE(request.parameters.size() == 1);
  CHECK(request.parameters[0].name == "a.x");
  CHECK(request.parameters[0].value == "1");
  CHECK(request.parameters[0].where.line == 6);
  CHECK(request.swaps == std::vector<std::string>{"s=new.fmu"});
  REQUIRE(request.interventions.size() == 1);
  CHECK(request.interventions[0].value == "3");
  CHECK(plan.request(plan.at(0)).swaps.empty());
  CHECK(plan.request(plan.at(1)).interventions.empty());
  CHECK_THAT(plan.command(plan.at(2)),
             Contains("x.ssd --swap s=new.fmu --set a.x=1 --force a.u=3@0.5..1"));
}

TEST_CASE("arguments are words of a shell") {
  const Plan plan = plan_of(campaign_text(deterministic(value_set("a.x", {"it&apos;s 5 $", ""}))),
                            KindType::Text);
  CHECK_THAT(plan.command(plan.at(0)), Catch::EndsWith("x.ssd --set 'a.x=it'\\''s 5 $'"));
  CHECK_THAT(plan.command(plan.at(1)), Catch::EndsWith("--set a.x="));
}

TEST_CASE("the hash of a case stands for all that decides its result") {
  const std::string text = campaign_text(
      deterministic(value_set("a.x", {"1", "1", "2"}) + value_set("device", {"old", "new"})),
      kSwapAndWire);
  const Plan plan = plan_of(text, KindType::Text);
  const auto hash = [&](std::uint64_t index) { return plan.hash(plan.at(index)); };
  CHECK(hash(0).size() == 64);
  CHECK(hash(0) == hash(2));  // the same settings at another index
  CHECK(hash(0) != hash(4));
  CHECK(hash(0) != hash(1));
  Fingerprints changed = plan.fingerprints();
  changed.alternatives[{"device", "new"}] = "another";
  const Plan with_other_unit(plan.campaign(), plan.kinds(), changed);
  CHECK(with_other_unit.hash(with_other_unit.at(0)) == hash(0));
  CHECK(with_other_unit.hash(with_other_unit.at(1)) != hash(1));
  changed = plan.fingerprints();
  changed.version = "2.0";
  const Plan with_other_version(plan.campaign(), plan.kinds(), changed);
  CHECK(with_other_version.hash(with_other_version.at(0)) != hash(0));
}

TEST_CASE("what no plan can be made of") {
  const auto error = [](const std::string& text, KindType type = KindType::Float64) {
    return error_of([&] { plan_of(text, type); });
  };
  CHECK_THAT(error(campaign_text(stochastic(drawn("a.x", uniform("0", "1")), "10000001"))),
             Contains("the campaign has 10000001 cases, which is more than 10000000"));
  CHECK(error(campaign_text(stochastic(drawn("a.x", uniform("0", "1")), "10000000"))) ==
        "(no error)");
  CHECK_THAT(error(campaign_text(deterministic(value_range("a.x", "0", "1", "9999") +
                                               value_range("a.y", "0", "1", "9999")))),
             Contains("which is more than 10000000"));
  CHECK_THAT(error(campaign_text(deterministic(value_set("host", {"1"})))),
             Contains("c.xosc:6: 'host' is the name of a column that a table of cases may have"));
  CHECK_THAT(
      error(campaign_text(deterministic(value_range("a.x", "0", "1", "1e15") +
                                        value_range("a.y", "0", "1", "1e15")))),
      Contains("the campaign has 1000000000000001 or more cases, which is more than 10000000"));
  CHECK_THAT(error(campaign_text(stochastic(drawn("a.x", uniform("0", "1")))), KindType::Text),
             Contains("c.xosc:6: 'a.x' is not a number, so none can be drawn for it"));
  CHECK_THAT(error(campaign_text(stochastic(drawn("a.x", uniform("0.2", "0.8")))), KindType::Whole),
             Contains("there is no whole number from 0.2 to 0.8 for 'a.x'"));
  CHECK_THAT(error(campaign_text(deterministic(value_set("wire.form", {"1"})),
                                 "<stride:Intervention name='wire'><stride:Force variable='a.u' "
                                 "from='0'/></stride:Intervention>")),
             Contains("c.xosc:6: the intervention 'wire' has no 'form'") &&
                 Contains("did you mean 'from'?"));
}
