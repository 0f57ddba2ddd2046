// Reads what a modelDescription.xml of FMI 1.0 for Co-Simulation has of its own.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI1_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI1_DESCRIPTION_H

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"
#include "master/loader/fmu/description/fmi1_attributes.h"

namespace stride::importer {

/// Each <ScalarVariable> becomes a variable whose reference is its index, see Fmi1Attributes, which
/// are returned; those of the causality "internal" or "none" are parameters if their variability is
/// "parameter", else local. A text or an Enumeration with alias="negatedAlias" is left out, with a
/// warning.
/// Throws as read_model_description() does, and for units that are coupled to a tool.
Fmi1Attributes read_fmi1_description(const xml::Element& root, core::UnitDescription& unit);

}  // namespace stride::importer

#endif
