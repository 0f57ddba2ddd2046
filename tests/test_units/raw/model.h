/* The unit of unit.c with a model: who includes it has defined the type Model, start(), and macros
 * for the functions of FMI that are the model's own.
 */
#define fmi3InstantiateCoSimulation raw_instantiate
#include "tests/test_units/raw/unit.c"
#undef fmi3InstantiateCoSimulation
#undef fmi3ExitInitializationMode
#undef fmi3GetFloat64
#undef fmi3SetFloat64
#undef fmi3GetInt64
#undef fmi3SetInt64
#undef fmi3SetUInt64

static Model models[sizeof instances / sizeof *instances];

static Model* model(fmi3Instance handle) { return &models[(Instance*)handle - instances]; }

static fmi3Status fail(fmi3Instance handle, const char* message) {
  Instance* instance = handle;
  instance->log(instance->environment, fmi3Error, "logStatusError", message);
  return fmi3Error;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t n_required,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  const fmi3Instance handle =
      raw_instantiate(name, token, resources, visible, logging, event_mode, early_return, required,
                      n_required, environment, log, update);
  if (handle != NULL) start(model(handle));
  return handle;
}
