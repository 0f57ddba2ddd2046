#include "master/front/cli/campaign/cases/campaign_input.h"

#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/base/text/counted.h"
#include "master/front/cli/program/output.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/definition/campaign_file.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan_check.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/results/output_paths.h"
#include "master/system/plan/kept_descriptions.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

/// Also the campaign itself, if values are there.
std::set<std::string> value_files(const campaign::Campaign& campaign) {
  std::set<std::string> files;
  const auto* const deterministic = std::get_if<campaign::Deterministic>(&campaign.variation);
  if (deterministic == nullptr) return files;
  for (const campaign::Factor& factor : deterministic->factors) {
    const auto* const table = std::get_if<campaign::ValueTable>(&factor);
    if (table == nullptr) continue;
    for (const auto& row : table->rows) files.insert(row.where.file);
  }
  return files;
}

fs::path campaign_file(const CampaignArguments& arguments) {
  if (!core::is_folder(arguments.file)) return arguments.file;
  const fs::path file = campaign::campaign_of(arguments.file);
  if (arguments.out.empty()) return file;
  core::fail_input(
      {.where = {arguments.file.string(), 0}},
      "this is the folder of a campaign, so --out cannot name another one",
      fmt::format("name the file of the campaign, {}, or give no --out", file.string()));
}

fs::path campaign_folder(const CampaignArguments& arguments) {
  if (core::is_folder(arguments.file)) return arguments.file;
  return arguments.out.empty() ? campaign::default_folder(arguments.file) : arguments.out;
}

scenario::UnitStore known_units(const fs::path& folder, Purpose purpose) {
  if (purpose != Purpose::Read) return {};
  return scenario::kept_descriptions(folder / campaign::kDescriptions);
}

class NoWarnings {
 public:
  NoWarnings() { spdlog::set_level(spdlog::level::err); }
  ~NoWarnings() { spdlog::set_level(before_); }
  NoWarnings(const NoWarnings&) = delete;
  NoWarnings& operator=(const NoWarnings&) = delete;

 private:
  const spdlog::level::level_enum before_ = spdlog::get_level();
};

campaign::Campaign read_with_warnings(const fs::path& file) {
  campaign::Campaign read = campaign::read_campaign(file);
  print_warnings(read.warnings);
  return read;
}

}  // namespace

void add_campaign_options(CLI::App& command, CampaignArguments& arguments) {
  command
      .add_option("FILE", arguments.file,
                  "The campaign: a ParameterValueDistribution of OpenSCENARIO (.xosc) whose "
                  "scenario is a .ssd, .ssp or .fmu; or the folder of its plan")
      ->required()
      ->type_name("");
  command
      .add_option("--out,--output,-o", arguments.out,
                  "Folder of the campaign; otherwise campaigns/ and the name of FILE")
      ->type_name("FOLDER");
}

CLI::Option* add_case_option(CLI::App& command, std::optional<std::uint64_t>& index,
                             const std::string& description) {
  const auto read = [&index](const std::string& text) {
    index = campaign::parse_case_index(text);
    if (index) return;
    throw CLI::ValidationError(
        "--case", fmt::format("'{}' is no whole number from 0 to {}", core::name_text(text),
                              campaign::Plan::kMostCases - 1));
  };
  return command.add_option_function<std::string>("--case", read, description)->type_name("INDEX");
}

CLI::Option* add_cases_option(CLI::App& command, std::optional<campaign::CaseRange>& range,
                              const std::string& description) {
  const auto read = [&range](const std::string& text) {
    range = campaign::parse_case_range(text);
    if (range) return;
    throw CLI::ValidationError("--cases", "'" + core::name_text(text) + "' is not as 20-29 or 7");
  };
  return command.add_option_function<std::string>("--cases", read, description)
      ->type_name("FIRST[-LAST]");
}

CampaignInput::CampaignInput(const CampaignArguments& arguments, Purpose purpose)
    : CampaignInput(arguments, purpose, read_with_warnings(campaign_file(arguments))) {}

CampaignInput::CampaignInput(const CampaignArguments& arguments, Purpose purpose,
                             campaign::Campaign read)
    : file_(read.file),
      folder_(campaign_folder(arguments)),
      is_default_folder_(folder_ == campaign::default_folder(file_)),
      scenario_(read, STRIDE_VERSION, known_units(folder_, purpose)),
      plan_(std::move(read), scenario_.kinds(), scenario_.fingerprints()) {}

std::string CampaignInput::word() const { return (is_default_folder_ ? file_ : folder_).string(); }

std::vector<results::KeptPath> CampaignInput::inputs() const {
  std::vector<results::KeptPath> inputs = results::inputs_of(scenario_.loaded());
  inputs.push_back({file_, "the campaign"});
  for (const std::string& file : value_files(plan_.campaign())) {
    inputs.push_back({file, "a file of the campaign's values"});
  }
  return inputs;
}

void CampaignInput::refuse_output(const results::OutputPath& output) const {
  using namespace campaign;
  std::vector<results::KeptPath> kept = inputs();
  for (const char* name : {kPlanTable, kPlanDescription, kDescriptions, kCaseTable, kCaseLines}) {
    kept.push_back({folder_ / name, fmt::format("{} of the campaign", name)});
  }
  results::refuse_kept_paths({&output, 1}, kept);
  results::refuse_folders(output, folder_, {kCases, kRunning}, "the campaign");
}

void CampaignInput::refuse_inputs(std::initializer_list<const char*> names) const {
  const std::vector<results::KeptPath> kept = inputs();
  for (const char* name : names) {
    const results::OutputPath output{fmt::format("{} in the folder {}", name, folder_.string()),
                                     folder_ / name};
    results::refuse_kept_paths({&output, 1}, kept);
  }
}

void CampaignInput::require_plan() const {
  if (campaign::has_plan(plan_, folder_)) return;
  core::fail_input({.where = {folder_.string(), 0}}, "there is no plan in this folder",
                   fmt::format("make it with: stride campaign run {}", word()));
}

/// Several processes may want to make it: one of them does.
void CampaignInput::make_plan() const {
  constexpr int kAttempts = 100;
  constexpr std::chrono::milliseconds kPause{100};
  for (int attempt = 1; !campaign::has_plan(plan_, folder_); ++attempt) {
    if (attempt == 1) campaign::check_plan(plan_, scenario_);
    try {
      return write_plan();
    } catch (const core::Error&) {
      if (attempt == kAttempts || !core::is_folder(folder_)) throw;
    }
    std::this_thread::sleep_for(kPause);
  }
}

void CampaignInput::write_plan() const {
  campaign::write_plan(plan_, folder_);
  std::vector<const scenario::RunPlan*> scenarios{&scenario_.loaded()};
  for (const auto& alternative : scenario_.alternatives()) scenarios.push_back(&alternative.loaded);
  scenario::keep_descriptions(scenarios, folder_ / campaign::kDescriptions);
}

scenario::RunPlan CampaignInput::load_case(std::uint64_t index) const {
  const NoWarnings quiet;
  scenario::ScenarioRequest request = plan_.request(plan_.at(index));
  request.files = scenario_.loaded().scenario().files;
  request.units = scenario_.units();
  return scenario::RunPlan(request);
}

campaign::CaseDefinitions CampaignInput::case_definitions() const {
  return campaign::CaseDefinitions(scenario_.loaded().coverage(), [this](std::uint64_t index) {
    return load_case(index).coverage();
  });
}

void CampaignInput::require_case(std::uint64_t index, const char* option) const {
  if (index < plan_.size()) return;
  core::fail_input({}, fmt::format("{} {}: the campaign has {}, the last one is {}", option, index,
                                   core::counted(plan_.size(), "case"), plan_.size() - 1));
}

}  // namespace stride::cli
