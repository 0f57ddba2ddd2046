// What a description of an FMI 1.0 unit contains beside what core knows.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI1_ATTRIBUTES_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_FMI1_ATTRIBUTES_H

#include <vector>

#include <stride/fmi1.h>

namespace stride::importer {

/// As in FMI 2.0, see Fmi2Attributes.
struct Fmi1Attributes {
  std::vector<fmi1ValueReference> references;  ///< of the variables, in order
  /// Which of them are negated aliases: -v of a number v, and the other one of a Boolean.
  std::vector<bool> negated;
  bool can_reject_steps = false;  ///< it can repeat a step of which it has completed nothing
};

}  // namespace stride::importer

#endif
