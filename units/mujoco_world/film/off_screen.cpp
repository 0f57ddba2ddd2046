#include "units/mujoco_world/film/off_screen.h"

#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string>

namespace mujoco_world::film {
namespace {

struct Kind {
  const char* name;
  const char* title;
  std::unique_ptr<OffScreen> (*make)();
};

constexpr Kind kKinds[] = {{"osmesa", "OSMesa", &make_osmesa}, {"egl", "EGL", &make_egl}};
constexpr const char* kHelp =
    "; Debian's package libosmesa6 has the one, libegl1 with libegl-mesa0 the other; without "
    "pictures the world runs with film.interval 0";

std::string wanted_kind() {
  const char* const wanted = std::getenv("MUJOCO_GL");
  return wanted != nullptr ? wanted : "";
}

/// A setting for the process as long as this object lives, unless the user has made it.
class Setting {
 public:
  Setting(const char* name, const char* value)
      : name_(name), is_new_(std::getenv(name) == nullptr) {
    if (is_new_) ::setenv(name, value, 1);
  }
  ~Setting() {
    if (is_new_) ::unsetenv(name_);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  bool is_new_;
};

std::unique_ptr<OffScreen> find(const Kind*& found) {
  const std::string wanted = wanted_kind();
  std::string reasons;
  for (const Kind& kind : kKinds) {
    if (!wanted.empty() && wanted != kind.name) continue;
    try {
      auto screen = kind.make();
      found = &kind;
      return screen;
    } catch (const std::runtime_error& error) {
      reasons +=
          (reasons.empty() ? "" : ", ") + std::string(kind.title) + " (" + error.what() + ")";
    }
  }
  if (reasons.empty()) {
    throw std::runtime_error("no pictures are drawn, for the environment variable MUJOCO_GL is '" +
                             wanted + "': expected 'osmesa', 'egl' or none");
  }
  throw std::runtime_error("there is no OpenGL to draw pictures with: tried " + reasons + kHelp);
}

}  // namespace

std::unique_ptr<OffScreen> make_off_screen() {
  static std::mutex mutex;
  static const Kind* chosen = nullptr;
  const std::lock_guard lock(mutex);
  // Mesa draws in the calling thread, so that the process can be forked, and leaves no files behind
  const Setting threads("LP_NUM_THREADS", "0");
  const Setting cache("MESA_SHADER_CACHE_DISABLE", "true");
  if (chosen != nullptr) return chosen->make();
  return find(chosen);
}

}  // namespace mujoco_world::film
