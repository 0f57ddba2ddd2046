// Reads the variables of an FMI 3.0 modelDescription.xml, with what their declared types add.
#ifndef STRIDE_MASTER_IMPORTER_FMI3_FMI3_VARIABLES_H
#define STRIDE_MASTER_IMPORTER_FMI3_FMI3_VARIABLES_H

#include <map>
#include <vector>

#include "master/model/description.h"
#include "master/util/xml/element.h"

namespace stride::importer {

/// Value reference -> index of the variable.
using VariableIndex = std::map<core::ValueReference, std::size_t>;

/// Appends the variables of <ModelVariables> in order. Throws core::Error as
/// read_model_description() says.
VariableIndex read_variables(const xml::Element& root, std::vector<core::Variable>& variables);

}  // namespace stride::importer

#endif
