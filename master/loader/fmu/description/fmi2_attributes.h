// What a description of an FMI 2.0 unit contains beside what core knows.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI2_ATTRIBUTES_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI2_ATTRIBUTES_H

#include <vector>

#include <stride/fmi2.h>

namespace stride::importer {

/// In FMI 2.0 a value reference is unique among the variables of one base type, and several of them
/// may share it (aliases). To core, each variable has a reference of its own, its index in the
/// description; Fmi2Unit replaces it by the unit's.
struct Fmi2Attributes {
  std::vector<fmi2ValueReference> references;  ///< of the variables, in order
  bool can_run_asynchronously = false;         ///< fmi2DoStep may return fmi2Pending
};

}  // namespace stride::importer

#endif
