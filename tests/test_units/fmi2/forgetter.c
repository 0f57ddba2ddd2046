/* x' = k (u - x) as fmi2_relaxation, with functions for its state that are broken as the
 * environment variable STRIDE_TEST_SLIP has it:
 *
 *   1  fmi2GetFMUstate returns fmi2Error       5  what is restored has the error of a solver
 *   2  fmi2SetFMUstate does                    6  fmi2DeSerializeFMUstate needs an initialized
 *   3  the time is not restored, and the          instance, else it returns fmi2Error and leaves a
 *      next step is refused for that              pointer that must not be freed
 *   4  its state is a null pointer, and        7  fmi2GetFMUstate crashes
 *      restored well
 *
 * Other slips: 8 it steps no further than 1 s; 9 it rounds `k`, which it reads back; 10 the
 * last bit of a step depends on whether a value was read before it.
 */
#define WITHOUT_STATE
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <string.h>

static bool was_read; /* since the last step */

static int note_call(const char* call) {
  was_read = was_read || strcmp(call, "get") == 0;
  return 0;
}
#define FAULT(call) note_call(call)

#include "tests/test_units/fmi2/unit.h"

enum { kU = FIRST_INPUT, kX = FIRST_OTHER, kK };
enum Slip {
  kGet = 1,
  kSet,
  kTime,
  kNull,
  kInaccurate,
  kOnlyInitialized,
  kCrash,
  kEnd,
  kRounds,
  kDependsOnReading
};

static Model kept; /* of the unit without a state */

static bool has_slip(enum Slip slip) {
  const char* const chosen = getenv("STRIDE_TEST_SLIP");
  return chosen != NULL && atoi(chosen) == (int)slip;
}

static void unit_start(Unit* unit) {
  unit->model.x = unit->model.real[kX] = 1;
  unit->model.real[kK] = 2;
}

static void unit_outputs(Unit* unit) {
  if (unit->mode <= kInitialization) unit->model.x = unit->model.real[kX];
  unit->model.real[kX] = unit->model.x;
  if (has_slip(kRounds) && unit->model.real[kK] == 2) unit->model.real[kK] = nextafter(2, 3);
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  Model* const m = &unit->model;
  if (has_slip(kTime) && fabs(begin - m->time) > 1e-9) {
    LOG(unit, fmi2Error, "its time is %g s", m->time);
    return fmi2Error;
  }
  if (has_slip(kEnd) && begin + size > 1) {
    LOG(unit, fmi2Error, "it was made for 1 s");
    return fmi2Error;
  }
  m->x = m->real[kU] + (m->x - m->real[kU]) * exp(-m->real[kK] * size);
  if (has_slip(kDependsOnReading) && was_read) m->x = nextafter(m->x, 2);
  was_read = false;
  m->time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }

EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  Unit* const unit = c;
  if (has_slip(kGet)) return refuse(unit, "fmi2GetFMUstate");
  if (has_slip(kCrash)) raise(SIGSEGV);
  if (has_slip(kNull)) {
    kept = unit->model;
    return fmi2OK;
  }
  if (*state == NULL) *state = unit->call.allocateMemory(1, sizeof(Unit));
  memcpy(*state, unit, sizeof(Unit));
  return fmi2OK;
}

EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  Unit* const unit = c;
  const double time = unit->model.time;
  if (has_slip(kSet)) return refuse(unit, "fmi2SetFMUstate");
  if (has_slip(kNull)) {
    unit->model = kept;
    unit->is_set = false;
    return fmi2OK;
  }
  memcpy(unit, state, sizeof(Unit));
  if (has_slip(kTime)) unit->model.time = time;
  if (has_slip(kInaccurate)) unit->model.x *= 1 + 1e-13;
  return fmi2OK;
}

EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  ((Unit*)c)->call.freeMemory(*state);
  *state = NULL;
  return fmi2OK;
}

EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  (void)c, (void)state;
  *size = sizeof(Model);
  return fmi2OK;
}

EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                        size_t size) {
  (void)c;
  if (size < sizeof(Model)) return fmi2Error;
  memcpy(bytes, &((Unit*)state)->model, sizeof(Model));
  return fmi2OK;
}

EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                          fmi2FMUstate* state) {
  static char dangling[64];
  Unit* const unit = c;
  if (size != sizeof(Model)) return refuse(unit, "fmi2DeSerializeFMUstate of other bytes");
  if (has_slip(kOnlyInitialized) && unit->mode == kInstantiated) {
    *state = dangling + 8;
    return refuse(unit, "fmi2DeSerializeFMUstate");
  }
  *state = unit->call.allocateMemory(1, sizeof(Unit));
  memcpy(*state, unit, sizeof(Unit));
  memcpy(&((Unit*)*state)->model, bytes, sizeof(Model));
  ((Unit*)*state)->mode = kStepComplete;
  return fmi2OK;
}
