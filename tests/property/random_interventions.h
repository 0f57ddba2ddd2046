// Interventions drawn from a seed.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_INTERVENTIONS_H
#define STRIDE_TESTS_PROPERTY_RANDOM_INTERVENTIONS_H

#include <vector>

#include "master/engine/run/context/intervention.h"
#include "tests/property/assembly.h"

namespace stride::tests {

/// Each second real input that may be changed is changed twice, at instants on no grid up
/// to 50 ms, and each second clock receives its messages late, or not at all.
std::vector<core::Intervention> random_interventions(const Assembly& assembly, unsigned seed);

}  // namespace stride::tests

#endif
