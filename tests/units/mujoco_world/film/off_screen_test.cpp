#include "units/mujoco_world/film/off_screen.h"

#include <cstdlib>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <dlfcn.h>

#include "tests/units/mujoco_world/film/scene.h"
#include "units/mujoco_world/film/library.h"

using Catch::Matchers::Contains;
using mujoco_world::film::Library;
using mujoco_world::film::make_off_screen;
using mujoco_world::film::OffScreen;

namespace {

/// Of a library that is loaded already.
void* call(const char* library, const char* function) {
  void* const handle = ::dlopen(library, RTLD_NOW | RTLD_NOLOAD);
  if (handle == nullptr) return nullptr;
  return reinterpret_cast<void* (*)()>(::dlsym(handle, function))();
}

/// What the calling thread draws with, of whichever kind.
void* current() {
  void* const osmesa = call("libOSMesa.so.8", "OSMesaGetCurrentContext");
  return osmesa != nullptr ? osmesa : call("libEGL.so.1", "eglGetCurrentContext");
}

struct Environment {
  explicit Environment(const char* value) { ::setenv("MUJOCO_GL", value, 1); }
  ~Environment() { ::unsetenv("MUJOCO_GL"); }
};

}  // namespace

// first: later the kind is chosen
TEST_CASE("pictures can be forbidden, with a message") {
  const Environment environment("disable");
  CHECK_THROWS_WITH(make_off_screen(), Contains("MUJOCO_GL is 'disable'") && Contains("'osmesa'"));
}

TEST_CASE("a library that is missing is named, by the loader's own words") {
  CHECK_THROWS_WITH(Library({"libno_such_thing.so.1", "libno_other.so"}),
                    Contains("libno_such_thing.so.1: cannot open shared object file"));
  void (*function)() = nullptr;
  CHECK_THROWS_WITH(Library({"libm.so.6"}).find("no_such_function", function),
                    Contains("no_such_function"));
}

TEST_CASE("contexts are current for their work only, and nest") {
  if (scene::lacks_open_gl()) return;
  const auto one = make_off_screen();
  const auto other = make_off_screen();
  CHECK(current() == nullptr);
  one->with([&] {
    void* const outer = current();
    CHECK(outer != nullptr);
    other->with([&] {
      CHECK(current() != nullptr);
      CHECK(current() != outer);
    });
    CHECK(current() == outer);
    CHECK_THROWS_AS(other->with([] { throw std::invalid_argument("work"); }),
                    std::invalid_argument);
    CHECK(current() == outer);
  });
  CHECK(current() == nullptr);
}

TEST_CASE("each kind that there is gives a context") {
  if (scene::lacks_open_gl()) return;
  int kinds = 0;
  for (const auto make : {&mujoco_world::film::make_osmesa, &mujoco_world::film::make_egl}) {
    std::unique_ptr<OffScreen> screen;
    try {
      screen = make();
    } catch (const std::runtime_error& error) {
      WARN("one kind less: " << error.what());
      continue;
    }
    ++kinds;
    bool is_done = false;
    screen->with([&] { is_done = current() != nullptr; });
    CHECK(is_done);
    CHECK(current() == nullptr);
  }
  CHECK(kinds > 0);
}
