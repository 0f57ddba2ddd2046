#ifndef STRIDE_INTERFACES_UNIT_MISUSE_H
#define STRIDE_INTERFACES_UNIT_MISUSE_H

#include <stdexcept>

namespace stride::kit {

/// The importer used the instance wrongly; nothing has changed.
struct Misuse : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace stride::kit

#endif
