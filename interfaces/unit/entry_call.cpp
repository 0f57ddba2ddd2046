#include "interfaces/unit/entry_call.h"

#include <exception>
#include <string>

namespace stride::kit {

void report(const Importer& importer, Function function, const char* text,
            fmi3Status status) noexcept {
  try {
    importer.message(status, LogErrors, std::string(name(function)) + ": " + text);
  } catch (...) {
  }
}

void refuse_call(const Instance& instance, Function function) {
  throw Misuse("not allowed in " + mode_names(instance.mode()) + ", only in " +
               mode_names(legal_modes(function)));
}

fmi3Status report_failure(Instance& instance, Function function) noexcept {
  try {
    throw;
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

}  // namespace stride::kit
