// report.html: what a run was like, on one page that needs nothing else.
#ifndef STRIDE_MASTER_REPORT_REPORT_H
#define STRIDE_MASTER_REPORT_REPORT_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/report/results.h"

namespace stride::report {

/// Writes the page with these results to the file, which has its new content at once or not at all.
/// `version` is that of stride. The same results make the same bytes. Throws core::Error.
void write_report(const std::filesystem::path& file, const Results& results,
                  const std::string& version);

}  // namespace stride::report

#endif
