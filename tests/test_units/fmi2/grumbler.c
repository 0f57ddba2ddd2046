/* Complains in each step, as the parameter `mood` has it: 1 with a warning, 3 with fmi2Error, 4
 * with fmi2Fatal, 5 with fmi2Error and without a word, 6 with a message longer than most, 7 with
 * one that must not be formatted, 77 with no status of FMI. A status of a step's end is returned as
 * it is. */
#include "tests/test_units/fmi2/unit.h"

enum { kLevel = FIRST_OTHER };
enum { kMood = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.real[kLevel] = 0.5; }
static void unit_outputs(Unit* unit) { (void)unit; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  const int mood = unit->model.integer[kMood];
  (void)begin, (void)size;
  switch (mood) {
    case 1:
      LOG(unit, fmi2Warning, "#r10# is %g %s, %d %%", unit->model.real[kLevel], "m", 50);
      return fmi2Warning;
    case 3:
      LOG(unit, fmi2Error, "#i10# of %d in channel ##%d, not #r99#", mood, 4);
      return fmi2Error;
    case 4:
      LOG(unit, fmi2Fatal, "the heap is gone");
      return fmi2Fatal;
    case 5:
      return fmi2Error;
    case 6:
      LOG(unit, fmi2Error, "%1000d", mood);
      return fmi2Error;
    case 7:
      LOG(unit, fmi2Error, "100%n");
      return fmi2Error;
    case 77:
      return (fmi2Status)77;
    default:
      return fmi2OK;
  }
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
