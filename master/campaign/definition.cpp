#include "master/campaign/definition.h"

namespace stride::campaign {

const char* name(SamplingMethod method) {
  constexpr const char* kNames[] = {"independent", "latin-hypercube", "sobol"};
  return kNames[static_cast<std::size_t>(method)];
}

const char* name(Keep::Results results) {
  constexpr const char* kNames[] = {"none", "failed", "all"};
  return kNames[static_cast<std::size_t>(results)];
}

const char* name(Aggregate::Function function) {
  constexpr const char* kNames[] = {"min", "max", "mean", "final", "at", "integral"};
  return kNames[static_cast<std::size_t>(function)];
}

}  // namespace stride::campaign
