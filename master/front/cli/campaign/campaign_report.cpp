#include "master/front/cli/campaign/campaign_report.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/browser.h"
#include "master/study/campaign/evaluation/campaign_page.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/report_page.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct CampaignReportArguments {
  CampaignArguments campaign;
  fs::path page;  ///< empty: in the folder of the campaign
  bool open = false;
};

void make_campaign_report(const CampaignReportArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign, Purpose::Read);
  input.require_plan();
  fs::path page = arguments.page;
  if (page.empty()) {
    input.refuse_inputs({campaign::kCampaignPage});
    page = input.folder() / campaign::kCampaignPage;
  } else {
    input.refuse_output({"--page " + page.string(), page});
  }
  write_campaign_report(page, input, campaign::CaseFolder(input.plan(), input.folder()));
  print_text("Page in {}\n", page.string());
  if (arguments.open) open_in_browser(page);
}

}  // namespace

void write_campaign_report(const fs::path& file, const CampaignInput& input,
                           const campaign::CaseFolder& cases) {
  const scenario::RunPlan& loaded = input.scenario().loaded();
  campaign::write_campaign_page(file, input.plan(), cases,
                                loaded.scenario().annotation.results.report,
                                input.case_definitions());
}

void add_campaign_report(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "report", "Make the page of a campaign from what is known of its cases so far");
  const auto arguments = std::make_shared<CampaignReportArguments>();
  add_campaign_options(*command, arguments->campaign);
  command
      ->add_option("--page", arguments->page,
                   "Write the page there instead of into the folder of the campaign")
      ->type_name("FILE");
  command->add_flag("--open", arguments->open, "Open the page in a browser");
  command->callback([arguments] { make_campaign_report(*arguments); });
}

}  // namespace stride::cli
