// What the exported functions have in common: the check that they are legal now, and the turning of
// an exception into fmi3Error and a message, so that none crosses.
#ifndef STRIDE_INTERFACES_UNIT_ENTRY_CALL_H
#define STRIDE_INTERFACES_UNIT_ENTRY_CALL_H

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>
#include <stride/self_description.h>

#include "interfaces/unit/instance.h"

extern "C" {
#define STRIDE_EXPORT(name) __attribute__((visibility("default"))) fmi3##name##TYPE fmi3##name;
FMI3_FUNCTIONS(STRIDE_EXPORT)
#undef STRIDE_EXPORT
#define STRIDE_EXPORT(name) __attribute__((visibility("default"))) stride##name##TYPE stride##name;
STRIDE_IDLE_FUNCTIONS(STRIDE_EXPORT)
STRIDE_DESCRIBE_FUNCTIONS(STRIDE_EXPORT)
STRIDE_EXPORT(ModelDescription)
STRIDE_EXPORT(IdleManifest)
#undef STRIDE_EXPORT
}

namespace stride::kit {

/// The last thing that a failing call does, so it must not fail itself, be it for lack of memory or
/// because the importer's callback throws.
void report(const Importer& importer, Function function, const char* text,
            fmi3Status status = fmi3Error) noexcept;

/// Throws the Misuse that the function is not legal in the present state of the instance.
[[noreturn]] void refuse_call(const Instance& instance, Function function);

/// Reports the exception that is being handled. A failure in a function that runs the unit's own
/// code ends the simulation of this instance; a misuse by the importer changes nothing.
fmi3Status report_failure(Instance& instance, Function function) noexcept;

/// Runs body(instance) where the function is legal.
template <class Body>
fmi3Status call(fmi3Instance handle, Function function, Body&& body) {
  if (handle == nullptr) return fmi3Error;
  Instance& instance = *static_cast<Instance*>(handle);
  try {
    if ((legal_modes(function) & instance.mode()) == 0) refuse_call(instance, function);
    return body(instance);
  } catch (...) {
    return report_failure(instance, function);
  }
}

inline fmi3Status unsupported(fmi3Instance handle, Function function, const char* why) {
  if (handle != nullptr) report(static_cast<Instance*>(handle)->importer(), function, why);
  return fmi3Error;
}

}  // namespace stride::kit

#endif
