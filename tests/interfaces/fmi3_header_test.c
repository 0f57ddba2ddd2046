#include "tests/interfaces/fmi3_header_test.h"

#include <stdalign.h>

#define SIZE(T)                                          \
  size_t c_size_of_##T(void) { return sizeof(fmi3##T); } \
  size_t c_align_of_##T(void) { return alignof(fmi3##T); }
PLATFORM_TYPES(SIZE)
#undef SIZE

const int c_enumerators[] = {
    fmi3OK,
    fmi3Warning,
    fmi3Discard,
    fmi3Error,
    fmi3Fatal,
    fmi3Independent,
    fmi3Constant,
    fmi3Fixed,
    fmi3Tunable,
    fmi3Discrete,
    fmi3Dependent,
    fmi3IntervalNotYetKnown,
    fmi3IntervalUnchanged,
    fmi3IntervalChanged,
};

void c_log(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment) {
  log(environment, fmi3Discard, "category", "message");
}

void c_intermediate_update(fmi3IntermediateUpdateCallback update,
                           fmi3InstanceEnvironment environment) {
  fmi3Boolean requested = fmi3False;
  fmi3Float64 time = 0;
  update(environment, 1.5, fmi3True, fmi3False, fmi3True, fmi3False, &requested, &time);
}

fmi3Status c_do_step(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size,
                     fmi3Boolean no_restore, fmi3Boolean* event, fmi3Boolean* terminate,
                     fmi3Boolean* early, fmi3Float64* reached) {
  *event = no_restore;
  *terminate = !no_restore;
  *early = instance != NULL;
  *reached = point + size;
  return fmi3Discard;
}

fmi3Status c_get_binary(fmi3Instance instance, const fmi3ValueReference references[], size_t n,
                        size_t sizes[], fmi3Binary values[], size_t n_values) {
  static const fmi3Byte bytes[] = {1, 2, 3};
  for (size_t i = 0; i < n && i < n_values; ++i) {
    sizes[i] = references[i];
    values[i] = bytes;
  }
  return instance == NULL ? fmi3Fatal : fmi3OK;
}

fmi3Status c_set_clock(fmi3Instance instance, const fmi3ValueReference references[], size_t n,
                       const fmi3Clock values[]) {
  size_t active = 0;
  for (size_t i = 0; i < n; ++i) active += values[i] == fmi3ClockActive ? references[i] : 0;
  *(size_t*)instance = active;
  return fmi3Warning;
}

fmi3Status c_set_idle_tolerances(fmi3Instance instance, const fmi3ValueReference outputs[],
                                 size_t n_outputs, const fmi3Float64 tolerances[],
                                 size_t n_tolerances) {
  for (size_t i = 0; i < n_outputs && i < n_tolerances; ++i) {
    *(double*)instance += outputs[i] * tolerances[i];
  }
  return fmi3Warning;
}

fmi3Status c_get_idle_promise(fmi3Instance instance, fmi3Float64* until) {
  *until = *(double*)instance;
  return fmi3OK;
}

size_t c_function_count(void) {
#define ONE(name) +1
  return 0 FMI3_FUNCTIONS(ONE);
#undef ONE
}
