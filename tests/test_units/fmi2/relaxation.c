/* x' = k (u - x), exactly, for an input that is held: any split of a step gives the same. */
#include <math.h>

#include "tests/test_units/fmi2/unit.h"

enum { kU = FIRST_INPUT, kX = FIRST_OTHER, kK };

static void unit_start(Unit* unit) {
  unit->model.x = unit->model.real[kX] = 1;
  unit->model.real[kK] = 2;
}

/* Until the first step, x is what was set. */
static void unit_outputs(Unit* unit) {
  if (unit->mode <= kInitialization) unit->model.x = unit->model.real[kX];
  unit->model.real[kX] = unit->model.x;
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  Model* const m = &unit->model;
  m->x = m->real[kU] + (m->x - m->real[kU]) * exp(-m->real[kK] * size);
  m->time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
