#ifndef STRIDE_MASTER_STUDY_COMPARE_COMPARISON_PAGE_H
#define STRIDE_MASTER_STUDY_COMPARE_COMPARISON_PAGE_H

#include <filesystem>
#include <string>

#include "master/study/compare/compare.h"

namespace stride::compare {

/// Writes a page with all that differs, and the curves of both runs over each other. Signals that
/// do not differ are those of A. Reads the signals once more; very many values are thinned as in
/// the report of a run. `version` is that of stride. Throws core::Error where it cannot.
void write_comparison_page(const std::filesystem::path& file, const Comparison& comparison,
                           const Settings& settings, const std::string& version);

}  // namespace stride::compare

#endif
