#include "master/study/campaign/definition/campaign_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/xml/document.h"
#include "master/study/campaign/definition/distribution_elements.h"
#include "master/study/campaign/definition/extension.h"
#include "master/study/campaign/definition/parameter_list.h"

namespace stride::campaign {
namespace {

namespace fs = std::filesystem;

constexpr xml::Prefix kCampaignPrefixes[] = {{"stride", kStrideCampaign}};

void check_root(const xml::Element& root) {
  if (root.local_name() != "OpenSCENARIO" && root.local_name() != "OpenScenario") {
    root.fail(fmt::format("{} is no campaign", root.tag()),
              "a campaign is a file of OpenSCENARIO: <OpenSCENARIO> with a "
              "<ParameterValueDistribution> (docs/campaigns.md)");
  }
  if (!root.name().name_space.empty()) {
    root.fail(fmt::format("{} is in the namespace '{}'", root.tag(), root.name().name_space),
              "OpenSCENARIO has no namespace");
  }
  for (const char* other : {"Storyboard", "Catalog"}) {
    if (!root.child(other)) continue;
    root.fail(fmt::format("this file of OpenSCENARIO has a <{}>, so it is no campaign", other),
              "a campaign has a <ParameterValueDistribution>");
  }
  root.allow_attributes({});
  root.allow_children({"FileHeader", "ParameterValueDistribution", {kStrideCampaign, "Campaign"}});
}

/// Of which nothing has an effect.
void check_header(const xml::Element& header, std::vector<std::string>& warnings) {
  header.allow_attributes({"author", "date", "description", "revMajor", "revMinor"});
  header.allow_children({"License", "Properties"});
  const auto major = header.required_number<std::uint16_t>("revMajor");
  const auto minor = header.required_number<std::uint16_t>("revMinor");
  constexpr std::uint16_t kLatestMinor = 3;
  if (major != 1) {
    header.fail_unsupported(fmt::format("OpenSCENARIO {}.{}", major, minor), "1.1 to 1.3 are read");
  }
  if (minor <= kLatestMinor) return;
  warnings.push_back(core::to_text({.where = header.where()}) +
                     fmt::format("OpenSCENARIO {}.{} is read as 1.{}", major, minor, kLatestMinor));
}

void read_scenario_file(const xml::Element& owner, const fs::path& folder, Campaign& campaign) {
  const auto element = owner.child("ScenarioFile");
  if (!element) owner.fail(fmt::format("{} holds no <ScenarioFile>", owner.tag()));
  element->allow_attributes({"filepath"});
  element->allow_children({});
  const fs::path path = element->required("filepath");
  if (path.extension() == ".xosc") {
    element->fail_unsupported(
        fmt::format("'{}', a scenario of OpenSCENARIO", core::name_text(path.string())),
        "name a scenario of SSP (.ssd, .ssp), or an FMU");
  }
  campaign.scenario = (folder / path).lexically_normal();
  campaign.scenario_where = element->where();
}

/// A number of any kind, of which all bits count.
double read_random_seed(const xml::Element& stochastic) {
  const double seed = stochastic.number<double>("randomSeed").value_or(0);
  if (std::isfinite(seed)) return seed;
  stochastic.fail(fmt::format("randomSeed=\"{}\" is not finite", seed));
}

void read_variation(const xml::Element& owner, ParameterList& parameters, Campaign& campaign) {
  const auto deterministic = owner.child("Deterministic");
  const auto stochastic = owner.child("Stochastic");
  if (deterministic && stochastic) {
    stochastic->fail("a campaign is either deterministic or stochastic, as OpenSCENARIO defines it",
                     "keep one of <Deterministic> and <Stochastic>; a DistributionSet can be a "
                     "ProbabilityDistributionSet with equal weights");
  }
  if (deterministic) {
    campaign.variation = read_deterministic(*deterministic, parameters);
  } else if (stochastic) {
    campaign.variation = read_stochastic(*stochastic, parameters);
    campaign.random_seed = read_random_seed(*stochastic);
  } else {
    owner.fail(fmt::format("{} holds no distributions", owner.tag()),
               "expected <Deterministic> or <Stochastic>");
  }
}

/// A seed is a source of values, too. Throws for two of one parameter.
std::size_t count_sources(const Campaign& campaign) {
  std::vector<Parameter> found;
  ParameterList sources(found);
  for (const auto* list : {&campaign.parameters, &campaign.seeds}) {
    for (const auto& [name, where] : *list) sources.add(name, where);
  }
  return found.size();
}

/// What is declared has an effect only where a distribution is for it.
void check_swaps_vary(const Campaign& campaign) {
  for (const Swap& swap : campaign.swaps) {
    if (std::ranges::find(campaign.parameters, swap.name, &Parameter::name) !=
        campaign.parameters.end()) {
      continue;
    }
    core::fail_input({.where = swap.where},
                     fmt::format("no distribution is for the swap '{}', so it has no effect",
                                 core::name_text(swap.name)),
                     fmt::format("write one with parameterName=\"{}\"", swap.name));
  }
}

}  // namespace

Campaign read_campaign(const fs::path& file) {
  const xml::Document document(file, "", kCampaignPrefixes);
  const xml::Element root = document.root();
  Campaign campaign;
  campaign.file = file;
  campaign.warnings = document.warnings();
  check_root(root);
  const auto header = root.child("FileHeader");
  if (!header) root.fail(fmt::format("{} holds no <FileHeader>", root.tag()));
  check_header(*header, campaign.warnings);
  const auto distribution = root.child("ParameterValueDistribution");
  if (!distribution) root.fail(fmt::format("{} holds no <ParameterValueDistribution>", root.tag()));
  distribution->allow_attributes({});
  distribution->allow_children({"ScenarioFile", "Deterministic", "Stochastic"});
  read_scenario_file(*distribution, file.parent_path(), campaign);
  ParameterList parameters(campaign.parameters);
  read_variation(*distribution, parameters, campaign);
  if (const auto extension = root.child({kStrideCampaign, "Campaign"})) {
    read_extension(*extension, file.parent_path(), parameters, campaign);
  }
  if (count_sources(campaign) == 0) {
    distribution->fail("nothing varies: no distribution names a parameter");
  }
  check_swaps_vary(campaign);
  return campaign;
}

}  // namespace stride::campaign
