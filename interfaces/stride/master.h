/* The master of stride as a library, libstride: a run of a scenario, step by step, from any
 * language.
 *
 * A simulation is opened, advanced to instants, looked at, changed, and closed:
 *
 *   stride_simulation* simulation = NULL;
 *   if (stride_open("nfc.ssd", NULL, &simulation) != STRIDE_OK) {
 *     fprintf(stderr, "%s\n", stride_last_error()->message);
 *     return stride_last_error()->status;
 *   }
 *   stride_advance(simulation, stride_seconds(1.5));
 *   stride_close(simulation);
 *
 * Status.  A function that can fail returns a stride_status, and never throws or ends the process.
 * What went wrong is in stride_last_error(), which belongs to the calling thread.
 *
 * Ownership.  Whoever opens a simulation closes it. Texts and arrays that a function returns, and
 * pointers in the structures that it fills, belong to the simulation and are valid until the next
 * call with it, unless it says otherwise. What is passed to a function is copied.
 *
 * Threads.  A simulation is used by one thread at a time, and not by the functions that it calls
 * (stride_progress, stride_log): other calls meanwhile are STRIDE_MISUSE. stride_interrupt() may be
 * called by any thread and by a signal handler. Where units get processes of their own (the setting
 * "isolate"), stride_open() forks the process, and waits before that for the calls of other
 * threads. What units change of the process when they are initialised, as the working folder, the
 * environment or handlers of signals, is put back before stride_open() returns: no other thread
 * changes these meanwhile. The library of a unit stays in memory, with a warning, where threads are
 * there at its end that were not when it was loaded, since they may run its code.
 * Different simulations are independent, but for what their units have in common: code of units
 * that run in the process of the caller shares it, also with the caller. Behind a fork() the
 * simulation is the parent's; in the child nothing may be called with it, and what is, fails with
 * STRIDE_MISUSE.
 *
 * Time.  Simulated time is exact to the picosecond, and a run may take years: see stride_time.
 *
 * Versions.  Structures begin with their size, which the caller sets to sizeof; later versions add
 * members at the end. Zero is the default of each member.
 */
#ifndef STRIDE_MASTER_H
#define STRIDE_MASTER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status ---- */

typedef enum stride_status {
  STRIDE_OK = 0,
  STRIDE_RUN_FAILED = 1,    /* a unit, the simulation or the machine failed; the run is over */
  STRIDE_INVALID_INPUT = 2, /* the scenario, a setting, a name, a value; nothing has changed */
  STRIDE_MISUSE = 3         /* a call that its documentation does not allow; nothing has changed */
} stride_status;

/* An instant: `seconds`, rounded down, and the `picoseconds` above them, 0 to 999999999999. So
 * -0.5 s is {-1, 500000000000}. Where there is none, `seconds` is STRIDE_NO_TIME. */
typedef struct stride_time {
  int64_t seconds;
  int64_t picoseconds;
} stride_time;

#define STRIDE_NO_TIME INT64_MIN

/* What is not known is an empty text, 0, or no time. */
typedef struct stride_error {
  stride_status status;
  const char*
      message;      /* all of it: "FILE:LINE: unit 'U', variable 'V', at T s: TEXT", and a hint */
  const char* text; /* without the place and the hint */
  const char* hint; /* how to mend it */
  const char* file; /* of the scenario, or a setting */
  int line;
  const char* component;
  const char* variable;
  stride_time time;
} stride_error;

/* Of the last function that has failed in this thread; valid until the next one that fails. */
const stride_error* stride_last_error(void);

/* "0.1.0" */
const char* stride_version(void);

/* ---- Log ---- */

typedef enum stride_level { STRIDE_INFO = 0, STRIDE_WARNING = 1, STRIDE_ERROR = 2 } stride_level;

/* A message of a unit or of the master. May be called by any thread that is inside of a function of
 * this library; calls none of them. */
typedef void (*stride_log)(void* user, stride_level level, const char* message);

/* Where the messages of all simulations of the process go; NULL: to the standard error stream. */
void stride_set_log(stride_log log, void* user);

/* ---- Time ---- */

/* The nearest picosecond; what is beyond 1e15 s becomes that, NaN no time. */
stride_time stride_seconds(double seconds);

/* The instant `after` later than `time`, exactly. */
stride_time stride_sum(stride_time time, stride_time after);

/* Later than each run ends. */
stride_time stride_end_of_time(void);

/* ---- A simulation ---- */

typedef struct stride_simulation stride_simulation;

/* An option of `stride run`, without the dashes: {"set", "sensor.gain=2"}, {"swap",
 * "sensor=new.fmu"}, {"isolate", NULL}. All that concern the scenario are settings: stop, step,
 * policy, max-step, min-step, relative-tolerance, absolute-tolerance, coupling, extrapolation,
 * no-idle-skip, max-skip, no-checks, no-coverage, isolate, at, unit-timeout, no-sandbox,
 * parameters, set, set-at, force, drop, delay, corrupt, swap, signals, coverage, film, scene,
 * threads. */
typedef struct stride_setting {
  const char* name;
  const char* value; /* NULL: an option without a value */
} stride_setting;

/* Called some ten times a second while stride_advance() runs, by the thread that has called it.
 * Another value than 0 interrupts the run, as stride_interrupt() does. Calls no function with the
 * simulation. */
typedef int (*stride_progress)(void* user, stride_time time);

typedef struct stride_options {
  size_t size;
  const stride_setting* settings;
  size_t setting_count;
  const char* results;    /* the folder of the results, which is made; NULL: none are written */
  const char* checkpoint; /* a file to go on from, of the same scenario and settings; NULL: none.
                             Results begin where it is. */
  int can_save;           /* whether stride_save() will be called: units are journaled then */
  size_t message_limit;   /* how many messages are kept for stride_next_message(), at most */
  stride_progress progress;
  void* user; /* for progress */
} stride_options;

/* Loads the scenario (.ssd, .ssp, .fmu), instantiates its units and initialises them: the
 * simulation is at its start time, or that of the checkpoint, which is its first communication
 * point. `options`: NULL = the defaults. On failure `*simulation` is NULL. */
stride_status stride_open(const char* scenario, const stride_options* options,
                          stride_simulation** simulation);

/* Simulates up to this instant, at which a communication step ends, or up to the end of the run if
 * that is earlier: the stop time, or where a unit ends it. Where the run would not have a
 * communication point by itself, this makes one, as an intervention does, and results may differ by
 * that. */
stride_status stride_advance(stride_simulation* simulation, stride_time until);

/* Ends the run where it is: units are terminated, verdicts are given, and the results completed.
 * A failed verdict is none of the status. Afterwards stride_get_verdict(), stride_end_reason() and
 * stride_now() can be called, and stride_close(). */
stride_status stride_end(stride_simulation* simulation);

/* Ends the run, if it has not ended, and frees the simulation. NULL is allowed. Where a call with
 * the simulation is under way, as in a function that such a call has called, it is STRIDE_MISUSE,
 * and the simulation stays open; likewise in a fork of the process. */
stride_status stride_close(stride_simulation* simulation);

/* The run ends at its next communication point: stride_advance() returns STRIDE_RUN_FAILED then,
 * and all that is left to do is to end it. */
void stride_interrupt(stride_simulation* simulation);

/* The instant that the simulation has reached. */
stride_time stride_now(const stride_simulation* simulation);
stride_time stride_start_time(const stride_simulation* simulation);
stride_time stride_stop_time(const stride_simulation* simulation);

/* Whether there is nothing more to simulate: the stop time is reached, a unit has ended the run, or
 * it has failed, was interrupted or ended. */
int stride_is_over(const stride_simulation* simulation);

/* Where it is over: "completed", "ended by a unit", "interrupted", "ended early", or "failed";
 * empty before. */
const char* stride_end_reason(const stride_simulation* simulation);

/* ---- Variables ---- */

typedef enum stride_type {
  STRIDE_FLOAT32, /* float */
  STRIDE_FLOAT64, /* double */
  STRIDE_INT8,    /* int8_t, and so on */
  STRIDE_UINT8,
  STRIDE_INT16,
  STRIDE_UINT16,
  STRIDE_INT32,
  STRIDE_UINT32,
  STRIDE_INT64,
  STRIDE_UINT64,
  STRIDE_BOOLEAN,     /* uint8_t: 0 or 1 */
  STRIDE_STRING,      /* const char*, UTF-8 */
  STRIDE_BINARY,      /* stride_bytes */
  STRIDE_ENUMERATION, /* int64_t */
  STRIDE_CLOCK        /* has no value: see stride_send() */
} stride_type;

typedef struct stride_bytes {
  const uint8_t* data;
  size_t size;
} stride_bytes;

typedef enum stride_causality {
  STRIDE_PARAMETER,
  STRIDE_CALCULATED_PARAMETER,
  STRIDE_STRUCTURAL_PARAMETER,
  STRIDE_INPUT,
  STRIDE_OUTPUT,
  STRIDE_LOCAL,
  STRIDE_INDEPENDENT
} stride_causality;

typedef struct stride_variable {
  size_t size;
  const char* name;      /* "sensor.led", of an output of the system "led" */
  const char* component; /* "sensor"; empty for an output of the system */
  stride_type type;
  stride_causality causality;
  const char* unit; /* of measure: "V"; empty if there is none */
  const char* description;
  size_t count;             /* of elements: 1, or the product of the dimensions */
  const size_t* dimensions; /* of an array */
  size_t dimension_count;   /* 0: a scalar */
  int is_connected;         /* an input with a source */
  int is_message;           /* belongs to a clock that ticks at events: see stride_send() */
  const size_t* clocks;     /* the indices of the clocks to which it belongs */
  size_t clock_count;
  int is_relative; /* a difference, whose unit is converted without its offset */
} stride_variable;

/* Variables are numbered from 0, in the order of the components and of their descriptions, behind
 * them the outputs of the system. */
size_t stride_variable_count(const stride_simulation* simulation);
stride_status stride_describe(stride_simulation* simulation, size_t index,
                              stride_variable* variable);
stride_status stride_find(stride_simulation* simulation, const char* name, size_t* index);

/* Reads a variable at the present instant: `count` elements, all that it has, of the C type above.
 * Strings and bytes are valid until the next call with the simulation. What was set before at this
 * instant counts already. */
stride_status stride_get(stride_simulation* simulation, size_t index, void* elements, size_t count);

/* Sets a tunable parameter, or an input without a source, at the present instant; all that is set
 * and sent at an instant is one event of it, another one than those that were handled there. The
 * instant is recorded again then: signals.csv has a second row with this time. */
stride_status stride_set(stride_simulation* simulation, size_t index, const void* elements,
                         size_t count);

/* What the option of `stride run` with this name does, from now on or later: "set-at", "force",
 * "drop", "delay", "corrupt"; `text` is its value, such as "sensor.u=3@1.5..2". Such an
 * intervention may not begin before the present instant. */
stride_status stride_intervene(stride_simulation* simulation, const char* option, const char* text);

/* ---- Messages ---- */

typedef struct stride_value {
  size_t index;         /* of the variable */
  const void* elements; /* as of stride_set() */
  size_t count;
} stride_value;

/* Sends a message at the present instant: an input clock that ticks at events, with values of
 * inputs that belong to it. */
stride_status stride_send(stride_simulation* simulation, size_t clock, const stride_value* values,
                          size_t value_count);

typedef struct stride_message {
  size_t size;
  stride_time time;
  uint32_t super_dense_index; /* which event iteration at this time */
  size_t index;               /* of the variable, or of the clock of a message without a value */
  int is_received;            /* 0: sent by the component, 1: received by it */
  const void* elements;       /* as of stride_get(); NULL: none */
  size_t count;
  const char* content; /* a Binary as its unit describes it; may be empty */
  size_t dropped;      /* messages before it that were more than the limit */
} stride_message;

/* The oldest of the messages since the last call, sent or received by any component. Returns 1, or
 * 0 where there is none. */
int stride_next_message(stride_simulation* simulation, stride_message* message);

/* ---- State ---- */

/* Writes a checkpoint of the present instant; see stride_options. */
stride_status stride_save(stride_simulation* simulation, const char* file);

/* ---- Verdicts ---- */

typedef struct stride_verdict {
  size_t size;
  const char* name;
  const char* text; /* why */
  int passed;       /* 1, 0, or -1: not decided */
  stride_time time; /* of the first failure; STRIDE_NO_TIME: there is none */
  double margin;    /* how far from failing, negative: failed; NaN: it has none */
} stride_verdict;

/* Of the units and the scenario's checks, behind the end of the run. */
size_t stride_verdict_count(const stride_simulation* simulation);
stride_status stride_get_verdict(stride_simulation* simulation, size_t index,
                                 stride_verdict* verdict);

#ifdef __cplusplus
}
#endif

#endif
