#include "master/study/campaign/definition/definition.h"

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

std::uint64_t size_of(const Factor& factor) {
  if (const auto* const table = std::get_if<ValueTable>(&factor)) return table->rows.size();
  return std::get<ValueRange>(factor).count;
}

}  // namespace stride::campaign
