#ifndef STRIDE_INTERFACES_UNIT_VARIABLE_NAME_H
#define STRIDE_INTERFACES_UNIT_VARIABLE_NAME_H

#include <string_view>

namespace stride::kit {

/// Whether a name follows the grammar of variableNamingConvention="structured" (FMI 3.0,
/// 2.4.7.5.1): parts joined by dots, each an identifier or quoted, with array indices if it is an
/// element ("robot.axes[2,1]", "'left arm'.angle"), or the derivative of such ("der(x)",
/// "der(x,2)").
bool is_structured_name(std::string_view name);

}  // namespace stride::kit

#endif
