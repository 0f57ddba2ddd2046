// Systems drawn from a seed, of units that behave the same however the run is cut into steps.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_SYSTEM_H
#define STRIDE_TESTS_PROPERTY_RANDOM_SYSTEM_H

#include "tests/property/assembly.h"

namespace stride::tests {

enum class Wiring {
  Continuous,  ///< any real output to any real input, in loops, too
  EventsOnly,  ///< inputs change at events only, so no result depends on the steps between them
};

/// 2 to 12 units, for runs of about 0.1 s in steps of about 1 ms. At most one of them cannot save
/// its state.
Assembly random_system(unsigned seed, Wiring wiring);

/// Such a system, and beside it the units `source` and `r1` and `r2`, which it feeds. These two
/// reject steps that are longer than a random limit between the two [s].
Assembly with_rejecters(unsigned seed, Wiring wiring, const std::string& shortest,
                        const std::string& longest);

}  // namespace stride::tests

#endif
