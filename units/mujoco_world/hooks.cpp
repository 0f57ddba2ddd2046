#include "units/mujoco_world/hooks.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

namespace mujoco_world {
namespace {

using Hook = void (*)(const char*);

constexpr std::size_t kMostWarnings = 100;
// Of the calling thread, null for none. No object: one that has to be destroyed when its thread
// ends would keep this library loaded until then.
thread_local std::vector<std::string>* warnings = nullptr;

void throw_error(const char* message) { throw std::runtime_error(message); }

void keep_warning(const char* message) { add_warning(message); }

// MuJoCo reads the hooks as plain variables; the atomic access orders our own threads.
void install(Hook& hook, Hook ours) {
  if (__atomic_load_n(&hook, __ATOMIC_RELAXED) != ours) {
    __atomic_store_n(&hook, ours, __ATOMIC_RELAXED);
  }
}

// No hook may outlive the library that holds it, when that is unloaded before MuJoCo.
struct RemoveAtUnload {
  ~RemoveAtUnload() {
    if (mju_user_error == &throw_error) mju_user_error = nullptr;
    if (mju_user_warning == &keep_warning) mju_user_warning = nullptr;
  }
};

}  // namespace

void install_hooks() {
  static const RemoveAtUnload remove_at_unload;
  install(mju_user_error, &throw_error);
  install(mju_user_warning, &keep_warning);
}

void add_warning(std::string warning) {
  if (warnings == nullptr) warnings = new std::vector<std::string>;
  if (warnings->size() < kMostWarnings) warnings->push_back(std::move(warning));
}

std::vector<std::string> take_warnings() {
  const std::unique_ptr<std::vector<std::string>> taken(std::exchange(warnings, nullptr));
  return taken ? std::move(*taken) : std::vector<std::string>{};
}

}  // namespace mujoco_world
