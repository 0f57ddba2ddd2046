// Reads what a modelDescription.xml of FMI 2.0 has of its own (2.2 and 4.3 there).
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI2_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI2_DESCRIPTION_H

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"
#include "master/loader/fmu/description/fmi2_attributes.h"

namespace stride::importer {

/// Each <ScalarVariable> becomes a variable, aliases as well: they may differ in causality, and so
/// in what can be connected, and in their dependencies. Its reference is its index, see
/// Fmi2Attributes, which are returned. Throws as read_model_description() does, and where two
/// inputs are aliases of each other, which FMI 2.0 forbids (2.2.7).
Fmi2Attributes read_fmi2_description(const xml::Element& root, core::UnitDescription& unit);

}  // namespace stride::importer

#endif
