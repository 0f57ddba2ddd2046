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

/// Writes the report of the results in the folder, which have these names. Returns, in words, what
/// is missing there, as the page says it, too. Throws core::Error.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const io::ResultFiles& files,
                                      const std::filesystem::path& report);

/// Hands the file to the programs that $BROWSER names, the first that there is, or else to
/// xdg-open; does not wait for it. Throws core::Error (Run), whose hint is what to do instead.
void open_in_browser(const std::filesystem::path& file);

}  // namespace stride::cli

#endif
