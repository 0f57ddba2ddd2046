/* Complains in each step, as the parameter `mood` has it: 1 with a warning, 3 with fmi2Error, 4
 * with fmi2Fatal, 5 with fmi2Error and without a word, 6 with a message longer than most, 7 with
 * one that must not be formatted, 77 with no status of FMI. A status of a step's end is returned as
 * it is.
 *
 * 8 to 11 with messages as careless generators write them: with a pointer of its own for the
 * environment, with null for whatever may be a pointer, from another thread, without arguments for
 * its conversions.
 *
 * 12 and 13 with a message that begins with the function's name, as a unit gives its reason, and
 * then with fmi2OK or fmi2Error. */
#include <pthread.h>

#include "tests/test_units/fmi2/unit.h"

enum { kLevel = FIRST_OTHER };
enum { kMood = FIRST_OTHER };

static void unit_start(Unit* unit) { unit->model.real[kLevel] = 0.5; }
static void unit_outputs(Unit* unit) { (void)unit; }

static void* log_in_thread(void* unit) {
  ((Unit*)unit)->call.logger(unit, "", fmi2Warning, "logStatus", "it gets hot");
  return NULL;
}

static void log_carelessly(Unit* unit, int mood) {
  const fmi2CallbackLogger logger = unit->call.logger;
  pthread_t thread;
  switch (mood) {
    case 8:
      logger(unit, unit->name, fmi2Warning, "logStatus", "it gets hot");
      break;
    case 9:
      logger(NULL, NULL, fmi2Warning, NULL, "it gets hot");
      logger(NULL, NULL, fmi2Warning, NULL, NULL);
      break;
    case 10:
      if (pthread_create(&thread, NULL, log_in_thread, unit) == 0) pthread_join(thread, NULL);
      break;
    default:
      logger(unit, unit->name, fmi2Warning, "logStatus", "it gets hot: %s %s %s %s %s %s %s %s");
  }
}

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
    case 8:
    case 9:
    case 10:
    case 11:
      log_carelessly(unit, mood);
      return fmi2OK;
    case 12:
    case 13:
      LOG(unit, fmi2Error, "fmi2DoStep: it gets hot");
      return mood == 12 ? fmi2OK : fmi2Error;
    case 77:
      return (fmi2Status)77;
    default:
      return fmi2OK;
  }
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
