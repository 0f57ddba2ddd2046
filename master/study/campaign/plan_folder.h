// The folder of a campaign: its plan, which later steps build on.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_FOLDER_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_FOLDER_H

#include <filesystem>
#include <optional>
#include <string>

#include "master/study/campaign/plan.h"

namespace stride::campaign {

inline constexpr const char* kPlanTable = "plan.csv";
inline constexpr const char* kPlanDescription = "campaign.json";
/// Of units that stay on other machines; only if there are some.
inline constexpr const char* kDescriptions = "descriptions.zip";
inline constexpr const char* kParameterSets = "parameters";
/// What a search is, in its folder: a campaign has another one.
inline constexpr const char* kSearchDescription = "search.json";

/// campaigns/ and the name of the campaign's file.
std::filesystem::path default_folder(const std::filesystem::path& campaign);

/// The identity of the plan that is in the folder; nothing if there is none. Throws core::Error
/// (Input) for a campaign.json that cannot be read.
std::optional<std::string> identity_in(const std::filesystem::path& folder);

/// The file of the campaign whose plan is in the folder. Throws core::Error (Input) likewise, and
/// where there is none.
std::filesystem::path campaign_of(const std::filesystem::path& folder);

/// Whether this plan is in the folder. Throws core::Error (Input) where another one is.
bool has_plan(const Plan& plan, const std::filesystem::path& folder);

/// Writes plan.csv, a row for each case, and then campaign.json; each is there as a whole or not at
/// all. Makes the folder where there is none. The same plan writes the same bytes. Throws
/// core::Error (Input) where there is another plan, and where another process has locked the
/// folder.
void write_plan(const Plan& plan, const std::filesystem::path& folder);

/// A value as a field of a CSV file: an empty text is in quotation marks, so that it is not taken
/// for no value.
std::string value_field(const Text& value);

/// The name of a case in names of files: "000017", as many digits as the last case needs, but no
/// fewer than six.
std::string case_name(const Plan& plan, std::uint64_t index);

/// The name of a case's parameter set below the folder: "parameters/000017.ssv".
std::filesystem::path parameter_set_name(const Plan& plan, std::uint64_t index);

/// Throws core::Error (Input) for a plan with what no parameter set can hold: swaps and
/// interventions.
void refuse_parameter_sets_of(const Plan& plan);
/// Writes the values of each case as a parameter set (SSP 2.0). Throws likewise.
void write_parameter_sets(const Plan& plan, const std::filesystem::path& folder);

/// Writes the start values of one case as such a set. What it cannot hold is left out.
void write_parameter_set(const Plan& plan, const Case& row, const std::filesystem::path& file);

}  // namespace stride::campaign

#endif
