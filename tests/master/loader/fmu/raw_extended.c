/* The raw unit of tests/test_units with a state, and with more to go wrong, chosen by the
 * instance's name:
 *
 *   sets       fmi3SetFloat64 returns fmi3Discard with a reason
 *   coarse     fmi3DoStep returns fmi3Discard with a reason
 *   endless    fmi3DoStep says that it has come as far as infinity
 *   forgetful  fmi3SetFMUState returns fmi3Discard
 *   backwards  fmi3GetIntervalDecimal gives a negative interval
 *   vague      it gives NaN
 *   wise       it does not know the interval yet
 *   dreams     strideGetIdlePromise gives NaN
 *   sleeps     it promises beyond all times
 *   shy        it returns fmi3Error with a reason
 *   babbles    strideDescribeMessage says that it has written more than fits
 *   mute       it returns fmi3Discard with a reason
 *   refuses_it it returns fmi3Error with a reason
 *
 * Otherwise its clocks have the interval 0.25 s and the shift 0.125 s. It has no functions for
 * fractions.
 */
#include <math.h>
#include <stdio.h>

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>

#define fmi3DoStep raw_do_step
#define fmi3SetFloat64 raw_set_float64
#include "tests/test_units/raw/unit.c"
#undef fmi3DoStep
#undef fmi3SetFloat64

/* Read by the tests through dlsym. */
int raw_states_made = 0;
int raw_states_living = 0;

/* States are places in here, so that one which must not be freed any more, after fmi3Fatal, is no
 * leak. */
static char states[64];

static fmi3Status discard(Instance* instance, const char* reason) {
  instance->log(instance->environment, fmi3Discard, "logStatusDiscard", reason);
  return fmi3Discard;
}

fmi3Status fmi3DoStep(fmi3Instance handle, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean no_restore, fmi3Boolean* event, fmi3Boolean* terminate,
                      fmi3Boolean* early, fmi3Float64* reached) {
  const fmi3Status status =
      raw_do_step(handle, point, size, no_restore, event, terminate, early, reached);
  if (is(handle, "coarse") && size > 0.5) return discard(handle, "the mesh is too coarse");
  if (is(handle, "endless")) *reached = 1e300 * 1e300;
  return status;
}

fmi3Status fmi3SetFloat64(fmi3Instance handle, const fmi3ValueReference references[], size_t n,
                          const fmi3Float64 values[], size_t size) {
  if (is(handle, "sets")) return discard(handle, "the value is out of range");
  return raw_set_float64(handle, references, n, values, size);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  (void)instance;
  if (*state != NULL) return fmi3OK;
  *state = &states[raw_states_made++ % (int)sizeof states];
  ++raw_states_living;
  return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance handle, fmi3FMUState state) {
  (void)state;
  return is(handle, "forgetful") ? fmi3Discard : fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  (void)instance;
  if (*state == NULL) return fmi3OK;
  *state = NULL;
  --raw_states_living;
  return fmi3OK;
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance handle, const fmi3ValueReference references[],
                                  size_t n, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  (void)references;
  for (size_t i = 0; i < n; ++i) {
    intervals[i] = is(handle, "backwards") ? -0.25 : is(handle, "vague") ? NAN : 0.25;
    qualifiers[i] = is(handle, "wise") ? fmi3IntervalNotYetKnown : fmi3IntervalChanged;
  }
  return fmi3OK;
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance handle, const fmi3ValueReference references[], size_t n,
                               fmi3Float64 shifts[]) {
  (void)handle, (void)references;
  for (size_t i = 0; i < n; ++i) shifts[i] = 0.125;
  return fmi3OK;
}

fmi3Status strideEnableIdleSkipping(fmi3Instance instance, fmi3Float64 max_skip) {
  (void)instance;
  return max_skip > 0 ? fmi3OK : fmi3Error;
}

fmi3Status strideSetIdleTolerances(fmi3Instance instance, const fmi3ValueReference outputs[],
                                   size_t n_outputs, const fmi3Float64 tolerances[],
                                   size_t n_tolerances) {
  (void)instance, (void)outputs, (void)n_outputs, (void)tolerances, (void)n_tolerances;
  return fmi3OK;
}

fmi3Status strideGetIdlePromise(fmi3Instance handle, fmi3Float64* until) {
  Instance* const instance = handle;
  *until = is(handle, "dreams") ? NAN : is(handle, "sleeps") ? 1e9 : 0.5;
  if (!is(handle, "shy")) return fmi3OK;
  instance->log(instance->environment, fmi3Error, "logStatusError", "I do not know");
  return fmi3Error;
}

fmi3Status strideDescribeMessage(fmi3Instance handle, fmi3ValueReference variable,
                                 const fmi3Byte value[], size_t size, char text[], size_t capacity,
                                 size_t* text_size) {
  Instance* const instance = handle;
  if (is(handle, "mute")) return discard(instance, "words fail me");
  if (is(handle, "refuses_it")) {
    instance->log(instance->environment, fmi3Error, "logStatusError", "no comment");
    return fmi3Error;
  }
  const int length = snprintf(text, capacity, "%u: %zu bytes, %s", variable, size,
                              value != NULL ? "somewhere" : "nowhere");
  *text_size = is(handle, "babbles") ? capacity + 1 : (size_t)length;
  return fmi3OK;
}
