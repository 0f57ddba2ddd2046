// The elements <Deterministic> and <Stochastic> of OpenSCENARIO.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DISTRIBUTION_ELEMENTS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DISTRIBUTION_ELEMENTS_H

#include "master/base/xml/element.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/parameter_list.h"

namespace stride::campaign {

/// Each adds the parameters that it names. Throws core::Error (Input) with file and line for what
/// is unknown, missing or wrong, and for a distribution whose type is defined by a user.
Deterministic read_deterministic(const xml::Element& element, ParameterList& parameters);
Stochastic read_stochastic(const xml::Element& element, ParameterList& parameters);

}  // namespace stride::campaign

#endif
