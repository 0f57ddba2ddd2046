#include "master/algorithm/statistics.h"

namespace stride::core {

const char* name(RunEnd end) {
  switch (end) {
    case RunEnd::Completed:
      return "completed";
    case RunEnd::EndedByUnit:
      return "ended by a unit";
    case RunEnd::Interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace stride::core
