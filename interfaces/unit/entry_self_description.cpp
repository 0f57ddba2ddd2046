// The self-description of a library, without an instance.
#include <exception>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "interfaces/unit/entry_call.h"
#include "interfaces/unit/idle_manifest.h"
#include "interfaces/unit/model_description.h"

namespace {

/// That of the calling thread. Not thread_local: what is destroyed when a thread ends would keep
/// the library loaded until then.
std::string& text_of_thread() {
  static std::mutex mutex;
  static std::map<std::thread::id, std::string> texts;
  const std::lock_guard lock(mutex);
  return texts[std::this_thread::get_id()];
}

/// The text that `describe` makes of a fresh unit; on failure NULL, and *error holds the reason.
template <class Describe>
const char* self_description(const char* resources, const char** error, Describe describe) {
  const auto keep = [](const char* message) noexcept {
    try {
      return (text_of_thread() = message).c_str();
    } catch (...) {
      return "out of memory";
    }
  };
  try {
    const stride::UnitFactory factory = stride::unit_factory();
    double time = 0;
    const auto unit = factory.make({resources != nullptr ? resources : "", factory.name});
    std::string& text = text_of_thread();
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
