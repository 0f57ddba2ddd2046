/* y counts seconds in steps that are pending. The parameter `how` says how they end: 0 by a
 * callback from a thread, 1 when they were asked for the third time, 2 not before a call of
 * sleeper_release, 3 by a callback before fmi2DoStep returns. `result` is their status; 2,
 * fmi2Discard, comes halfway. */
#include <pthread.h>
#include <stdbool.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_t thread;
static bool has_thread = false;

static void end_thread(void) {
  if (has_thread) pthread_join(thread, NULL);
  has_thread = false;
}

#define LOCK() pthread_mutex_lock(&mutex)
#define UNLOCK() pthread_mutex_unlock(&mutex)
#define END() end_thread()
#include "tests/test_units/fmi2/unit.h"

enum { kY = FIRST_OTHER };
enum { kHow = FIRST_OTHER, kResult };

static int polls = 0;
static bool is_released = false;

EXPORT void sleeper_release(void) { is_released = true; }

static void unit_start(Unit* unit) { unit->model.x = 0; }
static void unit_outputs(Unit* unit) { unit->model.real[kY] = unit->model.x; }

static fmi2Status finish(Unit* unit) {
  const fmi2Status result = (fmi2Status)unit->model.integer[kResult];
  const double share = result == fmi2Discard ? 0.5 : 1;
  unit->model.x += share * fmi2_step_size;
  unit->knows_time = true;
  unit->last_successful = fmi2_step_begin + share * fmi2_step_size;
  if (result > fmi2Warning) LOG(unit, result, "the night was short");
  return result;
}

static void* run(void* c) {
  Unit* const unit = c;
  LOCK(); /* so not before fmi2DoStep is done */
  const fmi2Status status = end_step(unit, finish(unit));
  const fmi2CallbackFunctions call = unit->call;
  UNLOCK();
  call.stepFinished(call.componentEnvironment, status);
  return NULL;
}

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  (void)begin, (void)size;
  polls = 0;
  is_released = false;
  end_thread();
  has_thread = unit->model.integer[kHow] == 0;
  if (has_thread) pthread_create(&thread, NULL, run, unit);
  if (unit->model.integer[kHow] == 3) {
    unit->finished = finish(unit);
    unit->call.stepFinished(unit->call.componentEnvironment, unit->finished);
  }
  return fmi2Pending;
}

static fmi2Status unit_poll(Unit* unit) {
  const int how = unit->model.integer[kHow];
  if (how == 0 || how == 3) return fmi2Pending;
  ++polls;
  const bool is_done = how == 1 ? polls >= 3 : is_released;
  return is_done ? finish(unit) : fmi2Pending;
}
