// coverage.json, and coverage in the records of cases.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_COVERAGE_JSON_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_COVERAGE_JSON_H

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "master/observe/coverage/report.h"

namespace stride::coverage {

inline constexpr const char* kCoverageFile = "coverage.json";

/// As coverage.json has it.
nlohmann::ordered_json to_json(const Report& report);

/// The file is there as a whole or not at all. Throws core::Error as core::Replacement does.
void write_coverage(const std::filesystem::path& file, const Report& report);

/// Throws core::Error (Input) if the file cannot be read, is no coverage, or of another version.
Report read_coverage(const std::filesystem::path& file);

/// {"COMPONENT": {"POINT": {"BIN": [COUNT, FIRST]}}}
nlohmann::ordered_json to_json(const CoveredBins& covered);
/// Throws what nlohmann::json throws for what is no coverage.
CoveredBins covered_bins_of(const nlohmann::ordered_json& json);

}  // namespace stride::coverage

#endif
