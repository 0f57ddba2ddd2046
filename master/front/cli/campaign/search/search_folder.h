// The folder of a search: what it was asked for, and its cases.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_FOLDER_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_FOLDER_H

#include <cstdint>
#include <filesystem>
#include <vector>

#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/plan.h"
#include "master/study/search/search.h"

namespace stride::cli {

/// campaigns/ and the name of the campaign's file, with ".search".
std::filesystem::path default_search_folder(const std::filesystem::path& campaign);

/// Whether a search is in the folder.
bool is_search_folder(const std::filesystem::path& folder);

/// Whether this very search is in the folder, with what decides which cases it has. How many of
/// them are run, and whether it goes on behind a failure, does not, so a search may go on with
/// others. Throws core::Error (Input) where there is another search, or a campaign.
bool is_this_search_in(const std::filesystem::path& folder, const search::Request& request,
                       const campaign::Plan& plan);
/// Writes search.json, unless it is there, as a whole or not at all; several processes may do so.
/// Throws likewise.
void begin_search_folder(const std::filesystem::path& folder, const search::Request& request,
                         const campaign::Plan& plan);

/// The file of the campaign that is searched. Throws core::Error (Input) for what is no search.
std::filesystem::path campaign_of_search(const std::filesystem::path& folder);
/// Throws core::Error (Input) where the search in the folder is one of another plan.
void require_plan_of_search(const std::filesystem::path& folder, const campaign::Plan& plan);

/// The values of a case that the search has run: those of the parameters, and then of the seeds.
/// Throws core::Error (Input) if it has not, and for a record of another case in its place.
std::vector<campaign::Text> values_in_search(const std::filesystem::path& folder,
                                             const campaign::Plan& plan, std::uint64_t index);

}  // namespace stride::cli

#endif
