// Which FMI function may be called in which state of a Co-Simulation unit (FMI 3.0, 2.3 and 4.2),
// and which of <stride/idle.h> and <stride/describe.h>.
#ifndef STRIDE_INTERFACES_UNIT_LEGAL_CALLS_H
#define STRIDE_INTERFACES_UNIT_LEGAL_CALLS_H

#include <array>
#include <cstddef>
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

namespace detail {

inline constexpr std::size_t kFunctionCount = 0
#define STRIDE_ONE(name) +1
    FMI3_FUNCTIONS(STRIDE_ONE) STRIDE_IDLE_FUNCTIONS(STRIDE_ONE)
        STRIDE_DESCRIBE_FUNCTIONS(STRIDE_ONE)
#undef STRIDE_ONE
    ;

inline constexpr std::uint8_t kInitialized = EventMode | StepMode;
inline constexpr std::uint8_t kSetting = Instantiated | InitializationMode | kInitialized;
inline constexpr std::uint8_t kAny = kSetting | Terminated;

struct Rule {
  Function function;
  std::uint8_t modes;
};

inline constexpr Rule kRules[] = {
    {Function::SetDebugLogging, kAny},
    {Function::FreeInstance, kAny},
    {Function::Reset, kAny},

    {Function::EnterInitializationMode, Instantiated},
    {Function::ExitInitializationMode, InitializationMode},
    {Function::EnterEventMode, StepMode},
    {Function::EnterStepMode, EventMode},
    {Function::DoStep, StepMode},
    {Function::UpdateDiscreteStates, EventMode},
    {Function::Terminate, kInitialized},

    {Function::GetFloat32, kAny},
    {Function::GetFloat64, kAny},
    {Function::GetInt8, kAny},
    {Function::GetUInt8, kAny},
    {Function::GetInt16, kAny},
    {Function::GetUInt16, kAny},
    {Function::GetInt32, kAny},
    {Function::GetUInt32, kAny},
    {Function::GetInt64, kAny},
    {Function::GetUInt64, kAny},
    {Function::GetBoolean, kAny},
    {Function::GetString, kAny},
    {Function::GetBinary, kAny},
    {Function::GetClock, InitializationMode | EventMode},
    {Function::GetOutputDerivatives, StepMode | Terminated},

    {Function::SetFloat32, kSetting | IntermediateUpdateMode},
    {Function::SetFloat64, kSetting | IntermediateUpdateMode},
    {Function::SetInt8, kSetting},
    {Function::SetUInt8, kSetting},
    {Function::SetInt16, kSetting},
    {Function::SetUInt16, kSetting},
    {Function::SetInt32, kSetting},
    {Function::SetUInt32, kSetting},
    {Function::SetInt64, kSetting},
    {Function::SetUInt64, kSetting},
    {Function::SetBoolean, kSetting},
    {Function::SetString, kSetting},
    {Function::SetBinary, kSetting},
    {Function::SetClock, EventMode},

    {Function::GetIntervalDecimal, InitializationMode | EventMode},
    {Function::GetIntervalFraction, InitializationMode | EventMode},
    {Function::GetShiftDecimal, InitializationMode},
    {Function::GetShiftFraction, InitializationMode},
    {Function::SetIntervalDecimal, InitializationMode | EventMode},
    {Function::SetIntervalFraction, InitializationMode | EventMode},
    {Function::SetShiftDecimal, InitializationMode},
    {Function::SetShiftFraction, InitializationMode},

    {Function::GetFMUState, kAny},
    {Function::SetFMUState, kAny},
    {Function::FreeFMUState, kAny},
    {Function::SerializedFMUStateSize, kAny},
    {Function::SerializeFMUState, kAny},
    {Function::DeserializeFMUState, kAny},

    {Function::EnableIdleSkipping, Instantiated},
    {Function::SetIdleTolerances, Instantiated},
    {Function::GetIdlePromise, StepMode},

    {Function::DescribeMessage, kAny},
};

inline constexpr auto kLegalModes = [] {
  std::array<std::uint8_t, kFunctionCount> table{};
  for (const Rule& rule : kRules) table[static_cast<std::size_t>(rule.function)] = rule.modes;
  return table;
}();

}  // namespace detail

/// The states in which the function may be called; 0 where a Co-Simulation unit of this kit never
/// supports it.
constexpr std::uint8_t legal_modes(Function function) {
  return detail::kLegalModes[static_cast<std::size_t>(function)];
}

/// As it is exported: "fmi3DoStep", "strideGetIdlePromise".
const char* name(Function function);

/// The names of the states in a mask, for messages: "Instantiated or Step Mode".
std::string mode_names(std::uint8_t modes);

}  // namespace stride::kit

#endif
