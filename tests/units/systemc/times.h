// Times of tests with SystemC.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_TIMES_H
#define STRIDE_TESTS_UNITS_SYSTEMC_TIMES_H

#include <stride/time.h>

namespace stride::tests {

constexpr Duration kNanosecond{1000};
constexpr Duration kMicrosecond{1'000'000};
constexpr Duration kMillisecond{1'000'000'000};

inline Time at(Duration duration) { return Time(duration); }

}  // namespace stride::tests

#endif
