/* A stand-alone Co-Simulation unit of FMI 1.0 in C99 against the ABI alone, as another tool's is: a
 * tank whose level rises by `inflow`, and values of all types that are handed on. A unit is strict
 * where the standard is. The parameter `mood` makes a step behave: 1 warns, 2 refuses steps longer
 * than `longest`, 3 completes `longest` of them, 4 returns fmiError, 5 fmiPending, 6 refuses
 * each step and reports a time before it. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <stride/fmi1.h>

#define EXPORT __attribute__((visibility("default")))
#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define NAMED(function) JOIN(UNIT_ID, _fmi##function)

enum { kInflow, kLevel, kLongest, kReals = 8 };
enum { kMood, kMode, kIntegers = 8 };

typedef struct {
  char name[64];
  fmi1CallbackFunctions call;
  bool is_initialized, is_ended;
  double time, real[kReals], completed;
  int integer[kIntegers];
  char boolean[2];
  char string[2][64];
} Unit;

/* Read by the tests through dlsym. */
EXPORT int fmi1_living_units = 0;
EXPORT char fmi1_location[512];
EXPORT double fmi1_stop = 0;
EXPORT int fmi1_new_step = -1;

#define LOG(unit, status, ...) (unit)->call.logger(unit, (unit)->name, status, "log", __VA_ARGS__)

static fmi1Status refuse(Unit* unit, const char* function) {
  LOG(unit, fmi1Error, "%s is not allowed now", function);
  return fmi1Error;
}
#define ALLOW(function, condition) \
  Unit* const unit = c;            \
  if (!(condition)) return refuse(unit, function);

EXPORT const char* NAMED(GetTypesPlatform)(void) { return FMI1_TYPES_PLATFORM; }
EXPORT const char* NAMED(GetVersion)(void) { return FMI1_VERSION; }

static void start(Unit* unit) {
  unit->is_initialized = unit->is_ended = false;
  memset(unit->real, 0, sizeof unit->real);
  memset(unit->integer, 0, sizeof unit->integer);
  memset(unit->boolean, 0, sizeof unit->boolean);
  memset(unit->string, 0, sizeof unit->string);
  unit->real[kInflow] = 1;
  unit->real[kLongest] = 0.25;
  unit->integer[kMode] = 1; /* open */
}

EXPORT fmi1Component NAMED(InstantiateSlave)(fmi1String name, fmi1String guid, fmi1String location,
                                             fmi1String type, fmi1Real timeout, fmi1Boolean visible,
                                             fmi1Boolean interactive,
                                             fmi1CallbackFunctions functions, fmi1Boolean logging) {
  (void)type, (void)timeout, (void)visible, (void)interactive, (void)logging;
  Unit* const unit = functions.allocateMemory(1, sizeof(Unit));
  strncpy(unit->name, name, sizeof unit->name - 1);
  strncpy(fmi1_location, location, sizeof fmi1_location - 1);
  unit->call = functions;
  if (strcmp(guid, "{tank}") != 0) {
    LOG(unit, fmi1Error, "the GUID is %s", guid);
    functions.freeMemory(unit);
    return NULL;
  }
  start(unit);
  ++fmi1_living_units;
  return unit;
}

EXPORT fmi1Status NAMED(InitializeSlave)(fmi1Component c, fmi1Real begin, fmi1Boolean has_stop,
                                         fmi1Real stop) {
  ALLOW("fmiInitializeSlave", !unit->is_initialized)
  unit->is_initialized = true;
  unit->time = begin;
  fmi1_stop = has_stop ? stop : 0;
  return fmi1OK;
}
EXPORT fmi1Status NAMED(TerminateSlave)(fmi1Component c) {
  ALLOW("fmiTerminateSlave", unit->is_initialized && !unit->is_ended)
  unit->is_ended = true;
  return fmi1OK;
}
EXPORT fmi1Status NAMED(ResetSlave)(fmi1Component c) {
  start(c);
  return fmi1OK;
}
EXPORT void NAMED(FreeSlaveInstance)(fmi1Component c) {
  ((Unit*)c)->call.freeMemory(c);
  --fmi1_living_units;
}

#define ACCESS(Type, member)                                                                      \
  EXPORT fmi1Status NAMED(Get##Type)(fmi1Component c, const fmi1ValueReference r[], size_t count, \
                                     fmi1##Type value[]) {                                        \
    ALLOW("fmiGet" #Type, unit->is_initialized)                                                   \
    for (size_t i = 0; i < count; ++i) value[i] = unit->member[r[i]];                             \
    return fmi1OK;                                                                                \
  }
ACCESS(Real, real)
ACCESS(Integer, integer)
ACCESS(Boolean, boolean)
ACCESS(String, string)

EXPORT fmi1Status NAMED(SetReal)(fmi1Component c, const fmi1ValueReference r[], size_t count,
                                 const fmi1Real value[]) {
  for (size_t i = 0; i < count; ++i) ((Unit*)c)->real[r[i]] = value[i];
  return fmi1OK;
}
EXPORT fmi1Status NAMED(SetInteger)(fmi1Component c, const fmi1ValueReference r[], size_t count,
                                    const fmi1Integer value[]) {
  for (size_t i = 0; i < count; ++i) ((Unit*)c)->integer[r[i]] = value[i];
  return fmi1OK;
}
EXPORT fmi1Status NAMED(SetBoolean)(fmi1Component c, const fmi1ValueReference r[], size_t count,
                                    const fmi1Boolean value[]) {
  for (size_t i = 0; i < count; ++i) ((Unit*)c)->boolean[r[i]] = value[i];
  return fmi1OK;
}
EXPORT fmi1Status NAMED(SetString)(fmi1Component c, const fmi1ValueReference r[], size_t count,
                                   const fmi1String value[]) {
  for (size_t i = 0; i < count; ++i) {
    strncpy(((Unit*)c)->string[r[i]], value[i], sizeof((Unit*)c)->string[0] - 1);
  }
  return fmi1OK;
}

/* The sum of a time and a step size is rounded. */
static bool is_near(double one, double other) { return one - other < 1e-12 && other - one < 1e-12; }

static fmi1Status advance(Unit* unit, double size, fmi1Status status) {
  unit->real[kLevel] += unit->real[kInflow] * size;
  unit->time += size;
  unit->completed = unit->time;
  return status;
}

EXPORT fmi1Status NAMED(DoStep)(fmi1Component c, fmi1Real point, fmi1Real size,
                                fmi1Boolean is_new) {
  ALLOW("fmiDoStep", unit->is_initialized && !unit->is_ended && is_near(point, unit->time))
  fmi1_new_step = is_new;
  const double longest = unit->real[kLongest];
  unit->completed = point;
  switch (unit->integer[kMood]) {
    case 1:
      LOG(unit, fmi1Warning, "#r1# gets %s", "hot");
      return advance(unit, size, fmi1Warning);
    case 2:
      return size > longest ? fmi1Discard : advance(unit, size, fmi1OK);
    case 3:
      return size > longest ? advance(unit, longest, fmi1Discard) : advance(unit, size, fmi1OK);
    case 4:
      LOG(unit, fmi1Error, "it leaks");
      return fmi1Error;
    case 5:
      return fmi1Pending;
    case 6:
      unit->completed = point - 1;
      return fmi1Discard;
    default:
      return advance(unit, size, fmi1OK);
  }
}

EXPORT fmi1Status NAMED(GetRealStatus)(fmi1Component c, const fmi1StatusKind kind,
                                       fmi1Real* value) {
  if (kind != fmi1LastSuccessfulTime) return fmi1Discard;
  *value = ((Unit*)c)->completed;
  return fmi1OK;
}
