// Systems in systems become one system of components.
#ifndef STRIDE_MASTER_SYSTEM_SSP_FLATTEN_H
#define STRIDE_MASTER_SYSTEM_SSP_FLATTEN_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

struct FlatSystem {
  core::SystemDeclaration declaration;
  std::vector<std::filesystem::path> sources;  ///< of the components, in their order
};

/// A component is named by its path from the root system, which is left out itself:
/// "arm.motor.controller". Connections lead from component to component, by way of the connectors
/// of systems and the signals of dictionaries in between. A value for a connector of a system, or
/// for an element of one ("u[2]"), goes to all that it leads to, and replaces the values given
/// there. Otherwise values bound to a system replace those bound to what is in it, and required
/// ones all others. What leads nowhere is listed in `warnings`. Throws core::Error (Input).
FlatSystem flatten(const SystemNode& root, std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
