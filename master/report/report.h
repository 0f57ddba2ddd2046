// report.html: what a run was like, on one page that needs nothing else.
#ifndef STRIDE_MASTER_REPORT_REPORT_H
#define STRIDE_MASTER_REPORT_REPORT_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "master/observe/recorders/results_folder.h"
#include "master/report/column.h"
#include "master/report/results.h"
#include "master/report/run_file.h"

namespace stride::report {

/// What shares a diagram where the scenario names none: the real numbers of a component that have
/// the same unit of measure, and all else of a component (Booleans, counts, texts) together. In the
/// order of the columns. Without components, what is before a name's first point is one.
std::vector<recorders::Plot> default_plots(std::span<const Column> columns,
                                           std::span<const RunFile::Component> components);

/// Writes the page with these results to the file, which has its new content at once or not at all.
/// `version` is that of stride. The same results make the same bytes. Throws core::Error.
void write_report(const std::filesystem::path& file, const Results& results,
                  const std::string& version);

/// The same page, made anew whenever it is asked for while the run goes on: it may connect to where
/// it comes from, for the events that tell it of something new.
std::string live_report(const Results& results, const std::string& version);

}  // namespace stride::report

#endif
