// The exported FMI 3.0 entry table. Each function checks that it is legal now, calls the instance,
// and turns an exception into fmi3Error and a message; none crosses.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "interfaces/unit/entry_call.h"

using stride::Time;
using stride::Type;
using stride::kit::call;
using stride::kit::Function;
using stride::kit::Importer;
using stride::kit::Instance;
using stride::kit::Misuse;
using stride::kit::report;
using stride::kit::SavedState;
using stride::kit::unsupported;

namespace {

constexpr const char* kModelExchange = "belongs to Model Exchange; this unit is for Co-Simulation";
constexpr const char* kScheduled = "belongs to Scheduled Execution; this unit is for Co-Simulation";
constexpr const char* kNoStructure = "this unit has no structural parameter";
constexpr const char* kNoDependencies = "this unit does not provide per-element dependencies";
constexpr const char* kNoDerivatives = "this unit does not provide partial derivatives";
constexpr const char* kNoEvaluation = "this unit does not provide fmi3EvaluateDiscreteStates";

/// It is read once: for another instance in this process the variable may change.
std::filesystem::path given_results_folder() {
  const char* const folder = std::getenv("STRIDE_RESULTS");
  if (folder == nullptr || *folder == '\0') return {};
  return std::filesystem::absolute(folder);
}

fmi3Instance refuse(Function function, const char* why, fmi3InstanceEnvironment environment,
                    fmi3LogMessageCallback log) {
  Importer importer;
  importer.environment = environment;
  importer.log = log;
  report(importer, function, why);
  return nullptr;
}

}  // namespace

// ---- Life cycle ----

const char* fmi3GetVersion(void) { return FMI3_VERSION; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t count,
                               const fmi3String categories[]) {
  return call(instance, Function::SetDebugLogging, [&](Instance& unit) {
    unit.set_logging(on, categories, count);
    return fmi3OK;
  });
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean, fmi3Boolean logging,
    fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed,
    const fmi3ValueReference intermediate[], size_t intermediate_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback intermediate_update) {
  Importer importer;
  if (logging) importer.log_categories = stride::kit::kAllLogCategories;
  importer.event_mode_used = event_mode_used;
  importer.early_return_allowed = early_return_allowed;
  importer.environment = environment;
  importer.log = log;
  try {
    importer.instance_name = name != nullptr ? name : "";
    importer.resources = resources != nullptr ? resources : "";
    importer.results = given_results_folder();
    importer.intermediate_variables.assign(intermediate, intermediate + intermediate_count);
    std::sort(importer.intermediate_variables.begin(), importer.intermediate_variables.end());
    importer.intermediate_update = intermediate_update;
    return new Instance(importer, token != nullptr ? token : "");
  } catch (const std::exception& failure) {
    report(importer, Function::InstantiateCoSimulation, failure.what());
  } catch (...) {
    report(importer, Function::InstantiateCoSimulation, "the unit threw no std::exception");
  }
  return nullptr;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return refuse(Function::InstantiateModelExchange, kModelExchange, environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  return refuse(Function::InstantiateScheduledExecution, kScheduled, environment, log);
}

void fmi3FreeInstance(fmi3Instance instance) {
  try {
    delete static_cast<Instance*>(instance);
  } catch (...) {
  }
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64,
                                       fmi3Float64 start, fmi3Boolean stop_defined,
                                       fmi3Float64 stop) {
  return call(instance, Function::EnterInitializationMode, [&](Instance& unit) {
    std::optional<Time> end;
    if (stop_defined) end = stride::kit::checked_time(stop);
    unit.enter_initialization_mode(stride::kit::checked_time(start), end);
    return fmi3OK;
  });
}

#define STRIDE_SIMPLE(name, action)                            \
  fmi3Status fmi3##name(fmi3Instance instance) {               \
    return call(instance, Function::name, [](Instance& unit) { \
      unit.action();                                           \
      return fmi3OK;                                           \
    });                                                        \
  }
STRIDE_SIMPLE(ExitInitializationMode, exit_initialization_mode)
STRIDE_SIMPLE(EnterEventMode, enter_event_mode)
STRIDE_SIMPLE(EnterStepMode, enter_step_mode)
STRIDE_SIMPLE(Terminate, terminate)
STRIDE_SIMPLE(Reset, reset)
#undef STRIDE_SIMPLE

// ---- Stepping and events ----

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size, fmi3Boolean,
                      fmi3Boolean* event_needed, fmi3Boolean* terminate, fmi3Boolean* early,
                      fmi3Float64* reached) {
  return call(instance, Function::DoStep, [&](Instance& unit) {
    const Instance::StepOutcome outcome = unit.do_step(point, size);
    const bool rejected = outcome.rejection != nullptr;
    if (rejected)
      report(unit.importer(), Function::DoStep, outcome.rejection->c_str(), fmi3Discard);
    *event_needed = outcome.event_needed;
    *terminate = outcome.terminate;
    *early = outcome.early;
    *reached = outcome.reached;
    return rejected ? fmi3Discard : fmi3OK;
  });
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* iterate,
                                    fmi3Boolean* terminate, fmi3Boolean* nominals_changed,
                                    fmi3Boolean* values_changed, fmi3Boolean* next_defined,
                                    fmi3Float64* next) {
  return call(instance, Function::UpdateDiscreteStates, [&](Instance& unit) {
    const Instance::UpdateOutcome outcome = unit.update_discrete_states();
    *iterate = outcome.iterate;
    *terminate = outcome.terminate;
    *nominals_changed = fmi3False;
    *values_changed = fmi3False;
    *next_defined = outcome.next_event.has_value();
    *next = stride::to_seconds(outcome.next_event.value_or(Time{}));
    return fmi3OK;
  });
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference references[],
                                    size_t count, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t size) {
  return call(instance, Function::GetOutputDerivatives, [&](Instance& unit) {
    unit.get_output_derivatives(references, count, orders, values, size);
    return fmi3OK;
  });
}

// ---- Values ----

namespace {

// What is not the copy of one number is done by functions of their own, so that the copy needs no
// stack frame.

template <Type kType, class T>
[[gnu::noinline]] fmi3Status get_any(fmi3Instance instance, Function function,
                                     const fmi3ValueReference references[], size_t count,
                                     T values[], size_t size) {
  return call(instance, function, [&](Instance& unit) {
    unit.get<kType>(references, count, values, size);
    return fmi3OK;
  });
}

template <Type kType, class T>
[[gnu::noinline]] fmi3Status set_any(fmi3Instance instance, Function function,
                                     const fmi3ValueReference references[], size_t count,
                                     const T values[], size_t size) {
  return call(instance, function, [&](Instance& unit) {
    unit.set<kType>(references, count, values, size);
    return fmi3OK;
  });
}

template <Type kType, class T>
fmi3Status get(fmi3Instance instance, Function function, const fmi3ValueReference references[],
               size_t count, T values[], size_t size) {
  const auto* const unit = static_cast<const Instance*>(instance);
  const bool is_done = unit != nullptr && unit->get_number<kType>(references, count, values, size);
  return is_done ? fmi3OK : get_any<kType>(instance, function, references, count, values, size);
}

template <Type kType, class T>
fmi3Status set(fmi3Instance instance, Function function, const fmi3ValueReference references[],
               size_t count, const T values[], size_t size) {
  auto* const unit = static_cast<Instance*>(instance);
  const bool is_done = unit != nullptr && unit->set_number<kType>(references, count, values, size);
  return is_done ? fmi3OK : set_any<kType>(instance, function, references, count, values, size);
}

}  // namespace

#define STRIDE_ACCESS(T)                                                              \
  fmi3Status fmi3Get##T(fmi3Instance instance, const fmi3ValueReference references[], \
                        size_t count, fmi3##T values[], size_t size) {                \
    return get<Type::T>(instance, Function::Get##T, references, count, values, size); \
  }                                                                                   \
  fmi3Status fmi3Set##T(fmi3Instance instance, const fmi3ValueReference references[], \
                        size_t count, const fmi3##T values[], size_t size) {          \
    return set<Type::T>(instance, Function::Set##T, references, count, values, size); \
  }
FMI3_VALUE_TYPES(STRIDE_ACCESS)
#undef STRIDE_ACCESS

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                         size_t sizes[], fmi3Binary values[], size_t size) {
  return call(instance, Function::GetBinary, [&](Instance& unit) {
    unit.get_binary(references, count, sizes, values, size);
    return fmi3OK;
  });
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                         const size_t sizes[], const fmi3Binary values[], size_t size) {
  return call(instance, Function::SetBinary, [&](Instance& unit) {
    unit.set_binary(references, count, sizes, values, size);
    return fmi3OK;
  });
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                        fmi3Clock values[]) {
  return call(instance, Function::GetClock, [&](Instance& unit) {
    unit.get<Type::Clock>(references, count, values, count);
    return fmi3OK;
  });
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                        const fmi3Clock values[]) {
  return call(instance, Function::SetClock, [&](Instance& unit) {
    unit.set<Type::Clock>(references, count, values, count);
    return fmi3OK;
  });
}

// ---- State ----

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return call(instance, Function::GetFMUState, [&](Instance& unit) {
    auto fresh = *state == nullptr ? std::make_unique<SavedState>() : nullptr;
    unit.save(fresh ? *fresh : *static_cast<SavedState*>(*state));
    if (fresh) *state = fresh.release();
    return fmi3OK;
  });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return call(instance, Function::SetFMUState, [&](Instance& unit) {
    if (state == nullptr) throw Misuse("the state is NULL");
    unit.restore(*static_cast<SavedState*>(state));
    return fmi3OK;
  });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return call(instance, Function::FreeFMUState, [&](Instance&) {
    if (state == nullptr) return fmi3OK;
    delete static_cast<SavedState*>(*state);
    *state = nullptr;
    return fmi3OK;
  });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t* size) {
  return call(instance, Function::SerializedFMUStateSize, [&](Instance& unit) {
    if (state == nullptr) throw Misuse("the state is NULL");
    *size = unit.serialized_size(*static_cast<SavedState*>(state));
    return fmi3OK;
  });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size) {
  return call(instance, Function::SerializeFMUState, [&](Instance& unit) {
    if (state == nullptr) throw Misuse("the state is NULL");
    const auto& saved = *static_cast<SavedState*>(state);
    if (size < unit.serialized_size(saved)) throw Misuse("the buffer is too small");
    unit.serialize(saved, bytes);
    return fmi3OK;
  });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState* state) {
  return call(instance, Function::DeserializeFMUState, [&](Instance& unit) {
    auto fresh = *state == nullptr ? std::make_unique<SavedState>() : nullptr;
    unit.deserialize(bytes, size, fresh ? *fresh : *static_cast<SavedState*>(*state));
    if (fresh) *state = fresh.release();
    return fmi3OK;
  });
}

// ---- What a Co-Simulation unit of this kit does not have ----

#define STRIDE_UNSUPPORTED(name, why, ...)                    \
  fmi3Status fmi3##name(fmi3Instance instance, __VA_ARGS__) { \
    return unsupported(instance, Function::name, why);        \
  }
STRIDE_UNSUPPORTED(GetNumberOfVariableDependencies, kNoDependencies, fmi3ValueReference, size_t*)
STRIDE_UNSUPPORTED(GetVariableDependencies, kNoDependencies, fmi3ValueReference, size_t[],
                   fmi3ValueReference[], size_t[], fmi3DependencyKind[], size_t)
STRIDE_UNSUPPORTED(GetDirectionalDerivative, kNoDerivatives, const fmi3ValueReference[], size_t,
                   const fmi3ValueReference[], size_t, const fmi3Float64[], size_t, fmi3Float64[],
                   size_t)
STRIDE_UNSUPPORTED(GetAdjointDerivative, kNoDerivatives, const fmi3ValueReference[], size_t,
                   const fmi3ValueReference[], size_t, const fmi3Float64[], size_t, fmi3Float64[],
                   size_t)
STRIDE_UNSUPPORTED(CompletedIntegratorStep, kModelExchange, fmi3Boolean, fmi3Boolean*, fmi3Boolean*)
STRIDE_UNSUPPORTED(SetTime, kModelExchange, fmi3Float64)
STRIDE_UNSUPPORTED(SetContinuousStates, kModelExchange, const fmi3Float64[], size_t)
STRIDE_UNSUPPORTED(GetContinuousStateDerivatives, kModelExchange, fmi3Float64[], size_t)
STRIDE_UNSUPPORTED(GetEventIndicators, kModelExchange, fmi3Float64[], size_t)
STRIDE_UNSUPPORTED(GetContinuousStates, kModelExchange, fmi3Float64[], size_t)
STRIDE_UNSUPPORTED(GetNominalsOfContinuousStates, kModelExchange, fmi3Float64[], size_t)
STRIDE_UNSUPPORTED(GetNumberOfEventIndicators, kModelExchange, size_t*)
STRIDE_UNSUPPORTED(GetNumberOfContinuousStates, kModelExchange, size_t*)
STRIDE_UNSUPPORTED(ActivateModelPartition, kScheduled, fmi3ValueReference, fmi3Float64)
#undef STRIDE_UNSUPPORTED

#define STRIDE_UNSUPPORTED(name, why)                  \
  fmi3Status fmi3##name(fmi3Instance instance) {       \
    return unsupported(instance, Function::name, why); \
  }
STRIDE_UNSUPPORTED(EnterConfigurationMode, kNoStructure)
STRIDE_UNSUPPORTED(ExitConfigurationMode, kNoStructure)
STRIDE_UNSUPPORTED(EvaluateDiscreteStates, kNoEvaluation)
STRIDE_UNSUPPORTED(EnterContinuousTimeMode, kModelExchange)
#undef STRIDE_UNSUPPORTED
