// MuJoCo's own drawing, into pictures.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_RENDERER_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_RENDERER_H

#include <memory>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "units/mujoco_world/display.h"
#include "units/mujoco_world/film/off_screen.h"
#include "units/mujoco_world/film/picture.h"

namespace mujoco_world::film {

struct View {
  int width = 320;  ///< [pixel]
  int height = 240;
  /// One of the model's cameras; if empty the one called `film` or, without such a one, a free
  /// camera that has the whole model in its picture (mjv_defaultFreeCamera).
  std::string camera;

  friend bool operator==(const View& a, const View& b) {
    return a.width == b.width && a.height == b.height && a.camera == b.camera;
  }
};

/// Draws one model. The same state gives the same picture; where nothing is seen to have changed,
/// it is not drawn again. Not thread-safe, but each thread may have its own.
class Renderer {
 public:
  /// Throws std::runtime_error if there is no such camera, with those that there are, and as
  /// make_off_screen() does.
  Renderer(const mjModel& model, const View& view);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// `data` has the poses of all that is to be seen (World::drawn()). Lamps that shine have their
  /// hue at full brightness, whatever light falls on them, and a halo; fields are translucent, in
  /// the colours of their sites. The picture is valid until the next call. Throws
  /// std::runtime_error if OpenGL fails.
  const Picture& draw(const mjModel& model, mjData& data, const Display& display = {});

 private:
  /// What goes into a picture, but for skins and other deformable surfaces.
  struct Sight {
    std::vector<mjvGeom> geoms;
    std::vector<mjvLight> lights;
    mjvGLCamera camera{};
  };

  void make(const mjModel& model);
  void light_up(const mjModel& model, const std::vector<int>& shining);
  void add(const mjvGeom& geom);
  bool is_unchanged(const mjModel& model);
  void read_pixels();

  mjvCamera camera_{};
  mjvOption options_{};
  mjvScene scene_{};
  mjrContext context_{};
  mjrRect frame_{};
  Sight sight_;  ///< in the picture
  Picture picture_;
  std::unique_ptr<OffScreen> screen_;
};

}  // namespace mujoco_world::film

#endif
