#include "tests/interfaces/fmi2_header_test.h"

#include <stdalign.h>

#define SIZE(T)                                          \
  size_t c_size_of_##T(void) { return sizeof(fmi2##T); } \
  size_t c_align_of_##T(void) { return alignof(fmi2##T); }
PLATFORM_TYPES(SIZE)
#undef SIZE

const int c_enumerators[] = {
    fmi2OK,
    fmi2Warning,
    fmi2Discard,
    fmi2Error,
    fmi2Fatal,
    fmi2Pending,
    fmi2ModelExchange,
    fmi2CoSimulation,
    fmi2DoStepStatus,
    fmi2PendingStatus,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
};

void c_call_back(const fmi2CallbackFunctions* functions) {
  int* numbers = functions->allocateMemory(2, sizeof(int));
  numbers[0] += 3; /* they are zero before */
  numbers[1] += 4;
  functions->logger(functions->componentEnvironment, "name", fmi2Discard, "category",
                    "%d and %d and %s and %g", numbers[0], numbers[1], "text", 0.5);
  functions->freeMemory(numbers);
  functions->stepFinished(functions->componentEnvironment, fmi2Warning);
}

fmi2Status c_do_step(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean no_restore) {
  *(double*)c = no_restore == fmi2True ? point + size : -1;
  return fmi2Pending;
}

fmi2Status c_set_input_derivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                   const fmi2Integer order[], const fmi2Real value[]) {
  for (size_t i = 0; i < nvr; ++i) *(double*)c += vr[i] * order[i] * value[i];
  return fmi2OK;
}

fmi2Status c_get_boolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2Boolean value[]) {
  for (size_t i = 0; i < nvr; ++i) value[i] = vr[i] % 2 == 1 ? fmi2True : fmi2False;
  return c == NULL ? fmi2Fatal : fmi2OK;
}

fmi2Status c_get_real_status(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  *value = *(double*)c;
  return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}

fmi2Status c_new_discrete_states(fmi2Component c, fmi2EventInfo* info) {
  info->newDiscreteStatesNeeded = fmi2False;
  info->terminateSimulation = fmi2True;
  info->nominalsOfContinuousStatesChanged = fmi2False;
  info->valuesOfContinuousStatesChanged = fmi2True;
  info->nextEventTimeDefined = fmi2True;
  info->nextEventTime = *(double*)c;
  return fmi2OK;
}

size_t c_function_count(void) {
#define ONE(name) +1
  return 0 FMI2_FUNCTIONS(ONE);
#undef ONE
}
