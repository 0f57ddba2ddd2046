#include "interfaces/unit/legal_calls.h"

#include <utility>

namespace stride::kit {

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
