#include "master/study/campaign/definition/campaign_file.h"

#include <catch2/catch.hpp>

#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string read_error(const std::string& text) {
  return error_of([&] { read_text(text); });
}

std::string extension_error(const std::string& extension) {
  return read_error(campaign_text(deterministic(value_set("a.x", {"1"})), extension));
}

const std::string kSpeeds = value_set("a.speed", {"70.0", "110.0"});

}  // namespace

TEST_CASE("a file in the structure of esmini's example is read") {
  const Campaign campaign = read_text(campaign_text(
      "<Deterministic><DeterministicMultiParameterDistribution><ValueSetDistribution>"
      "<ParameterValueSet><ParameterAssignment parameterRef='host' value='car_blue'/>"
      "<ParameterAssignment parameterRef='target' value='car_yellow'/></ParameterValueSet>"
      "<ParameterValueSet><ParameterAssignment parameterRef='target' value='van_red'/>"
      "</ParameterValueSet></ValueSetDistribution></DeterministicMultiParameterDistribution>" +
      kSpeeds + value_range("a.factor", "1.1", "0.2", "1.5") + "</Deterministic>"));
  CHECK(campaign.scenario.filename() == "x.ssd");
  REQUIRE(campaign.parameters.size() == 4);
  CHECK(campaign.parameters[1].name == "target");
  const auto& factors = std::get<Deterministic>(campaign.variation).factors;
  REQUIRE(factors.size() == 3);
  const auto& sets = std::get<ValueTable>(factors[0]);
  REQUIRE(sets.rows.size() == 2);
  CHECK(sets.rows[0].values == std::vector<Text>{"car_blue", "car_yellow"});
  CHECK(sets.rows[1].values == std::vector<Text>{std::nullopt, "van_red"});
  CHECK(std::get<ValueTable>(factors[1]).rows[1].values == std::vector<Text>{"110.0"});
  CHECK(std::get<ValueRange>(factors[2]).count == 3);
}

TEST_CASE("all stochastic distributions are read") {
  const Campaign campaign = read_text(campaign_text(stochastic(
      drawn("a.n",
            "<NormalDistribution expectedValue='1' variance='4'>"
            "<Range lowerLimit='0' upperLimit='2'/></NormalDistribution>") +
      drawn("a.l", "<LogNormalDistribution expectedValue='1' variance='0.5'/>") +
      drawn("a.u", uniform("-1", "1")) + drawn("a.p", "<PoissonDistribution expectedValue='3'/>") +
      drawn("a.h",
            "<Histogram><Bin weight='1'><Range lowerLimit='2' upperLimit='3'/></Bin>"
            "<Bin weight='2'><Range lowerLimit='0' upperLimit='2'/></Bin></Histogram>") +
      drawn("a.s",
            "<ProbabilityDistributionSet><Element value='on' weight='1'/>"
            "<Element value='' weight='0'/></ProbabilityDistributionSet>"))));
  CHECK(campaign.random_seed == 7);
  const auto& variation = std::get<Stochastic>(campaign.variation);
  CHECK(variation.runs == 4);
  CHECK(variation.method == SamplingMethod::Independent);
  REQUIRE(variation.parameters.size() == 6);
  CHECK(std::get<Normal>(variation.parameters[0].distribution).limits->upper == 2);
  CHECK(std::get<LogNormal>(variation.parameters[1].distribution).variance == 0.5);
  CHECK(std::get<Uniform>(variation.parameters[2].distribution).limits.lower == -1);
  CHECK(std::get<Poisson>(variation.parameters[3].distribution).mean == 3);
  const auto& bins = std::get<Histogram>(variation.parameters[4].distribution).bins;
  CHECK(bins[0].limits.lower == 0);
  CHECK(bins[1].weight == 1);
  CHECK(std::get<ProbabilitySet>(variation.parameters[5].distribution).elements[1].value.empty());
}

TEST_CASE("stride's own element") {
  const Campaign campaign = read_text(campaign_text(
      stochastic(drawn("device",
                       "<ProbabilityDistributionSet><Element value='new' weight='1'/>"
                       "</ProbabilityDistributionSet>") +
                 drawn("wire.from", uniform("0", "1"))),
      "<stride:Swap name='device' component='sensor'><stride:Unit name='old'/>"
      "<stride:Unit name='new' file='new.fmu'/></stride:Swap>"
      "<stride:Intervention name='wire'><stride:Force variable='a.u' value='2' from='0.5' "
      "until='1'/></stride:Intervention>"
      "<stride:Seed variables='reader.seed  channel.seed'/>"
      "<stride:Sampling method='latin-hypercube'/>"
      "<stride:Keep results='all' every='10'/>"
      "<stride:Aggregate name='closest' signal='channel.distance' function='min'/>"
      "<stride:Aggregate name='early' signal='channel.distance' function='at' at='0.25'/>"
      "<stride:Limit wallTime='60'/>"));
  REQUIRE(campaign.swaps.size() == 1);
  CHECK(campaign.swaps[0].alternatives[0].file.empty());
  CHECK(campaign.swaps[0].alternatives[1].file == "new.fmu");
  CHECK(campaign.interventions[0].declared.value == "2");
  REQUIRE(campaign.seeds.size() == 2);
  CHECK(campaign.seeds[1].name == "channel.seed");
  CHECK(std::get<Stochastic>(campaign.variation).method == SamplingMethod::LatinHypercube);
  CHECK(campaign.keep.results == Keep::Results::All);
  CHECK(campaign.keep.every == 10);
  REQUIRE(campaign.aggregates.size() == 2);
  CHECK(campaign.aggregates[1].at == Time(std::chrono::milliseconds(250)));
  CHECK(campaign.wall_time_limit == 60.0);
}

TEST_CASE("what is no campaign is refused with a reason") {
  CHECK_THAT(read_error("<ssd/>"), Contains("c.xosc:1: <ssd> is no campaign"));
  CHECK_THAT(read_error("<OpenSCENARIO><FileHeader/><Storyboard/></OpenSCENARIO>"),
             Contains("has a <Storyboard>, so it is no campaign"));
  CHECK_THAT(read_error("<OpenSCENARIO xmlns='urn:x'/>"), Contains("is in the namespace 'urn:x'"));
  CHECK_THAT(read_error("<OpenSCENARIO/>"), Contains("holds no <FileHeader>"));
  CHECK_THAT(read_error("<OpenSCENARIO><FileHeader revMajor='2' revMinor='0'/></OpenSCENARIO>"),
             Contains("OpenSCENARIO 2.0") && Contains("1.1 to 1.3 are read"));
  CHECK_THAT(read_error("<OpenSCENARIO><FileHeader revMajor='1' revMinor='1'/></OpenSCENARIO>"),
             Contains("holds no <ParameterValueDistribution>"));
  std::string text = campaign_text(deterministic(kSpeeds));
  text.replace(text.find("x.ssd"), 5, "cut-in.xosc");
  CHECK_THAT(read_error(text), Contains("c.xosc:4: ") &&
                                   Contains("'cut-in.xosc', a scenario of OpenSCENARIO") &&
                                   Contains("name a scenario of SSP"));
  CHECK_THAT(read_error(campaign_text("")), Contains("holds no distributions"));
  CHECK_THAT(read_error(campaign_text(deterministic(kSpeeds) + stochastic(""))),
             Contains("c.xosc:7: a campaign is either deterministic or stochastic"));
  CHECK_THAT(read_error(campaign_text("<Deterministic/>")), Contains("nothing varies"));
}

TEST_CASE("a later version is read with a warning") {
  std::string text = campaign_text(deterministic(kSpeeds));
  text.replace(text.find("revMinor='3'"), 12, "revMinor='4'");
  const Campaign campaign = read_text(text);
  REQUIRE(campaign.warnings.size() == 1);
  CHECK_THAT(campaign.warnings[0], Contains("c.xosc:2: OpenSCENARIO 1.4 is read as 1.3"));
}

TEST_CASE("mistakes in deterministic distributions are found with their lines") {
  const auto error = [](const std::string& inside) {
    return read_error(campaign_text(deterministic(inside)));
  };
  CHECK_THAT(error(kSpeeds + "\n" + kSpeeds),
             Contains("c.xosc:7: 'a.speed' has two sources of values; the other one is in line 6"));
  CHECK_THAT(error(value_set("a.x", {})),
             Contains("c.xosc:6: <DistributionSet> holds no <Element>"));
  CHECK_THAT(error(value_range("a.x", "2", "1", "1")), Contains("the range from 2 to 1 is empty"));
  CHECK_THAT(error(value_range("a.x", "1", "0", "2")), Contains("stepWidth=\"0\" is not above 0"));
  CHECK_THAT(error(value_range("a.x", "1", "-1", "2")),
             Contains("stepWidth=\"-1\" is not above 0"));
  CHECK_THAT(error(value_range("a.x", "0", "1e-15", "1e15")),
             Contains("differ by more than 18 digits"));
  CHECK_THAT(error(value_range("a.x", "zero", "1", "2")), Contains("lowerLimit=\"zero\""));
  CHECK_THAT(error(value_set("a.x", {"$speed"})), Contains("'$speed' refers to a parameter"));
  CHECK_THAT(error(value_set("a.x", {"${1 + 1}"})), Contains("refers to a parameter"));
  CHECK_THAT(error(value_set("seed", {"1"})), Contains("is the name of a column"));
  CHECK_THAT(error("<DeterministicSingleParameterDistribution parameterName='a.x'/>"),
             Contains("holds 0 distributions, expected one"));
  CHECK_THAT(error("<DeterministicSingleParameterDistribution parameterName='a.x'>"
                   "<UserDefinedDistribution type='mine'>1 2</UserDefinedDistribution>"
                   "</DeterministicSingleParameterDistribution>"),
             Contains("the distribution 'mine', which is defined by a user") &&
                 Contains("list its values"));
  CHECK_THAT(error("<DeterministicMultiParameterDistribution><ValueSetDistribution>"
                   "<ParameterValueSet><ParameterAssignment parameterRef='a' value='1'/>"
                   "<ParameterAssignment parameterRef='a' value='2'/></ParameterValueSet>"
                   "</ValueSetDistribution></DeterministicMultiParameterDistribution>"),
             Contains("a second value for 'a' in this set"));
  CHECK_THAT(error("<Range lowerLimit='1' upperLimit='2'/>"),
             Contains("c.xosc:6: ") && Contains("<Range>"));
  CHECK_THAT(error("<DeterministicSingleParameterDistribution parameterName='a.x' step='1'/>"),
             Contains("c.xosc:6: ") && Contains("step"));
}

TEST_CASE("mistakes in stochastic distributions are found with their lines") {
  const auto error = [](const std::string& distribution) {
    return read_error(campaign_text(stochastic(drawn("a.x", distribution))));
  };
  CHECK_THAT(read_error(campaign_text("<Stochastic/>")),
             Contains("c.xosc:5: ") && Contains("numberOfTestRuns"));
  CHECK_THAT(read_error(campaign_text(stochastic("", "0"))), Contains("there is nothing to run"));
  CHECK_THAT(read_error(campaign_text(stochastic("", "-3"))), Contains("numberOfTestRuns"));
  CHECK_THAT(error("<NormalDistribution expectedValue='1' variance='-1'/>"),
             Contains("c.xosc:6: the variance -1 of <NormalDistribution> is below 0"));
  CHECK_THAT(error("<NormalDistribution expectedValue='1'/>"), Contains("variance"));
  CHECK_THAT(error("<NormalDistribution expectedValue='nan' variance='1'/>"),
             Contains("not finite"));
  CHECK_THAT(error("<NormalDistribution expectedValue='0' variance='1'>"
                   "<Range lowerLimit='50' upperLimit='60'/></NormalDistribution>"),
             Contains("normal, mean 0, variance 1, from 50 to 60: nothing is within these limits"));
  CHECK_THAT(error("<LogNormalDistribution expectedValue='0' variance='1'/>"),
             Contains("the expectedValue 0 of <LogNormalDistribution> is not above 0"));
  CHECK_THAT(error("<PoissonDistribution expectedValue='0'/>"), Contains("is not above 0"));
  CHECK_THAT(error("<PoissonDistribution expectedValue='1e10'/>"),
             Contains("is above 1000000000") && Contains("write a NormalDistribution"));
  CHECK_THAT(error("<UniformDistribution/>"), Contains("holds no <Range>"));
  CHECK_THAT(error(uniform("3", "2")), Contains("the range from 3 to 2 is empty"));
  CHECK_THAT(error("<ProbabilityDistributionSet><Element value='1' weight='0'/>"
                   "</ProbabilityDistributionSet>"),
             Contains("the weights in <ProbabilityDistributionSet> sum to 0"));
  CHECK_THAT(error("<ProbabilityDistributionSet/>"), Contains("is empty"));
  CHECK_THAT(error("<Histogram><Bin weight='1'><Range lowerLimit='0' upperLimit='2'/></Bin>"
                   "<Bin weight='1'><Range lowerLimit='1' upperLimit='3'/></Bin></Histogram>"),
             Contains("the bins from 0 to 2 and from 1 to 3 overlap"));
  CHECK_THAT(error("<Histogram><Bin weight='-1'><Range lowerLimit='0' upperLimit='2'/></Bin>"
                   "</Histogram>"),
             Contains("the weight -1 of <Bin> is below 0"));
  CHECK_THAT(error("<UserDefinedDistribution type='t'/>"), Contains("defined by a user"));
  CHECK_THAT(error("<Gaussian/>"), Contains("c.xosc:6: ") && Contains("<Gaussian>"));
}

TEST_CASE("mistakes in stride's own element are found with their lines") {
  CHECK_THAT(extension_error("<stride:Vary/>"),
             Contains("c.xosc:10: ") && Contains("<stride:Vary>"));
  CHECK_THAT(extension_error("<stride:Swap name='d' component='a'/>"), Contains("holds no unit"));
  CHECK_THAT(extension_error("<stride:Swap name='d.e' component='a'/>"),
             Contains("the name 'd.e' has a dot"));
  CHECK_THAT(extension_error("<stride:Swap name='d' component='a'><stride:Unit name='x'/>"
                             "<stride:Unit name='x' file='y'/></stride:Swap>"),
             Contains("a second unit is called 'x'"));
  CHECK_THAT(extension_error("<stride:Swap name='d' component='a'><stride:Unit name='x'/>"
                             "</stride:Swap>"),
             Contains("no distribution is for the swap 'd', so it has no effect"));
  const std::string wire =
      "<stride:Intervention name='w'><stride:Drop variable='a.u' from='0'/></stride:Intervention>";
  CHECK_THAT(extension_error(wire + wire), Contains("a second swap or intervention is called 'w'"));
  CHECK_THAT(extension_error("<stride:Intervention name='w'/>"), Contains("holds 0 elements"));
  CHECK_THAT(extension_error("<stride:Intervention name='w'><stride:Drop variable='a.u' value='1' "
                             "from='0'/></stride:Intervention>"),
             Contains("value"));
  CHECK_THAT(extension_error("<stride:Seed variables='a.x'/>"),
             Contains("'a.x' has two sources of values; the other one is in line 6"));
  CHECK_THAT(extension_error("<stride:Sampling method='sobol'/>"),
             Contains("nothing is sampled: the campaign is deterministic"));
  CHECK_THAT(
      read_error(campaign_text(stochastic(drawn("a.x", uniform("0", "1"))),
                               "<stride:Sampling method='halton'/>")),
      Contains("method=\"halton\" is unknown; expected independent, latin-hypercube, sobol"));
  CHECK_THAT(extension_error("<stride:Keep results='some'/>"),
             Contains("results=\"some\" is unknown; expected none, failed, all"));
  CHECK_THAT(extension_error("<stride:Keep every='0'/>"), Contains("expected a number above 0"));
  CHECK_THAT(extension_error("<stride:Keep/><stride:Keep/>"), Contains("Keep"));
  CHECK_THAT(extension_error("<stride:Aggregate name='n' signal='a.y' function='median'/>"),
             Contains("function=\"median\" is unknown"));
  CHECK_THAT(extension_error("<stride:Aggregate name='n' signal='a.y' function='at'/>"),
             Contains("at"));
  CHECK_THAT(extension_error("<stride:Aggregate name='n' signal='a.y' function='max' at='1'/>"),
             Contains("is for the function at, not for max"));
  CHECK_THAT(extension_error("<stride:Aggregate name='n' signal='a.y' function='max'/>"
                             "<stride:Aggregate name='n' signal='a.z' function='max'/>"),
             Contains("a second aggregate is called 'n'"));
  CHECK_THAT(extension_error("<stride:Limit wallTime='0'/>"), Contains("wallTime"));
  CHECK_THAT(extension_error("<stride:ValueSets/>"), Contains("names no value"));
  CHECK_THAT(extension_error("<stride:ValueSets><stride:File path='*.csv'/></stride:ValueSets>"),
             Contains("no file is called"));
  CHECK_THAT(
      read_error(campaign_text(stochastic(drawn("a.x", uniform("0", "1"))), "<stride:ValueSets/>")),
      Contains("a campaign is either stochastic or takes its values from files"));
}

TEST_CASE("values come from files, too") {
  const TemporaryFolder folder;
  folder.write("1.csv", "a.x,\"a \"\"b\"\"\",a.z\n1,,\"\"\n2,\"two, 2\",3\n");
  folder.write("2.csv", "a.z\r\n7\r\n");
  folder.write("3.ssv",
               "<ssv:ParameterSet "
               "xmlns:ssv='http://ssp-standard.org/SSP1/SystemStructureParameterValues' "
               "version='2.0' name='s'><ssv:Parameters><ssv:Parameter name='a.w'>"
               "<ssv:Float64 value='9'/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>");
  const Campaign campaign = read_campaign(
      folder.write("c.xosc", campaign_text("<Deterministic/>",
                                           "<stride:ValueSets><stride:File path='*.csv'/>"
                                           "<stride:File path='3.ssv'/></stride:ValueSets>")));
  REQUIRE(campaign.parameters.size() == 4);
  CHECK(campaign.parameters[1].name == "a \"b\"");
  const auto& table = std::get<ValueTable>(std::get<Deterministic>(campaign.variation).factors[0]);
  REQUIRE(table.rows.size() == 4);
  CHECK(table.rows[0].values == std::vector<Text>{"1", std::nullopt, "", std::nullopt});
  CHECK(table.rows[1].values == std::vector<Text>{"2", "two, 2", "3", std::nullopt});
  CHECK(table.rows[2].values == std::vector<Text>{std::nullopt, std::nullopt, "7", std::nullopt});
  CHECK(table.rows[3].values[3] == "9");
  CHECK(table.rows[1].where.line == 3);
}

TEST_CASE("mistakes in files with values are found with their lines") {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& name, const std::string& content) {
    folder.write(name, content);
    const auto file = folder.write(
        "c.xosc", campaign_text("<Deterministic/>", "<stride:ValueSets><stride:File path='" + name +
                                                        "'/></stride:ValueSets>"));
    return error_of([&] { read_campaign(file); });
  };
  CHECK_THAT(error("a.csv", ""), Contains("a.csv:1: the file has no row"));
  CHECK_THAT(error("a.csv", "a.x,a.x\n"), Contains("a.csv:1: two columns are called 'a.x'"));
  CHECK_THAT(error("a.csv", "a.x,\n"), Contains("a column has no name"));
  CHECK_THAT(error("a.csv", "a.x\n1\n1,2\n"),
             Contains("a.csv:3: the row has 2 fields, the first one has 1"));
  CHECK_THAT(error("a.csv", "a.x\n1\n2"), Contains("the last line has no line feed"));
  CHECK_THAT(error("a.csv", "a.x\n"), Contains("names no value"));
  CHECK_THAT(error("a.csv", std::string("a.x\na\0b\n", 8)),
             Contains("a.csv:2: a field has a byte of value 0"));
  CHECK_THAT(error("a.csv", "a.x\n\xfe\n"),
             Contains("a.csv:2: a field has bytes that are no UTF-8"));
  CHECK_THAT(error("a.txt", "1"), Contains("is neither a .csv nor a .ssv"));
  CHECK_THAT(error("a.ssv",
                   "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/"
                   "SystemStructureParameterValues' version='2.0' name='s'>"
                   "<ssv:Parameters><ssv:Parameter name='a.w'><ssv:Float64 value='9' "
                   "unit='m'/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>"),
             Contains("the value of 'a.w' is in 'm'"));
}
