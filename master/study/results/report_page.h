// The report of a results folder.
#ifndef STRIDE_MASTER_STUDY_RESULTS_REPORT_PAGE_H
#define STRIDE_MASTER_STUDY_RESULTS_REPORT_PAGE_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/observe/recorders/results_folder.h"

namespace stride::results {

/// Whether this build can make reports.
bool has_reports();

/// Writes the report of the results in the folder, which have these names. Returns
/// texts about what is missing there, which are on the page, too. Throws core::Error.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const recorders::ResultFiles& files,
                                      const std::filesystem::path& report);

/// The page of a run that goes on, as its files are now. `is_over`: they are complete. Throws
/// core::Error.
std::string live_report(const std::filesystem::path& folder, const recorders::ResultFiles& files,
                        bool is_over);

}  // namespace stride::results

#endif
