// The campaign that a command names, with its plan.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CAMPAIGN_INPUT_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CAMPAIGN_INPUT_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "master/front/cli/program/crash_guard.h"
#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_range.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/plan.h"
#include "master/study/results/output_paths.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stride::cli {

struct CampaignArguments {
  std::filesystem::path file;  ///< or the folder of a plan
  std::filesystem::path out;   ///< empty: that folder, or campaigns/ and the name of the file
};

/// FILE|FOLDER and --out. `arguments` must outlive the command line.
void add_campaign_options(CLI::App& command, CampaignArguments& arguments);

/// --case INDEX, likewise.
CLI::Option* add_case_option(CLI::App& command, std::optional<std::uint64_t>& index,
                             const std::string& description);

/// --cases FIRST[-LAST], likewise.
CLI::Option* add_cases_option(CLI::App& command, std::optional<campaign::CaseRange>& range,
                              const std::string& description);

/// For which a command needs the units of a campaign.
enum class Purpose {
  Run,
  Read,  ///< records of cases: descriptions of units elsewhere are those that the plan was made of
};

/// A campaign, its scenario with all units, and its plan, in a guarded process.
class CampaignInput {
 public:
  /// Prints warnings. Throws core::Error (Input).
  explicit CampaignInput(const CampaignArguments& arguments, Purpose purpose = Purpose::Run);

  const campaign::CampaignScenario& scenario() const { return scenario_; }
  const campaign::Plan& plan() const { return plan_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// The word that names the campaign to a further command.
  std::string word() const;

  /// Throws core::Error (Input) if an output is one of the files that are read, or of the
  /// campaign's own beside its page.
  void refuse_output(const results::OutputPath& output) const;
  /// Throws core::Error (Input) if a file of these names in the folder is one that is read.
  void refuse_inputs(std::initializer_list<const char*> names) const;
  /// Throws core::Error (Input) where there is no plan yet, or another one.
  void require_plan() const;
  /// Checks and writes the plan, unless it is there. Throws core::Error (Input) if another one is.
  void make_plan() const;
  /// Writes the plan, whatever is there, but not over another one: then it throws likewise.
  void write_plan() const;
  /// The scenario of a case, without warnings: those of the campaign's have been printed. Throws
  /// core::Error (Input).
  scenario::RunPlan load_case(std::uint64_t index) const;
  /// Loads the scenarios of cases with other definitions of coverage; this object must outlive it.
  campaign::CaseDefinitions case_definitions() const;
  /// Throws core::Error (Input) for an index, given by this option, that no case has.
  void require_case(std::uint64_t index, const char* option) const;

 private:
  CampaignInput(const CampaignArguments& arguments, Purpose purpose, campaign::Campaign read);

  std::vector<results::KeptPath> inputs() const;

  const std::filesystem::path file_, folder_;
  const bool is_default_folder_;
  const campaign::CampaignScenario scenario_;
  const LimitedEnd end_;
  const campaign::Plan plan_;
};

}  // namespace stride::cli

#endif
