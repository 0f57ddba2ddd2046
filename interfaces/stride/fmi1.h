/* The C ABI of FMI 1.0 for Co-Simulation, written from the standard: platform types, status codes,
 * callbacks and the type of every function. Clean as C11 and as C++17. The names are those of the
 * standard with "fmi1" in place of "fmi", so that they can be used beside those of other versions;
 * a library exports them as <modelIdentifier>_fmi<Name>.
 *
 * FMI1_FUNCTIONS lists the whole entry table in one place.
 */
#ifndef STRIDE_FMI1_H
#define STRIDE_FMI1_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FMI1_VERSION "1.0"

/* ---- Platform types ---- */

/* What fmiGetTypesPlatform returns where these are the types. */
#define FMI1_TYPES_PLATFORM "standard32"

typedef void* fmi1Component;
typedef unsigned int fmi1ValueReference;
typedef double fmi1Real;
typedef int fmi1Integer;
typedef char fmi1Boolean;
typedef const char* fmi1String;

#define fmi1True 1
#define fmi1False 0

typedef enum { fmi1OK, fmi1Warning, fmi1Discard, fmi1Error, fmi1Fatal, fmi1Pending } fmi1Status;

typedef enum { fmi1DoStepStatus, fmi1PendingStatus, fmi1LastSuccessfulTime } fmi1StatusKind;

/* ---- Callbacks from the unit into the importer ---- */

/* `message` and what follows it are those of printf. */
typedef void (*fmi1CallbackLogger)(fmi1Component c, fmi1String instanceName, fmi1Status status,
                                   fmi1String category, fmi1String message, ...);
/* Those of calloc and free. */
typedef void* (*fmi1CallbackAllocateMemory)(size_t nobj, size_t size);
typedef void (*fmi1CallbackFreeMemory)(void* obj);
typedef void (*fmi1StepFinished)(fmi1Component c, fmi1Status status);

typedef struct {
  fmi1CallbackLogger logger;
  fmi1CallbackAllocateMemory allocateMemory;
  fmi1CallbackFreeMemory freeMemory;
  fmi1StepFinished stepFinished;
} fmi1CallbackFunctions;

/* ---- Life cycle ---- */

typedef const char* fmi1GetTypesPlatformTYPE(void);

typedef fmi1Component fmi1InstantiateSlaveTYPE(fmi1String instanceName, fmi1String fmuGUID,
                                               fmi1String fmuLocation, fmi1String mimeType,
                                               fmi1Real timeout, fmi1Boolean visible,
                                               fmi1Boolean interactive,
                                               fmi1CallbackFunctions functions,
                                               fmi1Boolean loggingOn);
typedef fmi1Status fmi1InitializeSlaveTYPE(fmi1Component c, fmi1Real tStart,
                                           fmi1Boolean stopTimeDefined, fmi1Real tStop);
typedef fmi1Status fmi1TerminateSlaveTYPE(fmi1Component c);
typedef fmi1Status fmi1ResetSlaveTYPE(fmi1Component c);
typedef void fmi1FreeSlaveInstanceTYPE(fmi1Component c);

/* ---- Values ---- */

/* An Enumeration travels as an Integer. */
#define FMI1_VALUE_TYPES(X) \
  X(Real)                   \
  X(Integer)                \
  X(Boolean)                \
  X(String)

#define FMI1_DECLARE_ACCESS(T)                                                                    \
  typedef fmi1Status fmi1Get##T##TYPE(fmi1Component c, const fmi1ValueReference vr[], size_t nvr, \
                                      fmi1##T value[]);                                           \
  typedef fmi1Status fmi1Set##T##TYPE(fmi1Component c, const fmi1ValueReference vr[], size_t nvr, \
                                      const fmi1##T value[]);
FMI1_VALUE_TYPES(FMI1_DECLARE_ACCESS)
#undef FMI1_DECLARE_ACCESS

/* ---- Steps ---- */

typedef fmi1Status fmi1DoStepTYPE(fmi1Component c, fmi1Real currentCommunicationPoint,
                                  fmi1Real communicationStepSize, fmi1Boolean newStep);
typedef fmi1Status fmi1GetRealStatusTYPE(fmi1Component c, const fmi1StatusKind s, fmi1Real* value);

/* ---- The entry table, as far as stride calls it: X(name) for each <id>_fmi<name> ---- */

#define FMI1_FUNCTIONS(X) \
  X(GetTypesPlatform)     \
  X(InstantiateSlave)     \
  X(InitializeSlave)      \
  X(TerminateSlave)       \
  X(ResetSlave)           \
  X(FreeSlaveInstance)    \
  X(GetReal)              \
  X(GetInteger)           \
  X(GetBoolean)           \
  X(GetString)            \
  X(SetReal)              \
  X(SetInteger)           \
  X(SetBoolean)           \
  X(SetString)            \
  X(DoStep)               \
  X(GetRealStatus)

#ifdef __cplusplus
}
#endif

#endif
