// The self-description of a library, without an instance.
#include <exception>
#include <string>

#include "interfaces/unit/entry_call.h"
#include "interfaces/unit/idle_manifest.h"
#include "interfaces/unit/model_description.h"

namespace {

/// The text that `describe` makes of a fresh unit; on failure NULL, and *error holds the reason.
template <class Describe>
const char* self_description(const char* resources, const char** error, Describe describe) {
  thread_local std::string text;
  const auto keep = [](const char* message) noexcept {
    try {
      return (text = message).c_str();
    } catch (...) {
      return "out of memory";
    }
  };
  try {
    const stride::UnitFactory factory = stride::unit_factory();
    double time = 0;
    const auto unit = factory.make({resources != nullptr ? resources : "", factory.name});
    text = describe(factory.name, *unit, stride::kit::Table(*unit, time));
    return text.c_str();
  } catch (const std::exception& failure) {
    *error = keep(failure.what());
  } catch (...) {
    *error = "the unit's constructor threw something that is not a std::exception";
  }
  return nullptr;
}

}  // namespace

const char* strideModelDescription(const char* resources, const char** error) {
  return self_description(resources, error, &stride::kit::model_description);
}

const char* strideIdleManifest(const char* resources, const char** error) {
  return self_description(
      resources, error, [](const char*, const stride::Unit& unit, const stride::kit::Table& table) {
        return stride::kit::idle_manifest(unit, table);
      });
}
