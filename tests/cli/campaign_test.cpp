// stride campaign, from outside.
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string campaign_file(const std::string& distributions, const std::string& extension = "") {
  return "<OpenSCENARIO>\n<FileHeader revMajor='1' revMinor='1' date='2026-01-01T00:00:00' "
         "description='' author=''/>\n<ParameterValueDistribution>\n"
         "<ScenarioFile filepath='test.ssd'/>\n" +
         distributions + "\n</ParameterValueDistribution>\n" + extension + "</OpenSCENARIO>\n";
}

std::string normal_draws(const std::string& runs) {
  return "<Stochastic numberOfTestRuns='" + runs +
         "' randomSeed='1'><StochasticDistribution parameterName='first.u'>"
         "<NormalDistribution expectedValue='1' variance='1'/></StochasticDistribution>"
         "</Stochastic>";
}

const char* const kWire =
    "<stride:Campaign xmlns:stride='urn:org.stride:campaign:1'>"
    "<stride:Intervention name='wire'><stride:Force variable='second.u' value='0' from='0.5'/>"
    "</stride:Intervention></stride:Campaign>\n";

/// Two filters, and the campaign c.xosc.
struct CampaignSpace : Workspace {
  explicit CampaignSpace(const std::string& campaign) : Workspace(two_filters()) {
    scratch().write("c.xosc", campaign);
  }
  Outcome plan(const Arguments& further = {}) const {
    Arguments arguments{"campaign", "plan", "c.xosc"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return stride(arguments);
  }
  std::string file(const std::string& name) const { return read(scratch() / name); }
};

std::string line_of(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i <= number; ++i) std::getline(lines, line);
  return line;
}

}  // namespace

TEST_CASE("a plan is written to its folder, and printed in tables") {
  const CampaignSpace space(campaign_file(normal_draws("20")));
  const Outcome outcome = space.plan();
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("c: 20 cases of test.ssd, independent, random seed 1") &&
                              Contains("normal, mean 1, variance 1") && Contains("First cases") &&
                              Contains("Plan in campaigns/c: plan.csv campaign.json"));
  const std::string table = space.file("campaigns/c/plan.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 21);
  CHECK(line_of(table, 0) == "case,first.u,seed,hash");
  CHECK(space.plan().exit_code == 0);
  CHECK(space.file("campaigns/c/plan.csv") == table);
  space.scratch().write("c.xosc", campaign_file(normal_draws("21")));
  const Outcome other = space.plan();
  CHECK_THAT(input_error_of(other), Contains("campaigns/c: this folder belongs to another plan"));
  CHECK(space.plan({"--out", "elsewhere"}).exit_code == 0);
  CHECK(line_of(space.file("elsewhere/plan.csv"), 20) == line_of(table, 20));
}

TEST_CASE("a parameter set of a case and its printed command run alike") {
  const CampaignSpace space(campaign_file(normal_draws("3")));
  REQUIRE(space.plan({"--ssv"}).exit_code == 0);
  const Outcome by_set =
      space.run({"--quiet", "--parameters", "campaigns/c/parameters/000002.ssv"});
  INFO(by_set.err);
  REQUIRE(by_set.exit_code == 0);
  const std::string signals = space.result("signals.csv");
  const Outcome printed = space.plan({"--case", "2"});
  REQUIRE(printed.exit_code == 0);
  CHECK_THAT(printed.out, Catch::StartsWith("stride run test.ssd --set first.u="));
  const std::string value = printed.out.substr(printed.out.find("--set ") + 6);
  REQUIRE(space.run({"--quiet", "--set", value.substr(0, value.find('\n'))}).exit_code == 0);
  CHECK(space.result("signals.csv") == signals);
  REQUIRE(space.run({"--quiet"}).exit_code == 0);
  CHECK(space.result("signals.csv") != signals);
}

TEST_CASE("nothing is written for a campaign with mistakes") {
  const CampaignSpace space(
      campaign_file("<Stochastic numberOfTestRuns='50'><StochasticDistribution parameterName="
                    "'first.time_constant'><NormalDistribution expectedValue='1' variance='1'/>"
                    "</StochasticDistribution></Stochastic>"));
  CHECK_THAT(input_error_of(space.plan()),
             Contains("c.xosc:5: unit 'first', variable 'time_constant': the value -") &&
                 Contains("limit the distribution by a <Range>"));
  CHECK_FALSE(fs::exists(space / "campaigns"));
  CHECK_THAT(input_error_of(space.stride({"campaign", "plan", "none.xosc"})),
             Contains("none.xosc: the file does not exist"));
  CHECK_THAT(input_error_of(space.stride({"campaign", "plan", "test.ssd"})),
             Contains("test.ssd:2: <ssd:SystemStructureDescription> is no campaign"));
  CHECK_THAT(input_error_of(space.stride({"campaign"})), Contains("A subcommand is required"));
}

TEST_CASE("what --case and --ssv cannot do") {
  const CampaignSpace space(campaign_file(normal_draws("3"), kWire));
  CHECK_THAT(input_error_of(space.plan({"--case", "3"})),
             Contains("--case 3: the campaign has 3 cases, the last one is 2"));
  CHECK_THAT(input_error_of(space.plan({"--ssv"})),
             Contains("a parameter set (.ssv) cannot hold the intervention 'wire'"));
  CHECK_FALSE(fs::exists(space / "campaigns"));
  const Outcome printed = space.plan({"--case", "0"});
  CHECK_THAT(printed.out, Contains(" --force second.u=0@0.5..\n"));
}

TEST_CASE("a plan replaces none of its inputs") {
  const CampaignSpace space("");
  space.scratch().write("campaign.json", campaign_file(normal_draws("3")));
  CHECK_THAT(input_error_of(space.stride({"campaign", "plan", "campaign.json", "--out", "."})),
             Contains("campaign.json in the folder .: this is the campaign"));
}

TEST_CASE("a parameter set on the command line is checked as --set is") {
  const CampaignSpace space("");
  const auto set = [&](const std::string& parameter, const std::string& value) {
    space.scratch().write(
        "p.ssv",
        "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/SystemStructureParameterValues' "
        "version='2.0' name='p'>\n<ssv:Parameters><ssv:Parameter name='" +
            parameter + "'><ssv:Float64 value='" + value +
            "'/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>");
    return space.run({"--quiet", "--parameters", "p.ssv"});
  };
  CHECK(set("first.u", "1").exit_code == 0);
  CHECK_THAT(input_error_of(set("frist.u", "1")), Contains("p.ssv:2: ") && Contains("first"));
  CHECK_THAT(input_error_of(set("first.v", "1")), Contains("p.ssv:2: unit 'first', variable 'v'"));
  CHECK_THAT(input_error_of(set("first.time_constant", "-1")), Contains("out of range"));
  REQUIRE(set("first.u", "1").exit_code == 0);
  const std::string signals = space.result("signals.csv");
  REQUIRE(space.run({"--quiet", "--parameters", "p.ssv", "--set", "first.u=2"}).exit_code == 0);
  CHECK(space.result("signals.csv") != signals);
}
