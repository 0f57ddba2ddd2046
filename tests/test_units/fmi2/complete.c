/* x' = k (u - x) as fmi2_relaxation, with each function of FMI 2.0, as other tools demand. Those
 * for what the unit does not offer refuse it. */
#include "tests/test_units/fmi2/relaxation.c"

EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                               size_t n, const fmi2ValueReference knowns[],
                                               size_t m, const fmi2Real seed[],
                                               fmi2Real sensitivity[]) {
  (void)unknowns, (void)n, (void)knowns, (void)m, (void)seed, (void)sensitivity;
  return refuse(c, "fmi2GetDirectionalDerivative");
}

EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference outputs[],
                                               size_t n, const fmi2Integer orders[],
                                               fmi2Real values[]) {
  (void)outputs, (void)n, (void)orders, (void)values;
  return refuse(c, "fmi2GetRealOutputDerivatives");
}

EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  (void)state, (void)size;
  return refuse(c, "fmi2SerializedFMUstateSize");
}

EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                        size_t size) {
  (void)state, (void)bytes, (void)size;
  return refuse(c, "fmi2SerializeFMUstate");
}

EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                          fmi2FMUstate* state) {
  (void)bytes, (void)size, (void)state;
  return refuse(c, "fmi2DeSerializeFMUstate");
}
