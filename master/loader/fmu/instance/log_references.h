// References to variables in the messages of FMI 1.0 and FMI 2.0 units.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_LOG_REFERENCES_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_LOG_REFERENCES_H

#include <cstdint>
#include <functional>
#include <string>

namespace stride::importer {

/// The name of a variable of this type ('r', 'i', 'b', 's') with this value reference; empty if
/// there is none.
using VariableName = std::function<std::string(char type, std::uint32_t reference)>;

/// Puts names in place of references such as #r1365#, and # in place of ## (FMI 2.0, 2.1.5). What
/// refers to no variable stays as it is.
std::string name_variables(const std::string& message, const VariableName& name_of);

}  // namespace stride::importer

#endif
