// What OpenSCENARIO has no word for: the element <Campaign> of the namespace
// urn:org.stride:campaign:1, beside <ParameterValueDistribution>.
#ifndef STRIDE_MASTER_CAMPAIGN_EXTENSION_H
#define STRIDE_MASTER_CAMPAIGN_EXTENSION_H

#include <filesystem>

#include "master/campaign/definition.h"
#include "master/campaign/parameter_list.h"
#include "master/util/xml/element.h"

namespace stride::campaign {

/// Reads the element into the campaign, whose variation is read already: a method of sampling and
/// files of values are for one of its kinds only. Files are relative to `folder`. Throws
/// core::Error (Input) for what is unknown, doubled, missing or wrong.
void read_extension(const xml::Element& element, const std::filesystem::path& folder,
                    ParameterList& parameters, Campaign& campaign);

}  // namespace stride::campaign

#endif
