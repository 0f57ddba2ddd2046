// An OpenGL context without a window, from a library that is looked for when it is needed: nothing
// here links OpenGL.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_OFF_SCREEN_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_OFF_SCREEN_H

#include <functional>
#include <memory>

namespace mujoco_world::film {

/// Used by one thread at a time.
class OffScreen {
 public:
  OffScreen() = default;
  virtual ~OffScreen() = default;
  OffScreen(const OffScreen&) = delete;
  OffScreen& operator=(const OffScreen&) = delete;

  /// Does the work with this context current in the calling thread. Whatever context of the same
  /// library was current there before is so again afterwards, also where the work throws. Throws
  /// std::runtime_error if the context cannot be made current.
  virtual void with(const std::function<void()>& work) = 0;
};

/// A context of OSMesa, which draws the same on every machine, or else of EGL, without a display.
/// The environment variable MUJOCO_GL chooses one, as it does for MuJoCo's Python package:
/// `osmesa`, `egl`, or `disable` for none. All contexts of a process are of one kind, because
/// MuJoCo looks for OpenGL's functions once. Throws std::runtime_error with what was tried, why it
/// did not work and which packages there are.
std::unique_ptr<OffScreen> make_off_screen();

/// One kind each; throw std::runtime_error with the reason if there is no such context.
std::unique_ptr<OffScreen> make_osmesa();
std::unique_ptr<OffScreen> make_egl();

}  // namespace mujoco_world::film

#endif
