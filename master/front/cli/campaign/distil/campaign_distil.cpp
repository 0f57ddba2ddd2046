#include "master/front/cli/campaign/distil/campaign_distil.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/saturated_sum.h"
#include "master/base/text/counted.h"
#include "master/base/text/number_text.h"
#include "master/base/text/suggest.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/distil/replay_suite.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/capture/capture.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/distil.h"
#include "master/study/campaign/plan_folder.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct DistilArguments {
  CampaignArguments campaign;
  std::string component;
  fs::path suite;
  std::string tolerance;  ///< empty: all bits
  bool quiet = false;
};

/// What there is to choose from.
struct Cases {
  std::vector<campaign::DistilCandidate> candidates;  ///< those with stimuli
  std::map<std::uint64_t, campaign::CaseResult> results;
  std::map<std::string, std::uint64_t> items;  ///< of all cases with a record, and how often
  campaign::Wanted wanted;
  std::uint64_t missing = 0;          ///< without a record
  std::uint64_t without_stimuli = 0;  ///< which never had a step
  bool has_coverage = false;
};

constexpr std::string_view kEndsItem = "ends: ";

void add_items(const std::map<std::string, std::uint64_t>& items,
               std::map<std::string, std::uint64_t>& all) {
  for (const auto& [item, count] : items) all[item] = core::saturated_sum(all[item], count);
}

Cases read_cases(const CampaignInput& input, const campaign::CaseFolder& folder,
                 const std::string& component) {
  Cases cases;
  campaign::CaseDefinitions definitions = input.case_definitions();
  campaign::CountedBins bins(component, definitions);
  for (std::uint64_t i = 0; i < input.plan().size(); ++i) {
    auto record = folder.read(i);
    if (!record) {
      ++cases.missing;
      continue;
    }
    campaign::DistilCandidate candidate{i, bins.of(record->result, i)};
    cases.has_coverage = cases.has_coverage || !candidate.items.empty();
    candidate.items.emplace(std::string(kEndsItem) + campaign::ending_of(record->result), 1);
    add_items(candidate.items, cases.items);
    const fs::path stimuli = folder.stimuli_name(i) / capture::stimuli_file_name(component);
    if (core::is_file(input.folder() / stimuli)) {
      cases.candidates.push_back(std::move(candidate));
      cases.results.emplace(i, std::move(record->result));
    } else {
      ++cases.without_stimuli;
    }
  }
  cases.wanted = bins.wanted();
  return cases;
}

void require_captured(const CampaignInput& input, const std::string& component) {
  std::vector<std::string> names;
  for (const auto& capture : input.plan().campaign().captures) names.push_back(capture.component);
  if (std::ranges::find(names, component) != names.end()) return;
  core::fail_input(
      {},
      fmt::format("--component {}: the campaign does not capture it", core::name_text(component)),
      names.empty() ? fmt::format("write <stride:Capture component=\"{}\"/> into {}, and run it",
                                  core::name_text(component), input.word())
                    : core::suggestion(component, names));
}

/// The cases that are chosen, each with a replay in the suite.
class Distillation {
 public:
  Distillation(const DistilArguments& arguments, const CampaignInput& input)
      : arguments_(arguments),
        input_(input),
        folder_(input.plan(), input.folder()),
        cases_(read_cases(input, folder_, arguments.component)),
        suite_(input, folder_, arguments.suite, {arguments.component, arguments.tolerance}) {}

  void run() {
    if (cases_.candidates.empty()) {
      core::fail_input({.where = {input_.folder().string(), 0}},
                       fmt::format("no case has stimuli of '{}'", arguments_.component),
                       fmt::format("run them: stride campaign run {}", input_.word()));
    }
    do {
      chosen_ = campaign::distil(cases_.candidates, cases_.wanted);
    } while (!write_chosen());
    std::set<std::uint64_t> kept;
    for (const auto& one : chosen_) kept.insert(one.index);
    suite_.publish(kept, page());
  }

  void print() const {
    print_text("{}\n", summary());
    Table table(
        {{"case", Table::Align::Right}, {"ended"}, {"alone it has", Table::Align::Left, true}});
    for (const auto& one : chosen_) {
      table.add(
          {std::to_string(one.index), ending(one.index), core::abridged(alone(one), kShownItems)});
    }
    print_text("\nCases\n{}", table.text(output_width()));
    print_text("\nSuite in {}: run.sh README.md {}.ssd{}\n", arguments_.suite.string(),
               replay_name(input_.plan(), chosen_.front().index), chosen_.size() > 1 ? " …" : "");
  }

  /// Throws core::Error (Run) if something that the campaign has is not in the suite.
  void require_all() const {
    const std::vector<std::string> lost = lost_items();
    if (lost.empty()) return;
    std::string why;
    if (!unusable_.empty()) {
      why = fmt::format("\n  case {} has no replay: {}", unusable_.begin()->first,
                        core::first_line(unusable_.begin()->second));
    }
    core::fail_run({}, fmt::format("the suite lacks what only cases without a replay have: {}{}",
                                   core::abridged(lost, kShownItems), why));
  }

 private:
  static constexpr std::size_t kShownItems = 3;
  static constexpr std::size_t kMostUnusable = 20;

  /// Returns false where a case has no replay, so that others have to be chosen.
  bool write_chosen() {
    bool has_all = true;
    for (const auto& one : chosen_) {
      if (suite_.has(one.index)) continue;
      auto why = suite_.add(one.index, cases_.results.at(one.index));
      if (!why) continue;
      has_all = false;
      unusable_.emplace(one.index, std::move(*why));
    }
    std::erase_if(cases_.candidates,
                  [&](const auto& candidate) { return unusable_.contains(candidate.index); });
    if (unusable_.size() < kMostUnusable && !cases_.candidates.empty()) return has_all;
    core::fail_run({}, fmt::format("{} cannot be replayed, as case {}: {}",
                                   core::counted(unusable_.size(), "case"),
                                   unusable_.begin()->first, unusable_.begin()->second));
  }

  /// What all cases have, and those with a replay have not, or not as often as it is wanted.
  std::vector<std::string> lost_items() const {
    std::map<std::string, std::uint64_t> kept;
    for (const auto& candidate : cases_.candidates) add_items(candidate.items, kept);
    std::vector<std::string> lost;
    for (const auto& [item, count] : cases_.items) {
      const auto often = cases_.wanted.find(item);
      const bool is_often = often != cases_.wanted.end() && count >= often->second;
      const auto left = kept.find(item);
      if (left == kept.end() || (is_often && left->second < often->second)) lost.push_back(item);
    }
    return lost;
  }

  std::string ending(std::uint64_t index) const {
    return campaign::ending_of(cases_.results.at(index));
  }

  /// For people: how it ended is said beside it.
  static std::vector<std::string> alone(const campaign::DistilledCase& one) {
    std::vector<std::string> texts;
    for (const std::string& item : one.alone) {
      texts.push_back(item.starts_with(kEndsItem) ? "its end" : item);
    }
    return texts;
  }

  std::string summary() const {
    const std::uint64_t done = input_.plan().size() - cases_.missing;
    std::string text = fmt::format("{}: {} of {} cases are enough for '{}'",
                                   input_.plan().campaign().file.stem().string(), chosen_.size(),
                                   done, arguments_.component);
    if (cases_.missing > 0) text += fmt::format("; {} have not run", cases_.missing);
    if (cases_.without_stimuli > 0) {
      text += fmt::format("; {} have no stimuli", cases_.without_stimuli);
    }
    return text + "\n" + reach();
  }

  /// What the chosen ones have in common with all.
  std::string reach() const {
    const auto lost = lost_items();
    const auto count = [](const auto& items) {
      return static_cast<std::size_t>(std::ranges::count_if(
          items, [](const std::string& item) { return item.starts_with(kEndsItem); }));
    };
    const std::size_t ends = count(std::views::keys(cases_.items)) - count(lost);
    const std::string ways = core::counted(ends, "way") + " to end";
    if (!cases_.has_coverage) {
      return fmt::format("They have {}; the records have no coverage of it, so only these count",
                         ways);
    }
    return fmt::format("They have {} and {}",
                       core::counted(cases_.items.size() - lost.size() - ends, "covered bin"),
                       ways);
  }

  std::string page() const;

  const DistilArguments& arguments_;
  const CampaignInput& input_;
  const campaign::CaseFolder folder_;
  Cases cases_;
  ReplaySuite suite_;
  std::vector<campaign::DistilledCase> chosen_;
  std::map<std::uint64_t, std::string> unusable_;  ///< and why
};

/// For a table in Markdown.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string Distillation::page() const {
  const campaign::Campaign& campaign = input_.plan().campaign();
  const std::string& device = arguments_.component;
  std::string text = fmt::format(
      "# Regression suite of {0}\n\n{1}.\n\nEach case plays what {0} received in a case of the "
      "campaign {2} of {3} to it alone, and checks that\nit does what it did then.\n\n"
      "```sh\n./run.sh\n./run.sh --swap {4}=NEW.fmu\n```\n\n",
      device, summary(), campaign.file.filename().string(), campaign.scenario.filename().string(),
      replay::device_name(device));
  text += arguments_.tolerance.empty()
              ? "`run.sh` also compares all outputs with those in `golden/`, bit by bit.\n"
              : fmt::format(
                    "Compared are numbers of messages and values at the end, of which real ones "
                    "may differ by {}; `golden/` has\nwhat the device did.\n",
                    arguments_.tolerance);
  text +=
      "\n| case | ended | it alone has | compared with | repeated by |\n|---|---|---|---|---|\n";
  for (const auto& one : chosen_) {
    text += fmt::format(
        "| {} | {} | {} | {} | `{}` |\n", one.index, cell(ending(one.index)),
        cell(fmt::format("{}", fmt::join(alone(one), "; "))),
        suite_.is_compared(one.index) ? "results and stimuli of the case" : "stimuli of the case",
        cell(input_.plan().command(input_.plan().at(one.index))));
  }
  text += fmt::format("\nMade by stride {} (`stride campaign distil`).\n", STRIDE_VERSION);
  return text;
}

void distil_campaign(const DistilArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign);
  input.require_plan();
  require_captured(input, arguments.component);
  input.refuse_output({"--out " + arguments.suite.string(), arguments.suite});
  const Interruption interruption;
  Distillation distillation(arguments, input);
  distillation.run();
  if (!arguments.quiet) distillation.print();
  distillation.require_all();
}

std::string number_mistake(const std::string& text) {
  try {
    core::parse_at_least_zero(text);
  } catch (const std::invalid_argument& mistake) {
    return mistake.what();
  }
  return "";
}

}  // namespace

void add_campaign_distil(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "distil",
      "Make a regression suite of a component that the campaign captures: the fewest cases that "
      "cover what all cover and end as all end, each played to the component alone");
  const auto arguments = std::make_shared<DistilArguments>();
  command
      ->add_option("FILE", arguments->campaign.file,
                   "The campaign (.xosc), whose plan is there, or the folder of its plan")
      ->required()
      ->type_name("");
  command->add_option("--component", arguments->component, "The component")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--out,--output,-o", arguments->suite,
                   "The folder of the suite, in which there is nothing yet")
      ->required()
      ->type_name("FOLDER");
  command
      ->add_option(
          "--tolerance", arguments->tolerance,
          "How far real numbers at the end may be from what they were, in their own units; "
          "otherwise all bits of all outputs are compared")
      ->type_name("NUMBER")
      ->check(number_mistake);
  command->add_flag("--quiet,-q", arguments->quiet, "Print nothing but warnings and errors");
  command->callback([arguments] { distil_campaign(*arguments); });
}

}  // namespace stride::cli
