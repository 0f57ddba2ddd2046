#include "master/verify/checks.h"

namespace stride::verify {

const char* name(Verdict verdict) {
  constexpr const char* kNames[] = {"passed", "FAILED", "skipped"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const std::vector<UnitCheck>& checks() {
  static const std::vector<UnitCheck> checks = {
      {"load", "the library loads, has the functions that are declared, and unloads", &check_load},
      {"description", "the model description is complete and agrees with itself",
       &check_description},
      {"values", "start values are what the unit has, and values stay within min and max",
       &check_values},
      {"dependencies", "an output does not depend on an input that is declared to be none of its",
       &check_dependencies},
      {"events", "Event Mode, early returns and next events are as declared", &check_events},
      {"calls", "a whole life in order works; calls out of order are refused", &check_calls},
      {"messages", "what the unit says of messages is text, and saying it changes nothing",
       &check_messages},
      {"splitting", "steps may be split, where the unit says so", &check_splitting},
      {"rejection", "a rejected step leaves the unit as it was", &check_rejection},
      {"reset", "after a reset the unit is like a new one", &check_reset},
      {"instances", "instances in one process do not disturb each other", &check_instances},
      {"restore", "a restored state goes on as the saved one did", &check_restore},
      {"serialization", "a state goes on from its bytes, also in another process",
       &check_serialization},
      {"memory", "neither memory nor files nor threads are left behind", &check_memory},
      {"determinism", "two processes get the same bits", &check_determinism},
  };
  return checks;
}

}  // namespace stride::verify
