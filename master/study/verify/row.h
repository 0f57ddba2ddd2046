// What was seen of a unit at one instant.
#ifndef STRIDE_MASTER_STUDY_VERIFY_ROW_H
#define STRIDE_MASTER_STUDY_VERIFY_ROW_H

#include <string>
#include <vector>

#include <stride/time.h>

namespace stride::verify {

/// The values at one instant, as texts that read back as the same bits.
struct Row {
  Time time;
  /// Of a communication point the observed variables, in the order of TestedUnit::observed(); of a
  /// super-dense instant of Event Mode what ticked, "name=value".
  std::vector<std::string> values;
  bool is_event = false;

  bool operator==(const Row&) const = default;
};

}  // namespace stride::verify

#endif
