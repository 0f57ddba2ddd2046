// stride campaign: many variations of a scenario, and the plan of them.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/front/cli/campaign/campaign_report.h"
#include "master/front/cli/campaign/campaign_run.h"
#include "master/front/cli/campaign/campaign_submit.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/distil/campaign_distil.h"
#include "master/front/cli/campaign/search/campaign_search.h"
#include "master/front/cli/campaign/search/campaign_shrink.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/study/campaign/evaluation/case_columns.h"
#include "master/study/campaign/plan.h"
#include "master/study/campaign/plan_check.h"
#include "master/study/campaign/plan_folder.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct PlanArguments {
  CampaignArguments campaign;
  bool ssv = false;
  std::optional<std::uint64_t> only;  ///< the case to be printed
};

constexpr std::size_t kMostAlternatives = 5;
constexpr std::uint64_t kShownCases = 5;

std::string table_text(const campaign::ValueTable& table, std::size_t place) {
  const auto found = std::ranges::find(table.parameters, place);
  const auto column = static_cast<std::size_t>(found - table.parameters.begin());
  std::vector<std::string> texts;
  for (const auto& row : table.rows) {
    texts.push_back(row.values[column].value_or(campaign::kScenarioValue));
  }
  const std::string list = core::abridged(texts, kMostAlternatives);
  return table.parameters.size() == 1 ? list : "together with others: " + list;
}

/// How the values of the column come about.
std::string variation_text(const campaign::Campaign& campaign, std::size_t place) {
  if (place >= campaign.parameters.size()) return "a seed of its own in each case";
  if (const auto* const drawn = std::get_if<campaign::Stochastic>(&campaign.variation)) {
    for (const auto& [parameter, distribution, where] : drawn->parameters) {
      if (parameter == place) return to_text(distribution);
    }
    return "";
  }
  for (const auto& factor : std::get<campaign::Deterministic>(campaign.variation).factors) {
    if (const auto* const table = std::get_if<campaign::ValueTable>(&factor)) {
      if (std::ranges::find(table->parameters, place) == table->parameters.end()) continue;
      return table_text(*table, place);
    }
    const auto& range = std::get<campaign::ValueRange>(factor);
    if (range.parameter != place) continue;
    return fmt::format("{} from {} to {}", core::counted(range.count, "value"),
                       step_text(range.first, range.step, 0),
                       step_text(range.first, range.step, range.count - 1));
  }
  return "";
}

std::string parameter_table(const campaign::Plan& plan) {
  Table table({{"parameter"}, {"values", Table::Align::Left, true}});
  for (std::size_t i = 0; i < plan.columns().size(); ++i) {
    table.add({plan.columns()[i].parameter.name, variation_text(plan.campaign(), i)});
  }
  return table.text(output_width());
}

std::string case_table(const campaign::Plan& plan) {
  std::vector<Table::Column> columns{{"case", Table::Align::Right}};
  for (const auto& column : plan.columns()) {
    columns.push_back({column.parameter.name, Table::Align::Right, true});
  }
  Table table(std::move(columns));
  for (std::uint64_t i = 0; i < std::min(plan.size(), kShownCases); ++i) {
    const campaign::Case row = plan.at(i);
    std::vector<std::string> fields{std::to_string(i)};
    for (const campaign::Text& value : row.values)
      fields.push_back(value.value_or(campaign::kScenarioValue));
    table.add(std::move(fields));
  }
  return table.text(output_width());
}

std::string method_text(const campaign::Campaign& campaign) {
  const auto* const drawn = std::get_if<campaign::Stochastic>(&campaign.variation);
  if (drawn == nullptr) return "all combinations";
  return fmt::format("{}, random seed {}", name(drawn->method), campaign.random_seed);
}

void print_plan(const campaign::Plan& plan, const fs::path& folder, bool ssv) {
  const campaign::Campaign& campaign = plan.campaign();
  print_text("{}: {} of {}, {}\n", campaign.file.stem().string(),
             core::counted(plan.size(), "case"), campaign.scenario.string(), method_text(campaign));
  print_text("\nParameters\n{}", parameter_table(plan));
  print_text("\n{} cases\n{}", plan.size() > kShownCases ? "First" : "All", case_table(plan));
  print_text("\nPlan in {}: {} {}{}\n", folder.string(), campaign::kPlanTable,
             campaign::kPlanDescription,
             ssv ? fmt::format(" {}", campaign::parameter_set_name(plan, 0).string() +
                                          (plan.size() > 1 ? " …" : ""))
                 : "");
}

void print_case(const campaign::Plan& plan, std::uint64_t index) {
  print_text("{}\n", plan.command(plan.at(index)));
}

void plan_campaign(const PlanArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign);
  const campaign::Plan& plan = input.plan();
  campaign::check_plan(plan, input.scenario());
  if (arguments.only) {
    input.require_case(*arguments.only, "--case");
    return print_case(plan, *arguments.only);
  }
  input.refuse_inputs({campaign::kPlanTable, campaign::kPlanDescription, campaign::kDescriptions});
  if (arguments.ssv) campaign::refuse_parameter_sets_of(plan);
  input.write_plan();
  if (arguments.ssv) campaign::write_parameter_sets(plan, input.folder());
  print_plan(plan, input.folder(), arguments.ssv);
}

}  // namespace

void add_campaign(CLI::App& app) {
  CLI::App* group = app.add_subcommand("campaign", "Plan and run many variations of a scenario");
  group->require_subcommand(1);
  CLI::App* command = group->add_subcommand(
      "plan", "Make the table of a campaign's cases, check all of their values, and run nothing");
  const auto arguments = std::make_shared<PlanArguments>();
  add_campaign_options(*command, arguments->campaign);
  command->add_flag("--ssv", arguments->ssv,
                    "Write the values of each case as a parameter set, too, for 'stride run "
                    "--parameters' and other tools");
  add_case_option(*command, arguments->only,
                  "Print the command that runs this case, counted from 0, and write nothing");
  command->callback([arguments] { plan_campaign(*arguments); });
  add_campaign_run(*group);
  add_campaign_submit(*group);
  add_campaign_status(*group);
  add_campaign_report(*group);
  add_campaign_search(*group);
  add_campaign_shrink(*group);
  add_campaign_distil(*group);
}

}  // namespace stride::cli
