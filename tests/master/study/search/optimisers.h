// The library with the optimisers, as the program loads it.
#ifndef STRIDE_TESTS_MASTER_STUDY_SEARCH_OPTIMISERS_H
#define STRIDE_TESTS_MASTER_STUDY_SEARCH_OPTIMISERS_H

#include "master/study/search/optimiser.h"

namespace stride::tests {

inline search::MakeOptimiser* make_optimiser() {
  static search::MakeOptimiser& make = search::load_optimisers(STRIDE_OPTIMISERS);
  return &make;
}

}  // namespace stride::tests

#endif
