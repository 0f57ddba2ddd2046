// What the exported functions have in common: the check that they are legal now, and the turning of
// an exception into fmi3Error and a message, so that none crosses.
#ifndef STRIDE_INTERFACES_UNIT_ENTRY_CALL_H
#define STRIDE_INTERFACES_UNIT_ENTRY_CALL_H

#include <exception>
#include <string>

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
inline void report(const Importer& importer, Function function, const char* text,
                   fmi3Status status = fmi3Error) noexcept {
  try {
    importer.message(status, LogErrors, std::string(name(function)) + ": " + text);
  } catch (...) {
  }
}

/// Runs body(instance) where the function is legal. A failure in a function that runs the unit's
/// own code ends the simulation of this instance; a misuse by the importer changes nothing.
template <class Body>
fmi3Status call(fmi3Instance handle, Function function, Body&& body) {
  if (handle == nullptr) return fmi3Error;
  Instance& instance = *static_cast<Instance*>(handle);
  try {
    const std::uint8_t legal = legal_modes(function);
    if ((legal & instance.mode()) == 0) {
      throw Misuse("not allowed in " + mode_names(instance.mode()) + ", only in " +
                   mode_names(legal));
    }
    return body(instance);
  } catch (const Misuse& misuse) {
    report(instance.importer(), function, misuse.what());
  } catch (const std::exception& failure) {
    instance.fail();
    report(instance.importer(), function, failure.what());
  } catch (...) {
    instance.fail();
    report(instance.importer(), function, "the unit threw something that is not a std::exception");
  }
  return fmi3Error;
}

inline fmi3Status unsupported(fmi3Instance handle, Function function, const char* why) {
  if (handle != nullptr) report(static_cast<Instance*>(handle)->importer(), function, why);
  return fmi3Error;
}

}  // namespace stride::kit

#endif
