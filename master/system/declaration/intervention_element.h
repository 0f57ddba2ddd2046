// The elements that describe interventions: <Set>, <Force>, <Drop>, <Delay>, <Corrupt>.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_INTERVENTION_ELEMENT_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_INTERVENTION_ELEMENT_H

#include "master/base/xml/element.h"
#include "master/system/declaration/interventions.h"

namespace stride::scenario {

/// Reads an element that has one of these names, in whatever namespace. Throws core::Error (Input)
/// for attributes that are unknown, missing or wrong.
InterventionDeclaration read_intervention(const xml::Element& element);

}  // namespace stride::scenario

#endif
