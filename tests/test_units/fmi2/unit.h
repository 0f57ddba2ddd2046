/* A Co-Simulation unit of FMI 2.0 in C99 against the ABI alone, as another tool's is. Who includes
 * it once defines the model: unit_start, unit_outputs and unit_step.
 *
 * Values are in one array for each base type, at their value references, so that a Real and an
 * Integer may have the same one. A unit is strict where the standard is: a call that the state
 * machine of 4.2.4 does not allow returns fmi2Error with a message, and so do inputs that are set
 * before Initialization Mode and values that are read between setting and stepping.
 *
 * Compile definitions: WITHOUT_STATE leaves the functions of the unit's state out.
 */
#ifndef STRIDE_TESTS_TEST_UNITS_FMI2_UNIT_H
#define STRIDE_TESTS_TEST_UNITS_FMI2_UNIT_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <stride/fmi2.h>

/* For units with threads, and at the end of an instance. */
#ifndef LOCK
#define LOCK() ((void)0)
#define UNLOCK() ((void)0)
#define END() ((void)0)
#endif

/* For units that fail: a status of their own that a call returns, or 0. */
#ifndef FAULT
#define FAULT(call) 0
#endif
#define RETURN_FAULT(call)       \
  const int fault = FAULT(call); \
  if (fault != 0) return (fmi2Status)fault;

#define EXPORT __attribute__((visibility("default")))
#define FIRST_INPUT 0
#define FIRST_OTHER 10 /* value references below are those of inputs */

enum { kValues = 32, kTextSize = 64, kOrders = 3, kInstances = 8 };

typedef enum {
  kInstantiated,
  kInitialization,
  kStepComplete,
  kStepInProgress,
  kStepFailed,
  kTerminated
} Mode;

/* What the state of a unit is made of. */
typedef struct {
  double time;
  double real[kValues];
  double slope[kValues][kOrders]; /* of inputs: the derivatives of this order */
  fmi2Integer integer[kValues];
  fmi2Boolean boolean[kValues];
  char string[kValues][kTextSize];
  double x; /* for the model */
} Model;

typedef struct {
  bool is_used;
  char name[kTextSize];
  char resources[512];
  fmi2CallbackFunctions call;
  bool is_logging;
  Mode mode;
  bool is_set; /* since the last step */
  Model model;
  /* What fmi2GetStatus and its kin say of the last step. */
  bool knows_time;
  double last_successful;
  bool is_ending;
  fmi2Status finished;
} Unit;

static void unit_start(Unit* unit);
static void unit_outputs(Unit* unit);
/* From `begin` over `size` seconds. Whatever it returns, the model is where it came to. */
static fmi2Status unit_step(Unit* unit, double begin, double size) __attribute__((unused));
/* Asked in the course of a step that is pending: its status by now. */
static fmi2Status unit_poll(Unit* unit);

/* Not from the heap: an instance that has returned fmi2Fatal is never freed. */
static Unit units[kInstances];

/* Read by the tests through dlsym. */
EXPORT int fmi2_living_units = 0;
EXPORT int fmi2_living_states = 0;
EXPORT int fmi2_saved_states = 0;
EXPORT double fmi2_step_begin = 0;
EXPORT double fmi2_step_size = 0;
EXPORT fmi2Boolean fmi2_no_restore = fmi2False;
EXPORT double fmi2_tolerance = 0;
EXPORT double fmi2_stop_time = 0;
EXPORT fmi2CallbackFunctions fmi2_callbacks; /* of the last instance */

#define LOG(unit, status, ...)                                                              \
  (unit)->call.logger((unit)->call.componentEnvironment, (unit)->name, status, "logStatus", \
                      __VA_ARGS__)

static fmi2Status refuse(Unit* unit, const char* function) {
  LOG(unit, fmi2Error, "%s is not allowed in mode %d", function, (int)unit->mode);
  return fmi2Error;
}

#define ALLOW(function, condition) \
  Unit* const unit = c;            \
  if (!(condition)) return refuse(unit, function);

EXPORT const char* fmi2GetTypesPlatform(void) {
#ifdef OTHER_PLATFORM
  return "other";
#else
  return FMI2_TYPES_PLATFORM;
#endif
}
EXPORT const char* fmi2GetVersion(void) { return FMI2_VERSION; }
EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n,
                                      const fmi2String categories[]) {
  (void)n, (void)categories;
  ((Unit*)c)->is_logging = on;
  return fmi2OK;
}

EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                     fmi2String resources, const fmi2CallbackFunctions* call,
                                     fmi2Boolean visible, fmi2Boolean logging) {
  (void)FAULT("instantiate");
  Unit* unit = units;
  while (unit->is_used) {
    if (++unit == units + kInstances) return NULL;
  }
  memset(unit, 0, sizeof *unit);
  strncpy(unit->name, name, sizeof unit->name - 1);
  strncpy(unit->resources, resources, sizeof unit->resources - 1);
  unit->call = *call;
  fmi2_callbacks = *call;
  unit->is_logging = logging;
  if (strcmp(guid, "{" UNIT_NAME "}") != 0 || type != fmi2CoSimulation || visible) {
    LOG(unit, fmi2Error, "the GUID is %s, the type %d, visible %d", guid, (int)type, visible);
    return NULL;
  }
  unit->is_used = true;
  ++fmi2_living_units;
  unit_start(unit);
  return unit;
}

EXPORT void fmi2FreeInstance(fmi2Component c) {
  (void)FAULT("free");
  END();
  ((Unit*)c)->is_used = false;
  --fmi2_living_units;
}

EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined,
                                      fmi2Real tolerance, fmi2Real start, fmi2Boolean stop_defined,
                                      fmi2Real stop) {
  ALLOW("fmi2SetupExperiment", unit->mode == kInstantiated)
  memset(&unit->model, 0, sizeof unit->model);
  unit_start(unit); /* as the units of some tools do: what was set before is lost */
  unit->model.time = start;
  fmi2_tolerance = tolerance_defined ? tolerance : 0;
  fmi2_stop_time = stop_defined ? stop : 1e300;
  return fmi2OK;
}
EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  ALLOW("fmi2EnterInitializationMode", unit->mode == kInstantiated)
  unit->mode = kInitialization;
  return fmi2OK;
}
EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  ALLOW("fmi2ExitInitializationMode", unit->mode == kInitialization)
  RETURN_FAULT("initialize")
  unit_outputs(unit);
  unit->mode = kStepComplete;
  return fmi2OK;
}
EXPORT fmi2Status fmi2Terminate(fmi2Component c) {
  ALLOW("fmi2Terminate", unit->mode == kStepComplete || unit->mode == kStepFailed)
  RETURN_FAULT("terminate")
  unit->mode = kTerminated;
  return fmi2OK;
}
EXPORT fmi2Status fmi2Reset(fmi2Component c) {
  ALLOW("fmi2Reset", true)
  unit->mode = kInstantiated;
  memset(&unit->model, 0, sizeof unit->model);
  unit_start(unit);
  return fmi2OK;
}

/* ---- Values ---- */

static bool may_set(const Unit* unit, const fmi2ValueReference vr[], size_t n) {
  for (size_t i = 0; i < n; ++i) {
    const bool is_input = vr[i] < FIRST_OTHER;
    if (vr[i] >= kValues) return false;
    if (unit->mode == kInstantiated ? is_input : unit->mode > kStepComplete) return false;
    if (unit->mode == kStepComplete && !is_input) return false;
  }
  return true;
}

static bool may_get(Unit* unit) {
  if (unit->mode == kInitialization) unit_outputs(unit);
  return unit->mode == kInitialization || (unit->mode == kStepComplete && !unit->is_set) ||
         unit->mode == kStepFailed || unit->mode == kTerminated;
}

#define ACCESS(T, field, store)                                                            \
  EXPORT fmi2Status fmi2Get##T(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                               fmi2##T value[]) {                                          \
    ALLOW("fmi2Get" #T, may_get(unit))                                                     \
    RETURN_FAULT("get")                                                                    \
    for (size_t i = 0; i < nvr; ++i) value[i] = unit->model.field[vr[i]];                  \
    return fmi2OK;                                                                         \
  }                                                                                        \
  EXPORT fmi2Status fmi2Set##T(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                               const fmi2##T value[]) {                                    \
    ALLOW("fmi2Set" #T, may_set(unit, vr, nvr))                                            \
    RETURN_FAULT("set")                                                                    \
    unit->is_set = unit->mode == kStepComplete;                                            \
    for (size_t i = 0; i < nvr; ++i) {                                                     \
      store(unit->model.field[vr[i]], value[i]);                                           \
    }                                                                                      \
    return fmi2OK;                                                                         \
  }
#define STORE(to, from) to = from
#define STORE_TEXT(to, from) strncpy(to, from, kTextSize - 1)
ACCESS(Real, real, STORE)
ACCESS(Integer, integer, STORE)
ACCESS(Boolean, boolean, STORE)
#ifndef WITHOUT_STRINGS
ACCESS(String, string, STORE_TEXT)
#endif

EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                              size_t nvr, const fmi2Integer order[],
                                              const fmi2Real value[]) {
  ALLOW("fmi2SetRealInputDerivatives", may_set(unit, vr, nvr))
  for (size_t i = 0; i < nvr; ++i) {
    if (order[i] < 1 || order[i] >= kOrders) return refuse(unit, "a derivative of this order");
    unit->model.slope[vr[i]][order[i]] = value[i];
  }
  return fmi2OK;
}

/* ---- State ---- */

#ifndef WITHOUT_STATE
EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  ALLOW("fmi2GetFMUstate", unit->mode != kStepInProgress)
  RETURN_FAULT("get state")
  if (*state == NULL) {
    *state = unit->call.allocateMemory(1, sizeof(Unit));
    ++fmi2_living_states;
  }
  ++fmi2_saved_states;
  memcpy(*state, unit, sizeof(Unit));
  return fmi2OK;
}
EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  memcpy(c, state, sizeof(Unit));
  return fmi2OK;
}
EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  if (*state == NULL) return fmi2OK;
  ((Unit*)c)->call.freeMemory(*state);
  *state = NULL;
  --fmi2_living_states;
  return fmi2OK;
}
#endif

/* ---- Steps ---- */

static fmi2Status end_step(Unit* unit, fmi2Status status) {
  unit->finished = status;
  unit->mode = status == fmi2Pending                       ? kStepInProgress
               : status == fmi2OK || status == fmi2Warning ? kStepComplete
                                                           : kStepFailed;
  unit->is_set = false;
  unit_outputs(unit);
  return status;
}

#ifndef WITHOUT_DO_STEP
EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size,
                             fmi2Boolean no_restore) {
#ifdef WITHOUT_STATE /* which goes on after a step that it discarded, as more than one unit does \
                      */
  const bool may_step = ((Unit*)c)->mode == kStepComplete || ((Unit*)c)->mode == kStepFailed;
#else
  const bool may_step = ((Unit*)c)->mode == kStepComplete;
#endif
  ALLOW("fmi2DoStep", may_step && size > 0)
  fmi2_step_begin = point;
  fmi2_step_size = size;
  fmi2_no_restore = no_restore;
  RETURN_FAULT("step")
  LOCK();
  unit->finished = fmi2Pending;
  const fmi2Status status = unit_step(unit, point, size);
  end_step(unit, unit->finished != fmi2Pending ? unit->finished : status);
  UNLOCK();
  return status;
}
#endif
#ifdef WITH_PREFIX
EXPORT void WITH_PREFIX(void) {}
#endif
EXPORT fmi2Status fmi2CancelStep(fmi2Component c) { return refuse(c, "fmi2CancelStep"); }

EXPORT fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status* value) {
  ALLOW("fmi2GetStatus", kind == fmi2DoStepStatus)
#ifdef WITHOUT_STATUS
  return fmi2Discard;
#endif
  LOCK();
  if (unit->mode == kStepInProgress) end_step(unit, unit_poll(unit));
  *value = unit->finished;
  UNLOCK();
  return *value == fmi2Pending ? fmi2Pending : fmi2OK;
}
EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  ALLOW("fmi2GetRealStatus", unit->mode == kStepFailed)
  if (kind != fmi2LastSuccessfulTime || !unit->knows_time) {
    LOG(unit, fmi2Discard, "that is not known");
    return fmi2Discard;
  }
  *value = unit->last_successful;
  return fmi2OK;
}
EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind,
                                       fmi2Integer* value) {
  (void)c, (void)kind, (void)value;
  return fmi2Discard;
}
EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind,
                                       fmi2Boolean* value) {
  ALLOW("fmi2GetBooleanStatus", unit->mode == kStepFailed)
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = unit->is_ending;
  return fmi2OK;
}
EXPORT fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind,
                                      fmi2String* value) {
  (void)c;
  if (kind != fmi2PendingStatus) return fmi2Discard;
  *value = "asleep";
  return fmi2OK;
}

#endif
