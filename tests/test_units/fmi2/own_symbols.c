/* What functions return that are called by names which other libraries have, too: of those that
 * are called, how many are the unit's own, and what one of them returns. */
#include "tests/test_units/own_symbols/own_symbols.h"

#include "tests/test_units/fmi2/unit.h"

enum { kCalled = FIRST_OTHER, kOwn, kValue };

static void unit_start(Unit* unit) { (void)unit; }

static void unit_outputs(Unit* unit) {
  const OwnSymbols found = call_own_symbols();
  unit->model.real[kCalled] = found.called;
  unit->model.real[kOwn] = found.own;
  unit->model.real[kValue] = found.value;
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  unit->model.time = begin + size;
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
