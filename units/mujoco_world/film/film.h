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
#include "units/mujoco_world/recording.h"

namespace mujoco_world::film {

struct FilmSettings {
  stride::Duration interval{};  ///< 0: no film
  View view;

  friend bool operator==(const FilmSettings& a, const FilmSettings& b) {
    return a.interval == b.interval && a.view == b.view;
  }
};

/// Pictures of the multiples of the interval, as files.
class Film : public Recording {
 public:
  /// `world` must outlive it. Throws
  /// std::invalid_argument for an interval that is not positive, and as Renderer and Frames do.
  Film(const World& world, const FilmSettings& settings, const std::filesystem::path& folder);

  const FilmSettings& settings() const { return settings_; }

  /// The picture of the present is taken if that is one of the instants.
  void begin() override;
  /// The picture of the present, if it is there and shows another display, is taken again.
  void show_display() override;
  stride::Time next() const override { return next_; }
  void take() override;

  /// How many pictures there are; nothing where it has not begun.
  std::optional<std::size_t> pictures() const;

  /// The world was set to the state of an instant at which the film was as pictures() told: drops
  /// the pictures of what is not yet, and takes that of the present where there is none. Where the
  /// state is that of another process, the film is in the folder; false if it lacks pictures.
  bool go_on(std::optional<std::size_t> pictures);

 private:
  std::vector<std::uint8_t> draw();
  void continue_from_present();

  const World& world_;
  FilmSettings settings_;
  Renderer renderer_;
  Frames frames_;
  bool has_begun_ = false;
  stride::Time next_;
  std::optional<Display> shown_;  ///< in the last picture; nothing where that is not known
};

}  // namespace mujoco_world::film

#endif
