// The report of a results folder, for `run` and for `report`.
#ifndef STRIDE_MASTER_CLI_REPORT_PAGE_H
#define STRIDE_MASTER_CLI_REPORT_PAGE_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/recorders/results_folder.h"

namespace stride::cli {

/// Whether this build can make reports.
bool has_reports();

/// Writes the report of the results in the folder, which have these names. Returns
/// texts about what is missing there, which are on the page, too. Throws core::Error.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const recorders::ResultFiles& files,
                                      const std::filesystem::path& report);

/// Starts the first existing program of $BROWSER, or else xdg-open, with the file, and does not
/// wait for it. Throws core::Error (Run) with a hint.
void open_in_browser(const std::filesystem::path& file);

}  // namespace stride::cli

#endif
