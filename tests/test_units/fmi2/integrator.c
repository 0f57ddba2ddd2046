/* x' = u, with the input's derivatives: exact for polynomials up to the second degree. */
#include "tests/test_units/fmi2/unit.h"

enum { kU = FIRST_INPUT, kX = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.x = 0; }
static void unit_outputs(Unit* unit) { unit->model.real[kX] = unit->model.x; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  Model* const m = &unit->model;
  const double* const slope = m->slope[kU];
  m->x += size * (m->real[kU] + size * (slope[1] / 2 + size * slope[2] / 6));
  m->time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
