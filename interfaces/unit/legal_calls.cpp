#include "interfaces/unit/legal_calls.h"

#include <array>

namespace stride::kit {
namespace {

constexpr std::size_t kFunctionCount = 0
#define STRIDE_ONE(name) +1
    FMI3_FUNCTIONS(STRIDE_ONE) STRIDE_IDLE_FUNCTIONS(STRIDE_ONE)
        STRIDE_DESCRIBE_FUNCTIONS(STRIDE_ONE)
#undef STRIDE_ONE
    ;

constexpr std::uint8_t kInitialized = EventMode | StepMode;
constexpr std::uint8_t kSetting = Instantiated | InitializationMode | kInitialized;
constexpr std::uint8_t kAny = kSetting | Terminated;

struct Rule {
  Function function;
  std::uint8_t modes;
};

constexpr Rule kRules[] = {
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

constexpr auto kLegalModes = [] {
  std::array<std::uint8_t, kFunctionCount> table{};
  for (const Rule& rule : kRules) table[static_cast<std::size_t>(rule.function)] = rule.modes;
  return table;
}();

}  // namespace

std::uint8_t legal_modes(Function function) {
  return kLegalModes[static_cast<std::size_t>(function)];
}

const char* name(Function function) {
  static constexpr const char* kNames[] = {
#define STRIDE_NAME(name) "fmi3" #name,
      FMI3_FUNCTIONS(STRIDE_NAME)
#undef STRIDE_NAME
#define STRIDE_NAME(name) "stride" #name,
          STRIDE_IDLE_FUNCTIONS(STRIDE_NAME) STRIDE_DESCRIBE_FUNCTIONS(STRIDE_NAME)
#undef STRIDE_NAME
  };
  return kNames[static_cast<std::size_t>(function)];
}

std::string mode_names(std::uint8_t modes) {
  constexpr std::pair<Mode, const char*> kNames[] = {
      {Instantiated, "Instantiated"}, {InitializationMode, "Initialization Mode"},
      {EventMode, "Event Mode"},      {StepMode, "Step Mode"},
      {Terminated, "Terminated"},     {IntermediateUpdateMode, "Intermediate Update Mode"},
  };
  std::string text;
  for (const auto& [mode, mode_name] : kNames) {
    if ((modes & mode) == 0) continue;
    if (!text.empty()) text += " or ";
    text += mode_name;
  }
  return text;
}

}  // namespace stride::kit
