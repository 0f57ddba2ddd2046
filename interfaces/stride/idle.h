/* The layered standard org.stride.idle 1.0 on FMI 3.0 Co-Simulation: a unit's promise that it is
 * idle, so that the importer need not call it. An FMU that implements it exports the functions
 * below and has the manifest extra/org.stride.idle/fmi-ls-manifest.xml; to an importer that does
 * not know it, it is a plain FMU, and it behaves as one until strideEnableIdleSkipping is called.
 * docs/idle.md is the normative text.
 *
 * The promise: until the instant `until`, which is not part of it, as long as each input stays
 * within its deadband of the value that it has when the promise is made, and no input clock ticks,
 *
 *  - a step of any size that ends before or at `until` goes through: it is neither discarded nor
 *    returns early, there is no event before `until`, and no output clock ticks;
 *  - each Float64 output y with a tolerance is within it of y(t) + y'(t) * (elapsed time), where y'
 *    is its first derivative as fmi3GetOutputDerivatives gives it at t, or 0 if it has none; all
 *    other outputs stay exactly what they are.
 *
 * The importer need not call the instance meanwhile. The time since its last step is its lag. The
 * importer makes it catch up by one fmi3DoStep over the whole lag, with the inputs that it had:
 * before other inputs are set, before a clock ticks, and before the time passes `until` or the lag
 * passes maxSkip.
 *
 * Clean as C11 and as C++17.
 */
#ifndef STRIDE_IDLE_H
#define STRIDE_IDLE_H

#include <stride/fmi3.h>

#ifdef __cplusplus
extern "C" {
#endif

#define STRIDE_IDLE_NAME "org.stride.idle"
#define STRIDE_IDLE_VERSION "1.0.0"
/* The path of the manifest in the FMU. */
#define STRIDE_IDLE_MANIFEST "extra/org.stride.idle/fmi-ls-manifest.xml"

/* In the state Instantiated. Allows the instance to skip its own idle time, and not to be called
 * while it promises to be idle. maxSkip [s], positive, may be infinite: neither a skip nor a
 * promise is longer. Called again, the last call counts. fmi3Reset switches skipping off; it is
 * part of the FMU state, so fmi3SetFMUState makes it what it was. */
typedef fmi3Status strideEnableIdleSkippingTYPE(fmi3Instance instance, fmi3Float64 maxSkip);

/* In the state Instantiated. Tolerances of Float64 outputs in the place of those of the manifest,
 * in which they must be listed: positive and finite, in the outputs' own units, one per output (an
 * array has one for all its elements), so nTolerances = nOutputs. Where one is refused, none is
 * set. fmi3Reset makes them those of the manifest; they are part of the FMU state. */
typedef fmi3Status strideSetIdleTolerancesTYPE(fmi3Instance instance,
                                               const fmi3ValueReference outputs[], size_t nOutputs,
                                               const fmi3Float64 tolerances[], size_t nTolerances);

/* In Step Mode, at the instant t at which the last fmi3DoStep ended, or fmi3EnterStepMode left
 * Event Mode. *until > t [s] is a promise, which may be infinite; *until <= t is none. There is
 * none where skipping is not enabled, nor where the last fmi3DoStep asked for Event Mode and it was
 * not entered. Inputs that were set since count with the values that they have now. */
typedef fmi3Status strideGetIdlePromiseTYPE(fmi3Instance instance, fmi3Float64* until);

/* The entry table: X(name) for each function stride<name> of type stride<name>TYPE. */
#define STRIDE_IDLE_FUNCTIONS(X) \
  X(EnableIdleSkipping)          \
  X(SetIdleTolerances)           \
  X(GetIdlePromise)

#ifdef __cplusplus
}
#endif

#endif
