#ifndef STRIDE_MASTER_REPORT_DEFAULT_PLOTS_H
#define STRIDE_MASTER_REPORT_DEFAULT_PLOTS_H

#include <span>
#include <vector>

#include "master/recorders/results_folder.h"
#include "master/report/column.h"
#include "master/report/run_file.h"

namespace stride::report {

/// What shares a diagram where the scenario says nothing: the real numbers of a component that have
/// the same unit of measure, and all else of a component (Booleans, counts, texts) together. In the
/// order of the columns. Without components, what is before a name's first point is one.
std::vector<recorders::Plot> default_plots(std::span<const Column> columns,
                                           std::span<const RunFile::Component> components);

}  // namespace stride::report

#endif
