#ifndef STRIDE_MASTER_STUDY_COMPARE_COMPARISON_JSON_H
#define STRIDE_MASTER_STUDY_COMPARE_COMPARISON_JSON_H

#include <filesystem>

#include "master/report/page_data.h"
#include "master/study/compare/compare.h"

namespace stride::compare {

/// All of it, as docs/compare.md has it.
report::Json comparison_json(const Comparison& comparison, const Settings& settings);

/// Writes it to a file. Throws core::Error where it cannot.
void write_comparison(const std::filesystem::path& file, const Comparison& comparison,
                      const Settings& settings);

}  // namespace stride::compare

#endif
