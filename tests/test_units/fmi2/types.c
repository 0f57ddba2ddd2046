/* All types, with value references that are the same for different ones. Each output is its input,
 * at once. `gain` is a parameter, an output and a local variable at once, by one value reference.
 */
#include "tests/test_units/fmi2/unit.h"

enum { kIn = FIRST_INPUT, kMode, kOut = FIRST_OTHER, kModeOut, kGain };

static void unit_start(Unit* unit) {
  unit->model.real[kGain] = 3;
  unit->model.integer[kMode] = 1;
  strcpy(unit->model.string[kGain], unit->resources);
}

static void unit_outputs(Unit* unit) {
  Model* const m = &unit->model;
  m->real[kOut] = m->real[kIn] * m->real[kGain];
  m->integer[kOut] = m->integer[kIn];
  m->integer[kModeOut] = m->integer[kMode];
  m->boolean[kOut] = m->boolean[kIn];
  strcpy(m->string[kOut], m->string[kIn]);
}

/* Of the Real output by the Real input. */
EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                               size_t n_unknowns, const fmi2ValueReference knowns[],
                                               size_t n_knowns, const fmi2Real seed[],
                                               fmi2Real sensitivity[]) {
  ALLOW("fmi2GetDirectionalDerivative", unit->mode != kInstantiated)
  for (size_t i = 0; i < n_unknowns; ++i) {
    sensitivity[i] = 0;
    for (size_t k = 0; k < n_knowns; ++k) {
      const bool depends = unknowns[i] == kOut && knowns[k] == kIn;
      sensitivity[i] += depends ? unit->model.real[kGain] * seed[k] : 0;
    }
  }
  return fmi2OK;
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  unit->model.time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
