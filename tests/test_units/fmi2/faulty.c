/* Ends its process, as the parameter `fault` has it, in the first step that ends at 0.5 s or later:
 * 1 by a null pointer, 2 by abort(), 3 by exit(0), 4 by an overflow of the stack.
 * 5 does not end it, and leaves another direction of rounding behind. */
#include <fenv.h>
#include <stdlib.h>

#include "tests/test_units/fmi2/unit.h"

enum { kY = FIRST_OTHER };
enum { kFault = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.real[kY] = 0; }
static void unit_outputs(Unit* unit) { (void)unit; }

/* Deeper than any stack; the frames are used, so none is left out. */
static int recurse(int depth, volatile char* above) {
  volatile char frame[4096];
  frame[0] = *above;
  return depth == 0 ? 0 : recurse(depth - 1, frame) + frame[0];
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  volatile char first = 0;
  int* volatile nowhere = (int*)16;
  unit->model.real[kY] += size;
  if (begin + size < 0.5) return fmi2OK;
  switch (unit->model.integer[kFault]) {
    case 1:
      *nowhere = 1;
      break;
    case 2:
      abort();
    case 3:
      exit(0);
    case 4:
      recurse(1 << 30, &first);
      break;
    case 5:
      fesetround(FE_UPWARD);
  }
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
