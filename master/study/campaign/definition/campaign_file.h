// A campaign file: ASAM OpenSCENARIO XML's ParameterValueDistribution (1.1 to 1.3), whose scenario
// is one of SSP, and stride's own element beside it.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_CAMPAIGN_FILE_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_CAMPAIGN_FILE_H

#include <filesystem>

#include "master/study/campaign/definition/definition.h"

namespace stride::campaign {

/// Reads the file and those with values that it names; its scenario is not opened. Throws
/// core::Error (Input) with file and line for what is missing, malformed or unknown, for two
/// sources of one parameter, for a file of OpenSCENARIO that is no ParameterValueDistribution, and
/// for those parts of the standard that stride does not support: nothing is ignored, but the
/// header.
Campaign read_campaign(const std::filesystem::path& file);

}  // namespace stride::campaign

#endif
