// Which of the recorded variables are drawn together.
#ifndef STRIDE_MASTER_SCENARIO_PLOT_SELECTION_H
#define STRIDE_MASTER_SCENARIO_PLOT_SELECTION_H

#include <span>
#include <string>
#include <vector>

#include "master/algorithm/observer.h"
#include "master/model/system.h"
#include "master/recorders/result_files.h"
#include "master/scenario/annotation.h"

namespace stride::io {

/// What the patterns match of the recorded variables: in the order of a plot's patterns, for each
/// pattern in that of the record, each variable once in a plot. Throws core::Error (Input) for a
/// pattern that matches nothing recorded, naming what is near.
std::vector<Plot> select_plots(const core::System& system,
                               std::span<const core::VariableId> recorded,
                               std::span<const PlotPattern> patterns);

/// Likewise where the user has chosen other signals than the scenario's: what is not recorded is
/// not drawn, and a plot of which nothing is left is left out.
std::vector<Plot> remaining_plots(const core::System& system,
                                  std::span<const core::VariableId> recorded,
                                  std::span<const PlotPattern> patterns);

}  // namespace stride::io

#endif
