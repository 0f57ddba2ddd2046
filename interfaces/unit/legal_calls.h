// Which FMI function may be called in which state of a Co-Simulation unit (FMI 3.0, 2.3 and 4.2),
// and which of <stride/idle.h> and <stride/describe.h>.
#ifndef STRIDE_INTERFACES_UNIT_LEGAL_CALLS_H
#define STRIDE_INTERFACES_UNIT_LEGAL_CALLS_H

#include <cstdint>
#include <string>

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>

namespace stride::kit {

enum class Function : std::uint8_t {
#define STRIDE_NAME(name) name,
  FMI3_FUNCTIONS(STRIDE_NAME) STRIDE_IDLE_FUNCTIONS(STRIDE_NAME)
      STRIDE_DESCRIBE_FUNCTIONS(STRIDE_NAME)
#undef STRIDE_NAME
};

/// The states of the standard, as bits, so that a set of states is a mask.
enum Mode : std::uint8_t {
  Instantiated = 1,
  InitializationMode = 2,
  EventMode = 4,
  StepMode = 8,
  Terminated = 16,
  IntermediateUpdateMode = 32,
};

/// The states in which the function may be called; 0 where a Co-Simulation unit of this kit never
/// supports it.
std::uint8_t legal_modes(Function function);

/// As it is exported: "fmi3DoStep", "strideGetIdlePromise".
const char* name(Function function);

/// The names of the states in a mask, for messages: "Instantiated or Step Mode".
std::string mode_names(std::uint8_t modes);

}  // namespace stride::kit

#endif
