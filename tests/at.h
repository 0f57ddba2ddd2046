// Times as tests write them.
#ifndef STRIDE_TESTS_AT_H
#define STRIDE_TESTS_AT_H

#include <stride/time.h>

namespace stride::tests {

inline Time at(double seconds) { return time_from_seconds(seconds); }

}  // namespace stride::tests

#endif
