// The checks, each in a file of its own under checks/. docs/verify.md says what they mean.
#ifndef STRIDE_MASTER_VERIFY_CHECKS_H
#define STRIDE_MASTER_VERIFY_CHECKS_H

#include <vector>

#include "master/verify/finding.h"
#include "master/verify/trial.h"

namespace stride::verify {

struct UnitCheck {
  const char* name;
  const char* summary;  ///< what passes, in a line
  Finding (*run)(const Trial& trial);
};

/// In the order in which they are run. The first is the one without which no other makes sense.
const std::vector<UnitCheck>& checks();

Finding check_load(const Trial& trial);
Finding check_description(const Trial& trial);
Finding check_values(const Trial& trial);
Finding check_dependencies(const Trial& trial);
Finding check_events(const Trial& trial);
Finding check_calls(const Trial& trial);
Finding check_messages(const Trial& trial);
Finding check_splitting(const Trial& trial);
Finding check_rejection(const Trial& trial);
Finding check_reset(const Trial& trial);
Finding check_instances(const Trial& trial);
Finding check_restore(const Trial& trial);
Finding check_serialization(const Trial& trial);
Finding check_memory(const Trial& trial);
Finding check_determinism(const Trial& trial);

}  // namespace stride::verify

#endif
