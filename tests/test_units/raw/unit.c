/* A Co-Simulation unit in C99 against the ABI alone. It has no Model Exchange and no Scheduled
 * Execution functions. The instance's name says how it misbehaves:
 *
 *   fatal    fmi3DoStep returns fmi3Fatal      discard  it returns fmi3Discard
 *   error    it returns fmi3Error, silently    warning  it returns fmi3Warning with a message
 *   lies     it stops halfway without saying so early   it returns early halfway
 *   drifts   its time is a little off          refuses  it cannot be instantiated
 *   arrives  it says early of a step that it made to its end
 *   thirds   its next event is at 1/3 s     needs    it wants Event Mode after each step
 *   ends     it requests the end after each step
 *   signals  it leaves a mode in which divisions by zero (SSE) raise signals
 *   crashes  it writes where nothing is
 *   pending  it returns 5, a status of FMI 2.0
 *   unheard  it returns 77, which is no status
 *   babbles  it logs 300 warnings              mumbles  it logs a message with the status 77
 *   mute     from the third step on each String is NULL
 *   latin    likewise Latin-1
 *   odd      likewise each number is 99
 *   astray   likewise at an address where nothing is
 *   huge     likewise each Binary has more bytes than there are addresses
 *   large    likewise 1 TiB
 *   insists  it rejects what is not the next step of raw_step picoseconds by its own count
 *
 * "error@40" does so from its 41st step on.
 *
 * With WITH_FAULTS it commits a fault of faults/faults.h, in any call, and has a state, without
 * content.
 */
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include <stride/fmi3.h>

typedef struct {
  bool is_used;
  char name[32];
  long long steps;
  long long calm_steps; /* it does nothing special in the first ones */
  char resources[512];
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log;
} Instance;

/* Not from the heap: an instance that has returned fmi3Fatal is never freed. */
static Instance instances[8];

/* Written by the tests through dlsym. */
long long raw_step = 0;

/* Read by the tests through dlsym. */
int raw_living = 0;
double raw_point = 0;
double raw_size = 0;
bool raw_no_restore = false;

#ifdef WITH_UNDEFINED_SYMBOL
extern void stride_test_nobody_has_this(void);
#endif
#ifdef WITH_MISSING_LIBRARY
extern int stride_test_absent(void);
#endif
#ifdef WITH_PYTHON
extern int Py_IsInitialized(void);
#endif
#ifdef WITH_FAULTS
#include "tests/test_units/faults/faults.h"
#define FAULT(call) stride_test_fault(call, raw_point + raw_size)
#else
#define FAULT(call) 0
#endif
/* A status of the fault's. */
#define RETURN_FAULT(call)       \
  const int fault = FAULT(call); \
  if (fault != 0) return (fmi3Status)fault;

static bool is(const Instance* instance, const char* name) {
  return strcmp(instance->name, name) == 0;
}

const char* fmi3GetVersion(void) { return FMI3_VERSION; }

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t n_required,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  (void)token, (void)visible, (void)logging, (void)event_mode, (void)early_return;
  (void)required, (void)n_required, (void)update, (void)FAULT("instantiate");
#ifdef WITH_UNDEFINED_SYMBOL
  stride_test_nobody_has_this();
#endif
#ifdef WITH_MISSING_LIBRARY
  stride_test_absent();
#endif
#ifdef WITH_PYTHON
  if (Py_IsInitialized() != 0) return NULL;
  const struct sigaction ignored = {.sa_handler = SIG_IGN}; /* as the interpreter has it */
  sigaction(SIGXFSZ, &ignored, NULL);
#endif
  Instance* instance = instances;
  while (instance->is_used) {
    if (++instance == instances + sizeof instances / sizeof *instances) return NULL;
  }
  memset(instance, 0, sizeof *instance);
  strncpy(instance->name, name, sizeof instance->name - 1);
  char* const at = strchr(instance->name, '@');
  if (at != NULL) {
    instance->calm_steps = atoll(at + 1);
    *at = '\0';
  }
  strncpy(instance->resources, resources != NULL ? resources : "NULL",
          sizeof instance->resources - 1);
  instance->environment = environment;
  instance->log = log;
  if (is(instance, "refuses")) {
    log(environment, fmi3Error, "logStatusError", "there is no licence");
    return NULL;
  }
  instance->is_used = true;
  ++raw_living;
  return instance;
}

void fmi3FreeInstance(fmi3Instance instance) {
  (void)FAULT("free");
  ((Instance*)instance)->is_used = false;
  --raw_living;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean d, fmi3Float64 t,
                                       fmi3Float64 start, fmi3Boolean s, fmi3Float64 stop) {
  (void)i, (void)d, (void)t, (void)start, (void)s, (void)stop;
  return fmi3OK;
}

#define TRANSITION(Name, call)                   \
  fmi3Status fmi3##Name(fmi3Instance instance) { \
    (void)instance;                              \
    RETURN_FAULT(call)                           \
    return fmi3OK;                               \
  }
TRANSITION(ExitInitializationMode, "initialize")
TRANSITION(EnterEventMode, "enter event mode")
TRANSITION(EnterStepMode, "enter step mode")
TRANSITION(Terminate, "terminate")
TRANSITION(Reset, "reset")

#ifdef WITH_FAULTS
fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  RETURN_FAULT("get state")
  *state = instance;
  return fmi3OK;
}
fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  (void)instance, (void)state;
  return fmi3OK;
}
fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  (void)instance;
  *state = NULL;
  return fmi3OK;
}
#endif

#ifndef WITHOUT_DO_STEP
/* Whether the step begins at the double nearest to steps * raw_step, and has that size. */
static bool is_next_step(const Instance* instance, double point, double size) {
  const double step = (double)raw_step / 1e12;
  const double expected = (double)(instance->steps * raw_step) / 1e12;
  return point == expected && fabs(size - step) <= 1e-9 * step;
}

fmi3Status fmi3DoStep(fmi3Instance handle, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean no_restore, fmi3Boolean* event, fmi3Boolean* terminate,
                      fmi3Boolean* early, fmi3Float64* reached) {
  Instance* instance = handle;
  raw_point = point;
  raw_size = size;
  raw_no_restore = no_restore;
  if (is(instance, "insists") && !is_next_step(instance, point, size)) return fmi3Discard;
  ++instance->steps;
  RETURN_FAULT("step")
  *event = *terminate = *early = false;
  *reached = point + size;
  if (instance->steps <= instance->calm_steps) return fmi3OK;
  *event = is(instance, "needs");
  *terminate = is(instance, "ends");
  *early = is(instance, "early") || is(instance, "arrives");
  if (is(instance, "lies") || is(instance, "early")) *reached = point + size / 2;
  if (is(instance, "strays")) {
    *reached = instance->steps > instance->calm_steps + 20 ? INFINITY : point + size / 2;
  }
  if (is(instance, "drifts")) *reached = point + size * (1 + 1e-9);
  if (is(instance, "warning")) {
    /* a pointer of its own, as some generators give it for the environment */
    instance->log(instance, fmi3Warning, "logStatusWarning", "it gets hot");
    return fmi3Warning;
  }
  for (int k = 0; is(instance, "babbles") && k < 300; ++k) {
    instance->log(instance->environment, fmi3Warning, "logStatusWarning", "it is warm");
  }
  if (is(instance, "mumbles")) {
    instance->log(instance->environment, (fmi3Status)77, "logStatusWarning", "something is up");
  }
  if (is(instance, "crashes")) *(volatile int*)NULL = 1;
#if defined(__x86_64__)
  if (is(instance, "signals")) _mm_setcsr(_mm_getcsr() & ~(unsigned)_MM_MASK_DIV_ZERO);
#endif
  if (is(instance, "fatal")) {
    instance->log(instance->environment, fmi3Fatal, "logStatusFatal", "the heap is gone");
    return fmi3Fatal;
  }
  if (is(instance, "discard")) return fmi3Discard;
  if (is(instance, "pending")) return (fmi3Status)5;
  if (is(instance, "unheard")) return (fmi3Status)77;
  return is(instance, "error") ? fmi3Error : fmi3OK;
}
#endif

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean* update, fmi3Boolean* terminate,
                                    fmi3Boolean* nominals, fmi3Boolean* values,
                                    fmi3Boolean* defined, fmi3Float64* next) {
  RETURN_FAULT("event")
  *update = *terminate = *nominals = *values = false;
  *defined = true;
  *next = is(i, "thirds") ? 1.0 / 3 : 1e300;
  return fmi3OK;
}

static bool is_now(const Instance* instance, const char* name) {
  return instance->steps >= 3 && is(instance, name);
}

#define ACCESS(T)                                                                                 \
  fmi3Status fmi3Get##T(fmi3Instance i, const fmi3ValueReference r[], size_t n, fmi3##T values[], \
                        size_t size) {                                                            \
    (void)r, (void)n;                                                                             \
    RETURN_FAULT("get")                                                                           \
    for (size_t k = 0; k < size; ++k) values[k] = is_now(i, "odd") ? 99 : 0;                      \
    return fmi3OK;                                                                                \
  }                                                                                               \
  fmi3Status fmi3Set##T(fmi3Instance i, const fmi3ValueReference r[], size_t n,                   \
                        const fmi3##T values[], size_t size) {                                    \
    (void)i, (void)r, (void)n, (void)values, (void)size;                                          \
    RETURN_FAULT("set")                                                                           \
    return fmi3OK;                                                                                \
  }
ACCESS(Float32)
ACCESS(Float64)
ACCESS(Int8)
ACCESS(UInt8)
ACCESS(Int16)
ACCESS(UInt16)
ACCESS(Int32)
ACCESS(UInt32)
ACCESS(Int64)
ACCESS(UInt64)
ACCESS(Boolean)

/* The one String is the path of the resources. */
fmi3Status fmi3GetString(fmi3Instance i, const fmi3ValueReference r[], size_t n,
                         fmi3String values[], size_t size) {
  (void)r, (void)n;
  for (size_t k = 0; k < size; ++k) {
    values[k] = ((Instance*)i)->resources;
    if (is_now(i, "mute")) values[k] = NULL;
    if (is_now(i, "latin")) values[k] = "caf\xe9";
    if (is_now(i, "astray")) values[k] = (fmi3String)8;
  }
  return fmi3OK;
}
fmi3Status fmi3SetString(fmi3Instance i, const fmi3ValueReference r[], size_t n,
                         const fmi3String values[], size_t size) {
  (void)i, (void)r, (void)n, (void)values, (void)size;
  return fmi3OK;
}
fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference r[], size_t n, size_t sizes[],
                         fmi3Binary values[], size_t size) {
  (void)r, (void)n;
  for (size_t k = 0; k < size; ++k) {
    sizes[k] = 3, values[k] = NULL;
    if (is(i, "huge") || is(i, "large")) sizes[k] = 0, values[k] = (fmi3Binary) "";
    if (is_now(i, "huge")) sizes[k] = SIZE_MAX;
    if (is_now(i, "large")) sizes[k] = (size_t)1 << 40;
  }
  return fmi3OK;
}
fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference r[], size_t n,
                         const size_t sizes[], const fmi3Binary values[], size_t size) {
  (void)i, (void)r, (void)n, (void)sizes, (void)values, (void)size;
  return fmi3OK;
}
fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference r[], size_t n,
                        fmi3Clock values[]) {
  (void)i, (void)r;
  for (size_t k = 0; k < n; ++k) values[k] = false;
  return fmi3OK;
}
fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference r[], size_t n,
                        const fmi3Clock values[]) {
  (void)i, (void)r, (void)n, (void)values;
  return fmi3OK;
}
