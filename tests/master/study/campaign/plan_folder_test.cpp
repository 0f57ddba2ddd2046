#include "master/study/campaign/plan_folder.h"

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/plan_json.h"
#include "master/system/ssp/parameters.h"
#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Catch::Contains;

namespace {

Plan plan_in(const CampaignFolder& folder) {
  Campaign read = folder.read();
  const CampaignScenario scenario(read, "1.0");
  return Plan(std::move(read), scenario.kinds(), scenario.fingerprints());
}

const std::string kStrings = campaign_text(
    "<Deterministic/>", "<stride:ValueSets><stride:File path='values.csv'/></stride:ValueSets>");

}  // namespace

TEST_CASE("the table has a row for each case, and texts as RFC 4180 has them") {
  const CampaignFolder folder(kStrings);
  folder.write("values.csv", "a.string,b.u\n\"a, \"\"b\"\"\",1\n\"\",2\n,0.5\n");
  const Plan plan = plan_in(folder);
  write_plan(plan, folder / "out");
  const std::string table = content(folder / "out/plan.csv");
  const auto line = [&](std::uint64_t index, const std::string& values) {
    const Case row = plan.at(index);
    return std::to_string(index) + "," + values + "," + std::to_string(row.seed) + "," +
           plan.hash(row) + "\n";
  };
  CHECK(table == "case,a.string,b.u,seed,hash\n" + line(0, "\"a, \"\"b\"\"\",1") +
                     line(1, "\"\",2") + line(2, ",0.5"));
  const auto json = nlohmann::json::parse(content(folder / "out/campaign.json"));
  CHECK(json["identity"] == plan_identity(plan));
  CHECK(json["scenario"] == "x.ssd");
  CHECK(json["cases"] == 3);
  CHECK(json["version"] == "1.0");
  CHECK(identity_in(folder / "out") == plan_identity(plan));
}

TEST_CASE("the same plan can be written again, another one cannot") {
  const CampaignFolder folder(campaign_text(stochastic(drawn("b.u", uniform("0", "1")))));
  write_plan(plan_in(folder), folder / "out");
  const std::string table = content(folder / "out/plan.csv");
  const std::string description = content(folder / "out/campaign.json");
  write_plan(plan_in(folder), folder / "out");
  CHECK(content(folder / "out/plan.csv") == table);
  CHECK(content(folder / "out/campaign.json") == description);
  folder.write("c.xosc", campaign_text(stochastic(drawn("b.u", uniform("0", "2")))));
  CHECK_THAT(error_of([&] { write_plan(plan_in(folder), folder / "out"); }),
             Contains("out: this folder belongs to another plan") && Contains("--out"));
  CHECK(content(folder / "out/plan.csv") == table);
  folder.write("out/campaign.json", "{}");
  CHECK_THAT(error_of([&] { identity_in(folder / "out"); }),
             Contains("campaign.json: this is not the description of a plan"));
  CHECK_FALSE(identity_in(folder / "nowhere"));
}

TEST_CASE("the identity changes with what decides results or is kept, and with nothing else") {
  const auto identity = [](const std::string& variation, const std::string& extension = "") {
    return plan_identity(plan_in(CampaignFolder(campaign_text(variation, extension))));
  };
  const std::string one = deterministic(value_set("b.u", {"1", "2"}));
  CHECK(identity(one) == identity("<!-- why -->\n" + one));
  CHECK(identity(one) == identity(one, "<stride:Keep results='failed'/>"));
  CHECK(identity(one) != identity(one, "<stride:Keep results='all'/>"));
  CHECK(identity(one) != identity(one, "<stride:Limit wallTime='1'/>"));
  CHECK(identity(one) != identity(one, "<stride:Capture component='b'/>"));
  CHECK(identity(one) != identity(one, "<stride:Aggregate name='n' signal='b.y' function='max'/>"));
  CHECK(identity(one) != identity(deterministic(value_set("b.u", {"1", "3"}))));
  CHECK(identity(one) != identity(deterministic(value_range("b.u", "1", "1", "2"))));
}

TEST_CASE("parameter sets hold the values of a case") {
  const CampaignFolder folder(campaign_text(
      deterministic(value_set("a.int8", {"-3"}) + value_set("a.matrix", {"1 2 3 4 5 6"}) +
                    value_set("a.string", {"x &amp; y", "z"})),
      "<stride:Seed variables='a.uint64'/>"));
  const Plan plan = plan_in(folder);
  CHECK(parameter_set_name(plan, 1) == "parameters/000001.ssv");
  write_parameter_sets(plan, folder / "out");
  std::vector<std::string> warnings;
  const auto values = ssp::read_parameter_set(folder / "out/parameters/000000.ssv", warnings);
  REQUIRE(values.size() == 4);
  CHECK(values[0].name == "a.int8");
  CHECK(values[0].value == "-3");
  CHECK(values[1].value == "1 2 3 4 5 6");
  CHECK(values[2].value == "x & y");
  CHECK(values[3].value == *plan.at(0).values[3]);
  CHECK_THAT(content(folder / "out/parameters/000001.ssv"),
             Contains("<ssv:Int8 value=\"-3\"/>") && Contains("<ssv:String value=\"z\"/>"));
  CHECK(warnings.empty());
}

TEST_CASE("no parameter set holds interventions and swaps") {
  const CampaignFolder folder(
      campaign_text(deterministic(value_set("w.from", {"0"})),
                    "<stride:Intervention name='w'><stride:Force variable='c.u' from='0'/>"
                    "</stride:Intervention>"));
  CHECK_THAT(error_of([&] { write_parameter_sets(plan_in(folder), folder / "out"); }),
             Contains("c.xosc:10: a parameter set (.ssv) cannot hold the intervention 'w'"));
}

TEST_CASE("a folder for each campaign") { CHECK(default_folder("x/nfc.xosc") == "campaigns/nfc"); }
