/* y rises by 1 in a second until the instant `turn`, and falls as fast after it. A step that leads
 * across that instant ends there, with fmi2Discard. Parameters: `ends` requests the end of the
 * simulation there, `mute` does not say how far it came, and `stays` says that it came nowhere. */
#include "tests/test_units/fmi2/unit.h"

enum { kY = FIRST_OTHER, kTurn, kDirection };
enum { kEnds = FIRST_OTHER, kMute, kStays };

static void unit_start(Unit* unit) {
  unit->model.x = 0;
  unit->model.real[kTurn] = 0.25;
  unit->model.real[kDirection] = 1;
}
static void unit_outputs(Unit* unit) { unit->model.real[kY] = unit->model.x; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  Model* const m = &unit->model;
  const double turn = m->real[kTurn];
  const double end = begin + size;
  /* rounding aside: who stands at the turn is behind it */
  if (begin >= turn - 1e-12) m->real[kDirection] = -1;
  if (begin >= turn - 1e-12 || end <= turn + 1e-12) {
    m->x += m->real[kDirection] * size;
    m->time = end;
    return fmi2OK;
  }
  m->x += turn - begin;
  m->time = turn;
  unit->knows_time = !m->boolean[kMute];
  unit->last_successful = m->boolean[kStays] ? begin : turn;
  unit->is_ending = m->boolean[kEnds];
  LOG(unit, fmi2Discard, "there is a turn at %g s", turn);
  return fmi2Discard;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
