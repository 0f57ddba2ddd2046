#ifndef STRIDE_MASTER_COMPARE_COMPARISON_JSON_H
#define STRIDE_MASTER_COMPARE_COMPARISON_JSON_H

#include <filesystem>

#include "master/compare/compare.h"

namespace stride::compare {

/// Writes all of it, as docs/compare.md has it. Throws core::Error where it cannot.
void write_comparison(const std::filesystem::path& file, const Comparison& comparison,
                      const Settings& settings);

}  // namespace stride::compare

#endif
