// The exported functions of <stride/idle.h>.
#include <limits>

#include "interfaces/unit/entry_call.h"

using stride::kit::call;
using stride::kit::Function;
using stride::kit::Instance;

fmi3Status strideEnableIdleSkipping(fmi3Instance instance, fmi3Float64 max_skip) {
  return call(instance, Function::EnableIdleSkipping, [&](Instance& unit) {
    unit.enable_idle_skipping(max_skip);
    return fmi3OK;
  });
}

fmi3Status strideSetIdleTolerances(fmi3Instance instance, const fmi3ValueReference outputs[],
                                   size_t output_count, const fmi3Float64 tolerances[],
                                   size_t tolerance_count) {
  return call(instance, Function::SetIdleTolerances, [&](Instance& unit) {
    unit.set_idle_tolerances(outputs, output_count, tolerances, tolerance_count);
    return fmi3OK;
  });
}

fmi3Status strideGetIdlePromise(fmi3Instance instance, fmi3Float64* until) {
  return call(instance, Function::GetIdlePromise, [&](Instance& unit) {
    const stride::Time promise = unit.idle_until();
    *until = promise == stride::Time::max() ? std::numeric_limits<double>::infinity()
                                            : stride::to_seconds(promise);
    return fmi3OK;
  });
}
