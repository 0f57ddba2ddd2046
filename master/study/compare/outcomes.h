#ifndef STRIDE_MASTER_STUDY_COMPARE_OUTCOMES_H
#define STRIDE_MASTER_STUDY_COMPARE_OUTCOMES_H

#include <filesystem>

#include "master/report/page_data.h"
#include "master/study/compare/criteria/difference.h"
#include "master/study/compare/criteria/settings.h"

namespace stride::compare {

/// run.json, and which file it is.
struct RunRecord {
  const report::Json& json;
  std::filesystem::path file;
};

/// How the runs have ended, verdicts of units, and checks. If nothing is tolerated, also the words
/// and the margins of verdicts, which contain values. Throws core::Error (Input) for lists that
/// are none.
Differences compare_outcomes(const RunRecord& a, const RunRecord& b, const Settings& settings);

}  // namespace stride::compare

#endif
