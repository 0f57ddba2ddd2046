/* y' = (u - y) / 1 s in Euler steps, in C99 against the ABI alone, with nothing beside it: what a
 * unit costs that costs next to nothing. With WITH_STATE its state can be saved. */
#include <stdlib.h>

#include <stride/fmi3.h>

enum { U = 1, Y = 2 };

typedef struct {
  double u, y;
} Relay;

const char* fmi3GetVersion(void) { return FMI3_VERSION; }

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t n_required,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)event_mode;
  (void)early_return, (void)required, (void)n_required, (void)environment, (void)log, (void)update;
  return calloc(1, sizeof(Relay));
}

void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean d, fmi3Float64 t,
                                       fmi3Float64 start, fmi3Boolean s, fmi3Float64 stop) {
  (void)i, (void)d, (void)t, (void)start, (void)s, (void)stop;
  return fmi3OK;
}

#define TRANSITION(Name)                         \
  fmi3Status fmi3##Name(fmi3Instance instance) { \
    (void)instance;                              \
    return fmi3OK;                               \
  }
TRANSITION(ExitInitializationMode)
TRANSITION(Terminate)

fmi3Status fmi3Reset(fmi3Instance instance) {
  *(Relay*)instance = (Relay){0, 0};
  return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean no_restore, fmi3Boolean* event, fmi3Boolean* terminate,
                      fmi3Boolean* early, fmi3Float64* reached) {
  (void)no_restore;
  Relay* relay = instance;
  relay->y += size * (relay->u - relay->y);
  *event = *terminate = *early = false;
  *reached = point + size;
  return fmi3OK;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          size_t count, const fmi3Float64 values[], size_t size) {
  (void)size;
  Relay* relay = instance;
  for (size_t i = 0; i < count; ++i) *(references[i] == U ? &relay->u : &relay->y) = values[i];
  return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          size_t count, fmi3Float64 values[], size_t size) {
  (void)size;
  const Relay* relay = instance;
  for (size_t i = 0; i < count; ++i) values[i] = references[i] == U ? relay->u : relay->y;
  return fmi3OK;
}

#ifdef WITH_STATE
fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  if (*state == NULL) *state = malloc(sizeof(Relay));
  if (*state == NULL) return fmi3Error;
  *(Relay*)*state = *(Relay*)instance;
  return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  *(Relay*)instance = *(Relay*)state;
  return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  (void)instance;
  free(*state);
  *state = NULL;
  return fmi3OK;
}
#endif
