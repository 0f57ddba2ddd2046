#include "master/front/cli/campaign/search/campaign_shrink.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/text/counted.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/search/campaign_search.h"
#include "master/front/cli/campaign/search/listed_cases.h"
#include "master/front/cli/campaign/search/search_folder.h"
#include "master/front/cli/campaign/search/search_summary.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/search/objective.h"
#include "master/study/search/shrink.h"
#include "master/study/search/way.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShrunk = "shrunk";

struct ShrinkArguments {
  CampaignArguments campaign;
  std::optional<std::uint64_t> index;
  double tolerance = 0.01;  ///< as a share of each parameter's way
  std::string check;        ///< empty: the first one that has failed
  bool quiet = false;
};

/// FILE may be the folder of a search, or --out may.
CampaignArguments shrunk_from(const CampaignArguments& named) {
  if (!named.out.empty() || !is_search_folder(named.file)) return named;
  return {campaign_of_search(named.file), named.file};
}

/// The values of the parameters, and then of the seeds.
search::Row values_of(const CampaignInput& input, std::uint64_t index) {
  if (is_search_folder(input.folder())) {
    require_plan_of_search(input.folder(), input.plan());
    return values_in_search(input.folder(), input.plan(), index);
  }
  input.require_plan();
  input.require_case(index, "--case");
  return input.plan().at(index).values;
}

struct Interrupted {};

/// A case on its way back, as the run of each of its steps.
class ShrinkingCase {
 public:
  ShrinkingCase(const ShrinkArguments& arguments, const CampaignInput& input,
                const fs::path& folder)
      : arguments_(arguments),
        input_(input),
        values_(values_of(input, *arguments.index)),
        ways_(search::ways_of(input.plan(), input.scenario(), values_, arguments.tolerance)),
        cases_(input.plan(), seeds_of(input.plan(), {.values = values_}), folder,
               local_batches(input.scenario(), 1)) {}

  void run() {
    failure_ = find_failure();
    std::vector<bool> is_continuous;
    for (const search::Way& way : ways_) is_continuous.push_back(way.is_continuous());
    const auto fails = [&](const search::Shares& shares) {
      return search::failures_of(result(shares)).contains(failure_);
    };
    shrunk_ = search::shrink(is_continuous, arguments_.tolerance, fails);
    result(shrunk_.failing);  // of a case without parameters
  }

  /// The case that is left, as one of plan().
  campaign::Case left() const { return cases_.plan().at(known_.at(row(shrunk_.failing))); }
  const campaign::Plan& plan() const { return cases_.plan(); }

  std::string text() const {
    return fmt::format("{}: case {} fails by '{}', shrunk by {}\n\n{}\n{}\n",
                       input_.plan().campaign().file.stem().string(), *arguments_.index, failure_,
                       core::counted(cases_.size(), "run"), table(), sentence());
  }

 private:
  search::Row row(const search::Shares& shares) const {
    search::Row values;
    for (std::size_t i = 0; i < ways_.size(); ++i) values.push_back(ways_[i].at(shares[i]));
    return values;
  }

  const campaign::CaseResult& result(const search::Shares& shares) {
    const search::Row values = row(shares);
    const auto [place, is_new] = known_.emplace(values, cases_.size());
    if (is_new && !cases_.add({values})) throw Interrupted();
    return cases_.result(place->second);
  }

  /// Of the case itself.
  std::string find_failure() {
    const campaign::CaseResult& itself = result(search::Shares(ways_.size(), 1));
    const std::uint64_t index = *arguments_.index;
    const std::string& check = arguments_.check;
    if (!check.empty()) {
      if (search::failures_of(itself).contains(check)) return check;
      core::fail_input({}, fmt::format("--case {}: this case does not fail by '{}'", index, check));
    }
    if (!search::came_to_its_end(itself)) return name(itself.outcome);
    for (const campaign::CaseVerdict& verdict : itself.verdicts) {
      if (verdict.passed == false) return verdict.name;
    }
    core::fail_input(
        {}, fmt::format("--case {}: this case passes, so there is nothing to shrink", index));
  }

  bool is_needed(std::size_t i) const { return shrunk_.failing[i] != 0; }

  std::string table() const {
    Table table({{"parameter"},
                 {"in the scenario", Table::Align::Right},
                 {fmt::format("case {}", *arguments_.index), Table::Align::Right, true},
                 {"fails with", Table::Align::Right},
                 {"passes with", Table::Align::Right}});
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const search::Way& way = ways_[i];
      const std::string nominal = nominal_text(way.kind(), way.nominal());
      const auto& passing = shrunk_.passing[i];
      table.add({parameter_title(input_.plan(), input_.scenario(), i), nominal,
                 way.at(1).value_or(nominal), value_text(i, shrunk_.failing[i]),
                 passing ? value_text(i, *passing) : ""});
    }
    return table.text(output_width());
  }

  std::string value_text(std::size_t i, double share) const {
    const campaign::Text text = ways_[i].at(share);
    return text ? *text : nominal_text(ways_[i].kind(), ways_[i].nominal());
  }

  /// "It fails from 7.3 mm of arm.offset on, all else as in the scenario."
  std::string sentence() const {
    std::vector<std::string> boundaries, others;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      if (!is_needed(i)) continue;
      const std::string& name = input_.plan().columns()[i].parameter.name;
      const std::string value = value_text(i, shrunk_.failing[i]);
      if (!ways_[i].is_continuous()) {
        others.push_back(fmt::format("with {} = {}", name, value));
        continue;
      }
      const std::string unit = input_.scenario().unit_of_measure(i);
      const bool goes_up = *ways_[i].number() > *ways_[i].nominal();
      boundaries.push_back(fmt::format("from {}{}{} of {} {}", value, unit.empty() ? "" : " ", unit,
                                       name, goes_up ? "on" : "down"));
    }
    boundaries.insert(boundaries.end(), others.begin(), others.end());
    if (boundaries.empty()) return "It fails with all as in the scenario.";
    return fmt::format("It fails {}, all else as in the scenario.", fmt::join(boundaries, ", "));
  }

  const ShrinkArguments& arguments_;
  const CampaignInput& input_;
  const search::Row values_;
  const std::vector<search::Way> ways_;
  ListedCases cases_;
  std::string failure_;
  search::Shrunk shrunk_;
  std::map<search::Row, std::uint64_t> known_;  ///< by the values of the parameters
};

/// Not a number is none, either.
std::string tolerance_mistake(const std::string& text) {
  constexpr double kLeast = 1e-9, kMost = 0.5;
  const auto share = campaign::number_of(text);
  if (share && *share >= kLeast && *share <= kMost) return "";
  return fmt::format("'{}' is no number from {} to {}", core::name_text(text), kLeast, kMost);
}

void shrink_case(const ShrinkArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(shrunk_from(arguments.campaign));
  input.refuse_inputs({kShrunk});
  require_check(input.scenario(), arguments.check);
  const fs::path folder = input.folder() / kShrunk / fmt::format("{:06}", *arguments.index);
  ShrinkingCase shrinking(arguments, input, folder);
  recorders::make_results_folder(folder);
  const recorders::ResultsLock lock(folder);
  const Interruption interruption;
  try {
    shrinking.run();
  } catch (const Interrupted&) {
    core::fail_run({}, "shrinking was interrupted", "it goes on with the same command");
  }
  const fs::path set = folder.string() + ".ssv";
  const campaign::Case left = shrinking.left();
  campaign::Case named = left;  // after the case that it was made of
  named.index = *arguments.index;
  campaign::write_parameter_set(shrinking.plan(), named, set);
  if (arguments.quiet) return;
  const campaign::Campaign& campaign = input.plan().campaign();
  const bool has_more = !campaign.swaps.empty() || !campaign.interventions.empty();
  print_text("{}\nRepeated by\n  {}\n\nParameter set in {}{}\n", shrinking.text(),
             shrinking.plan().command(left), set.string(),
             has_more ? ", without swaps and interventions" : "");
}

}  // namespace

void add_campaign_shrink(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "shrink", "Set the parameters of a failing case back as far as its failure stays");
  const auto arguments = std::make_shared<ShrinkArguments>();
  add_campaign_options(*command, arguments->campaign);
  command->get_option("FILE")->description(
      "The campaign (.xosc), whose plan is there, or the folder of a plan or of a search");
  add_case_option(*command, arguments->index, "The case, counted from 0")->required();
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "How exactly boundaries are found, as a share of the way from the scenario's "
                   "value to that of the case; 0.01 otherwise")
      ->type_name("SHARE")
      ->check(tolerance_mistake);
  command
      ->add_option("--check", arguments->check,
                   "The failure that has to stay; otherwise the first check that has failed")
      ->type_name("NAME");
  command->add_flag("--quiet,-q", arguments->quiet, "Print nothing but warnings and errors");
  command->callback([arguments] { shrink_case(*arguments); });
}

}  // namespace stride::cli
