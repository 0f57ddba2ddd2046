// What was seen of a unit at one instant.
#ifndef STRIDE_MASTER_STUDY_VERIFY_ROW_H
#define STRIDE_MASTER_STUDY_VERIFY_ROW_H

#include <cstdint>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/time_text.h"

namespace stride::verify {

/// In seconds.
inline std::string instant_text(std::int64_t picoseconds) {
  return core::to_text(Duration(picoseconds));
}

/// The values at one instant, as texts that read back as the same bits.
struct Row {
  std::int64_t picoseconds = 0;
  /// Of a communication point the observed variables, in the order of TestedUnit::observed(); of a
  /// super-dense instant of Event Mode what ticked, "name=value".
  std::vector<std::string> values;
  bool is_event = false;

  bool operator==(const Row&) const = default;
};

}  // namespace stride::verify

#endif
