// A world's film: pictures at the multiples of an interval.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_FILM_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_FILM_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

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
  /// It begins with begin() or the first advance(). `world` must outlive it. Throws
  /// std::invalid_argument for an interval that is not positive, and as Renderer and Frames do.
  Film(const World& world, const FilmSettings& settings, const std::filesystem::path& folder);

  const FilmSettings& settings() const { return settings_; }

  /// Replaces the film that may be in the folder, and takes the picture of the world's present, if
  /// it is one of the instants. Does nothing where it has begun.
  void begin();

  /// The lamps are from the world's present on as they are now: the picture of the present, if it
  /// is there and shows them otherwise, is taken again.
  void show_lamps();

  /// Moves the world as World::advance() does, with its lamps as they are now, and takes the
  /// pictures on the way. Throws as that and Renderer and Frames do.
  bool advance(World& world, stride::Time to, bool stops_at_contacts = false);

  /// How many pictures there are; nothing where it has not begun.
  std::optional<std::size_t> pictures() const;

  /// The world was set to the state of an instant at which the film was as pictures() told: drops
  /// the pictures of what is not yet, and takes that of the present where there is none. Where the
  /// state is that of another process, the film is in the folder; false if it lacks pictures.
  bool go_on(std::optional<std::size_t> pictures);

 private:
  std::vector<std::uint8_t> draw();
  void take();
  void continue_from_present();

  const World& world_;
  FilmSettings settings_;
  Renderer renderer_;
  Frames frames_;
  bool has_begun_ = false;
  stride::Time next_;
  /// The lamps that shine in the last picture; nothing where that is not known.
  std::optional<std::vector<int>> shown_;
};

}  // namespace mujoco_world::film

#endif
