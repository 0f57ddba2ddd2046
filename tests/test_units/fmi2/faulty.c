/* Commits a fault of faults/faults.h, in any call. */
#include "tests/test_units/faults/faults.h"

#define FAULT(call) stride_test_fault(call, fmi2_step_begin + fmi2_step_size)
#include "tests/test_units/fmi2/unit.h"

enum { kY = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.real[kY] = 0; }
static void unit_outputs(Unit* unit) { (void)unit; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  (void)begin;
  unit->model.real[kY] += size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
