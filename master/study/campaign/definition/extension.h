// What OpenSCENARIO has no word for: the element <Campaign> of the namespace
// urn:org.stride:campaign:1, beside <ParameterValueDistribution>.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_EXTENSION_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_EXTENSION_H

#include <filesystem>

#include "master/base/xml/element.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/parameter_list.h"

namespace stride::campaign {

/// Reads the element into the campaign, whose variation is read already: a method of sampling and
/// files of values are for one of its kinds only. Files are relative to `folder`. Throws
/// core::Error (Input) for what is unknown, doubled, missing or wrong.
void read_extension(const xml::Element& element, const std::filesystem::path& folder,
                    ParameterList& parameters, Campaign& campaign);

}  // namespace stride::campaign

#endif
