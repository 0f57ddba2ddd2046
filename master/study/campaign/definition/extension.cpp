#include "master/study/campaign/definition/extension.h"

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/text/glob.h"
#include "master/base/text/number_text.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/study/campaign/definition/value_files.h"
#include "master/system/declaration/intervention_element.h"

namespace stride::campaign {
namespace {

namespace fs = std::filesystem;

/// Where an element goes, and what its paths are relative to.
struct Extension {
  const fs::path& folder;
  ParameterList& parameters;
  Campaign& campaign;
};

/// The choice whose name() the attribute is.
template <class Choice, std::size_t n>
Choice read_choice(const xml::Element& element, const char* attribute, const Choice (&choices)[n]) {
  const std::string word = element.required(attribute);
  std::vector<std::string> names;
  for (const Choice choice : choices) {
    names.emplace_back(name(choice));
    if (names.back() == word) return choice;
  }
  element.fail(fmt::format("{}=\"{}\" is unknown; expected {}", attribute, core::name_text(word),
                           fmt::join(names, ", ")));
}

/// What declares parameters is called by its name in theirs.
std::string read_own_name(const xml::Element& element, const Campaign& campaign) {
  const std::string name = element.required_line("name");
  if (name.find('.') != std::string::npos) {
    element.fail(fmt::format("the name '{}' has a dot", core::name_text(name)),
                 "parts of an intervention follow a dot: choose a name without one");
  }
  const auto is_taken = [&](const auto& list) {
    return std::ranges::any_of(list, [&](const auto& other) { return other.name == name; });
  };
  if (is_taken(campaign.swaps) || is_taken(campaign.interventions)) {
    element.fail(
        fmt::format("a second swap or intervention is called '{}'", core::name_text(name)));
  }
  return name;
}

/// A unit beside the campaign file, or else one that is found by its name.
fs::path unit_file(const std::string& file, const fs::path& folder) {
  const fs::path beside = folder / file;
  return core::path_exists(beside) ? beside : fs::path(file);
}

void read_swap(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"name", "component"});
  element.allow_children({{kStrideCampaign, "Unit"}});
  Swap swap{
      read_own_name(element, to.campaign), element.required("component"), {}, element.where()};
  for (const xml::Element& unit : element.children()) {
    unit.allow_attributes({"name", "file"});
    unit.allow_children({});
    const std::string name = unit.required_line("name");
    if (std::ranges::find(swap.alternatives, name, &Swap::Alternative::name) !=
        swap.alternatives.end()) {
      unit.fail(fmt::format("a second unit is called '{}'", core::name_text(name)));
    }
    const auto file = unit.attribute("file");
    if (file && file->empty())
      unit.fail("file=\"\" names no unit", "leave it out for the scenario's");
    swap.alternatives.push_back(
        {name, file ? unit_file(*file, to.folder) : fs::path(), unit.where()});
  }
  if (swap.alternatives.empty()) element.fail(fmt::format("{} holds no unit", element.tag()));
  to.campaign.swaps.push_back(std::move(swap));
}

void read_named_intervention(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"name"});
  element.allow_children({{kStrideCampaign, "Set"},
                          {kStrideCampaign, "Force"},
                          {kStrideCampaign, "Drop"},
                          {kStrideCampaign, "Delay"},
                          {kStrideCampaign, "Corrupt"}});
  const auto children = element.children();
  if (children.size() != 1) {
    element.fail(fmt::format("{} holds {} elements, expected one", element.tag(), children.size()));
  }
  to.campaign.interventions.push_back({read_own_name(element, to.campaign),
                                       scenario::read_intervention(children.front()),
                                       element.where()});
}

void read_seed(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"variables"});
  element.allow_children({});
  std::istringstream words(element.required("variables"));
  for (std::string word; words >> word;) to.campaign.seeds.push_back({word, element.where()});
  if (to.campaign.seeds.empty()) element.fail("no variable is named");
}

void read_sampling(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"method"});
  element.allow_children({});
  const auto method = read_choice(element, "method", kSamplingMethods);
  auto* const stochastic = std::get_if<Stochastic>(&to.campaign.variation);
  if (stochastic == nullptr) {
    element.fail("nothing is sampled: the campaign is deterministic",
                 "this is for <Stochastic>; leave it out");
  }
  stochastic->method = method;
}

/// The files that a path names, whose last part may be a pattern.
std::vector<fs::path> matching_files(const xml::Element& element, const fs::path& folder) {
  const fs::path path = folder / element.required("path");
  const std::string pattern = path.filename().string();
  if (core::path_exists(path) || pattern.find_first_of("*?[") == std::string::npos) return {path};
  std::vector<fs::path> files;
  for (const fs::path& entry : core::folder_entries(path.parent_path())) {
    if (core::matches_glob(pattern, entry.filename().string())) files.push_back(entry);
  }
  if (files.empty()) element.fail(fmt::format("no file is called '{}'", path.string()));
  return files;
}

void read_value_sets(const xml::Element& element, const Extension& to) {
  element.allow_attributes({});
  element.allow_children({{kStrideCampaign, "File"}});
  auto* const deterministic = std::get_if<Deterministic>(&to.campaign.variation);
  if (deterministic == nullptr) {
    element.fail("a campaign is either stochastic or takes its values from files",
                 "write <Deterministic/> in place of <Stochastic>");
  }
  ValueFiles files(to.parameters);
  for (const xml::Element& file : element.children()) {
    file.allow_attributes({"path"});
    file.allow_children({});
    for (const fs::path& path : matching_files(file, to.folder)) {
      files.add(path, file.where(), to.campaign.warnings);
    }
  }
  ValueTable table = std::move(files).table();
  if (table.rows.empty()) element.fail(fmt::format("{} names no value", element.tag()));
  deterministic->factors.emplace_back(std::move(table));
}

void read_keep(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"results", "every"});
  element.allow_children({});
  Keep& keep = to.campaign.keep;
  if (element.attribute("results")) keep.results = read_choice(element, "results", kKeptResults);
  keep.every = element.number<std::uint64_t>("every").value_or(0);
  if (element.attribute("every") && keep.every == 0) {
    element.fail("every=\"0\": expected a number above 0", "leave it out to keep no further ones");
  }
}

void read_capture(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"component"});
  element.allow_children({});
  CapturedComponent capture{element.required("component"), element.where()};
  auto& captures = to.campaign.captures;
  if (std::ranges::find(captures, capture.component, &CapturedComponent::component) !=
      captures.end()) {
    element.fail(
        fmt::format("the component '{}' is captured twice", core::name_text(capture.component)));
  }
  captures.push_back(std::move(capture));
}

template <class Parse>
auto parsed(const xml::Element& element, const char* attribute, Parse&& parse) {
  try {
    return parse(element.required(attribute));
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("{}: {}", attribute, mistake.what()));
  }
}

void read_aggregate(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"name", "signal", "function", "at"});
  element.allow_children({});
  Aggregate aggregate{element.required_line("name"),
                      element.required("signal"),
                      read_choice(element, "function", kAggregateFunctions),
                      {},
                      element.where()};
  const bool is_at = aggregate.function == Aggregate::Function::At;
  if (is_at) aggregate.at = parsed(element, "at", core::parse_time);
  if (!is_at && element.attribute("at")) {
    element.fail(
        fmt::format("at=\"…\" is for the function at, not for {}", name(aggregate.function)));
  }
  if (std::ranges::find(to.campaign.aggregates, aggregate.name, &Aggregate::name) !=
      to.campaign.aggregates.end()) {
    element.fail(fmt::format("a second aggregate is called '{}'", core::name_text(aggregate.name)));
  }
  to.campaign.aggregates.push_back(std::move(aggregate));
}

void read_limit(const xml::Element& element, const Extension& to) {
  element.allow_attributes({"wallTime"});
  element.allow_children({});
  to.campaign.wall_time_limit = parsed(element, "wallTime", core::parse_above_zero);
}

/// A child of <stride:Campaign>.
struct ExtensionElement {
  std::string_view name;
  bool may_repeat;
  void (*read)(const xml::Element& element, const Extension& to);
};

constexpr ExtensionElement kExtensionElements[] = {
    {"Swap", true, read_swap},
    {"Intervention", true, read_named_intervention},
    {"Seed", true, read_seed},
    {"Sampling", false, read_sampling},
    {"ValueSets", true, read_value_sets},
    {"Keep", false, read_keep},
    {"Capture", true, read_capture},
    {"Aggregate", true, read_aggregate},
    {"Limit", false, read_limit},
};

}  // namespace

void read_extension(const xml::Element& element, const fs::path& folder, ParameterList& parameters,
                    Campaign& campaign) {
  element.allow_attributes({});
  element.allow_children({{kStrideCampaign, "Swap"},
                          {kStrideCampaign, "Intervention"},
                          {kStrideCampaign, "Seed"},
                          {kStrideCampaign, "Sampling"},
                          {kStrideCampaign, "ValueSets"},
                          {kStrideCampaign, "Keep"},
                          {kStrideCampaign, "Capture"},
                          {kStrideCampaign, "Aggregate"},
                          {kStrideCampaign, "Limit"}});
  for (const ExtensionElement& kind : kExtensionElements) {
    const xml::Name name(kStrideCampaign, kind.name);
    if (!kind.may_repeat) element.child(name);  // two are an error
    for (const xml::Element& child : element.children(name)) {
      kind.read(child, {folder, parameters, campaign});
    }
  }
}

}  // namespace stride::campaign
