/* n counts steps. Each must be of exactly STEP seconds and end at the stop time at the latest, as
 * doubles compare: units of several tools are as strict. The state cannot be saved. */
#include "tests/test_units/fmi2/unit.h"

enum { kN = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.x = 0; }
static void unit_outputs(Unit* unit) { unit->model.real[kN] = unit->model.x; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  if (size != STEP) {
    LOG(unit, fmi2Error, "the step is %.17g", size);
    return fmi2Error;
  }
  if (begin + size > fmi2_stop_time) {
    LOG(unit, fmi2Error, "the step ends at %.17g", begin + size);
    return fmi2Error;
  }
  unit->model.x += 1;
  unit->model.time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
