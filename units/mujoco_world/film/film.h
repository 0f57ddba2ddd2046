// A world's film: pictures at the multiples of an interval.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_FILM_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_FILM_H

#include <filesystem>

#include <stride/time.h>

#include "units/mujoco_world/film/frames.h"
#include "units/mujoco_world/film/renderer.h"
#include "units/mujoco_world/model.h"

namespace mujoco_world::film {

struct FilmSettings {
  stride::Duration interval{};  ///< 0: no film
  View view;

  friend bool operator==(const FilmSettings& a, const FilmSettings& b) {
    return a.interval == b.interval && a.view == b.view;
  }
};

/// Its frames are of the instants k * interval, k whole, from its beginning on, so they do not
/// depend on the steps that the world is moved by.
class Film {
 public:
  /// Takes the picture of the world's present, if it is one of the instants. `world` must outlive
  /// it. Throws std::invalid_argument for an interval that is not positive, and as Renderer and
  /// Frames do.
  Film(const World& world, const FilmSettings& settings, const std::filesystem::path& folder);

  const FilmSettings& settings() const { return settings_; }

  /// Moves the world as World::advance() does, and takes the pictures on the way. Throws as that
  /// and Renderer and Frames do.
  bool advance(World& world, stride::Time to, bool stops_at_contacts = false);

  /// The world was set to another state: drops the pictures of what is not yet, and takes that of
  /// the present where there is none.
  void go_on();

 private:
  void take();

  const World& world_;
  FilmSettings settings_;
  Renderer renderer_;
  Frames frames_;
  stride::Time next_;
};

}  // namespace mujoco_world::film

#endif
