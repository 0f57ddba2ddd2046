// Reads what a modelDescription.xml of FMI 3.0 has of its own (2.4 there).
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI3_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI3_DESCRIPTION_H

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"

namespace stride::importer {

/// Throws as read_model_description() does.
void read_fmi3_description(const xml::Element& root, core::UnitDescription& unit);

}  // namespace stride::importer

#endif
