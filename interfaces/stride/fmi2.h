/* The C ABI of FMI 2.0 (Modelica Association), written from the standard: platform types (2.1.2
 * there), status codes, callbacks and the type of every function of both interface types. Clean as
 * C11 and as C++17.
 *
 * Functions that differ in a value's type only are generated from FMI2_VALUE_TYPES; FMI2_FUNCTIONS
 * lists the whole entry table in one place, for code that exports it, loads it or checks it.
 */
#ifndef STRIDE_FMI2_H
#define STRIDE_FMI2_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FMI2_VERSION "2.0"

/* ---- Platform types ---- */

/* What fmi2GetTypesPlatform returns where these are the types. */
#define FMI2_TYPES_PLATFORM "default"

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;

typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

#define fmi2True 1
#define fmi2False 0

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;

typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;

/* Of what fmi2GetStatus and its kin inform: a Status, a String, a Real, a Boolean. */
typedef enum {
  fmi2DoStepStatus,
  fmi2PendingStatus,
  fmi2LastSuccessfulTime,
  fmi2Terminated
} fmi2StatusKind;

typedef struct {
  fmi2Boolean newDiscreteStatesNeeded;
  fmi2Boolean terminateSimulation;
  fmi2Boolean nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged;
  fmi2Boolean nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;

/* ---- Callbacks from the unit into the importer ---- */

/* `message` and what follows it are those of printf. */
typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment componentEnvironment,
                                   fmi2String instanceName, fmi2Status status, fmi2String category,
                                   fmi2String message, ...);

/* Those of calloc and free. */
typedef void* (*fmi2CallbackAllocateMemory)(size_t nobj, size_t size);
typedef void (*fmi2CallbackFreeMemory)(void* obj);

typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment componentEnvironment, fmi2Status status);

typedef struct {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/* ---- Life cycle ---- */

typedef const char* fmi2GetTypesPlatformTYPE(void);
typedef const char* fmi2GetVersionTYPE(void);

typedef fmi2Status fmi2SetDebugLoggingTYPE(fmi2Component c, fmi2Boolean loggingOn,
                                           size_t nCategories, const fmi2String categories[]);

typedef fmi2Component fmi2InstantiateTYPE(fmi2String instanceName, fmi2Type fmuType,
                                          fmi2String fmuGUID, fmi2String fmuResourceLocation,
                                          const fmi2CallbackFunctions* functions,
                                          fmi2Boolean visible, fmi2Boolean loggingOn);

typedef void fmi2FreeInstanceTYPE(fmi2Component c);

typedef fmi2Status fmi2SetupExperimentTYPE(fmi2Component c, fmi2Boolean toleranceDefined,
                                           fmi2Real tolerance, fmi2Real startTime,
                                           fmi2Boolean stopTimeDefined, fmi2Real stopTime);
typedef fmi2Status fmi2EnterInitializationModeTYPE(fmi2Component c);
typedef fmi2Status fmi2ExitInitializationModeTYPE(fmi2Component c);
typedef fmi2Status fmi2TerminateTYPE(fmi2Component c);
typedef fmi2Status fmi2ResetTYPE(fmi2Component c);

/* ---- Values ---- */

/* An Enumeration travels as an Integer. */
#define FMI2_VALUE_TYPES(X) \
  X(Real)                   \
  X(Integer)                \
  X(Boolean)                \
  X(String)

#define FMI2_DECLARE_ACCESS(T)                                                                    \
  typedef fmi2Status fmi2Get##T##TYPE(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                                      fmi2##T value[]);                                           \
  typedef fmi2Status fmi2Set##T##TYPE(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                                      const fmi2##T value[]);
FMI2_VALUE_TYPES(FMI2_DECLARE_ACCESS)
#undef FMI2_DECLARE_ACCESS

typedef fmi2Status fmi2GetDirectionalDerivativeTYPE(fmi2Component c,
                                                    const fmi2ValueReference vUnknown_ref[],
                                                    size_t nUnknown,
                                                    const fmi2ValueReference vKnown_ref[],
                                                    size_t nKnown, const fmi2Real dvKnown[],
                                                    fmi2Real dvUnknown[]);

/* ---- State of the whole unit ---- */

typedef fmi2Status fmi2GetFMUstateTYPE(fmi2Component c, fmi2FMUstate* state);
typedef fmi2Status fmi2SetFMUstateTYPE(fmi2Component c, fmi2FMUstate state);
typedef fmi2Status fmi2FreeFMUstateTYPE(fmi2Component c, fmi2FMUstate* state);
typedef fmi2Status fmi2SerializedFMUstateSizeTYPE(fmi2Component c, fmi2FMUstate state,
                                                  size_t* size);
typedef fmi2Status fmi2SerializeFMUstateTYPE(fmi2Component c, fmi2FMUstate state,
                                             fmi2Byte serializedState[], size_t size);
typedef fmi2Status fmi2DeSerializeFMUstateTYPE(fmi2Component c, const fmi2Byte serializedState[],
                                               size_t size, fmi2FMUstate* state);

/* ---- Model Exchange ---- */

typedef fmi2Status fmi2EnterEventModeTYPE(fmi2Component c);
typedef fmi2Status fmi2NewDiscreteStatesTYPE(fmi2Component c, fmi2EventInfo* eventInfo);
typedef fmi2Status fmi2EnterContinuousTimeModeTYPE(fmi2Component c);
typedef fmi2Status fmi2CompletedIntegratorStepTYPE(fmi2Component c,
                                                   fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                                   fmi2Boolean* enterEventMode,
                                                   fmi2Boolean* terminateSimulation);
typedef fmi2Status fmi2SetTimeTYPE(fmi2Component c, fmi2Real time);
typedef fmi2Status fmi2SetContinuousStatesTYPE(fmi2Component c, const fmi2Real x[], size_t nx);
typedef fmi2Status fmi2GetDerivativesTYPE(fmi2Component c, fmi2Real derivatives[], size_t nx);
typedef fmi2Status fmi2GetEventIndicatorsTYPE(fmi2Component c, fmi2Real eventIndicators[],
                                              size_t ni);
typedef fmi2Status fmi2GetContinuousStatesTYPE(fmi2Component c, fmi2Real x[], size_t nx);
typedef fmi2Status fmi2GetNominalsOfContinuousStatesTYPE(fmi2Component c, fmi2Real x_nominal[],
                                                         size_t nx);

/* ---- Co-Simulation ---- */

typedef fmi2Status fmi2SetRealInputDerivativesTYPE(fmi2Component c, const fmi2ValueReference vr[],
                                                   size_t nvr, const fmi2Integer order[],
                                                   const fmi2Real value[]);
typedef fmi2Status fmi2GetRealOutputDerivativesTYPE(fmi2Component c, const fmi2ValueReference vr[],
                                                    size_t nvr, const fmi2Integer order[],
                                                    fmi2Real value[]);
typedef fmi2Status fmi2DoStepTYPE(fmi2Component c, fmi2Real currentCommunicationPoint,
                                  fmi2Real communicationStepSize,
                                  fmi2Boolean noSetFMUStatePriorToCurrentPoint);
typedef fmi2Status fmi2CancelStepTYPE(fmi2Component c);

typedef fmi2Status fmi2GetStatusTYPE(fmi2Component c, const fmi2StatusKind s, fmi2Status* value);
typedef fmi2Status fmi2GetRealStatusTYPE(fmi2Component c, const fmi2StatusKind s, fmi2Real* value);
typedef fmi2Status fmi2GetIntegerStatusTYPE(fmi2Component c, const fmi2StatusKind s,
                                            fmi2Integer* value);
typedef fmi2Status fmi2GetBooleanStatusTYPE(fmi2Component c, const fmi2StatusKind s,
                                            fmi2Boolean* value);
typedef fmi2Status fmi2GetStringStatusTYPE(fmi2Component c, const fmi2StatusKind s,
                                           fmi2String* value);

/* ---- The entry table: X(name) for each function fmi2<name> of type fmi2<name>TYPE ---- */

#define FMI2_FUNCTIONS(X)          \
  X(GetTypesPlatform)              \
  X(GetVersion)                    \
  X(SetDebugLogging)               \
  X(Instantiate)                   \
  X(FreeInstance)                  \
  X(SetupExperiment)               \
  X(EnterInitializationMode)       \
  X(ExitInitializationMode)        \
  X(Terminate)                     \
  X(Reset)                         \
  X(GetReal)                       \
  X(GetInteger)                    \
  X(GetBoolean)                    \
  X(GetString)                     \
  X(SetReal)                       \
  X(SetInteger)                    \
  X(SetBoolean)                    \
  X(SetString)                     \
  X(GetFMUstate)                   \
  X(SetFMUstate)                   \
  X(FreeFMUstate)                  \
  X(SerializedFMUstateSize)        \
  X(SerializeFMUstate)             \
  X(DeSerializeFMUstate)           \
  X(GetDirectionalDerivative)      \
  X(EnterEventMode)                \
  X(NewDiscreteStates)             \
  X(EnterContinuousTimeMode)       \
  X(CompletedIntegratorStep)       \
  X(SetTime)                       \
  X(SetContinuousStates)           \
  X(GetDerivatives)                \
  X(GetEventIndicators)            \
  X(GetContinuousStates)           \
  X(GetNominalsOfContinuousStates) \
  X(SetRealInputDerivatives)       \
  X(GetRealOutputDerivatives)      \
  X(DoStep)                        \
  X(CancelStep)                    \
  X(GetStatus)                     \
  X(GetRealStatus)                 \
  X(GetIntegerStatus)              \
  X(GetBooleanStatus)              \
  X(GetStringStatus)

#ifdef __cplusplus
}
#endif

#endif
