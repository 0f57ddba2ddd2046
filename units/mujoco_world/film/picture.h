// A picture in memory, and as JPEG.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_PICTURE_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_PICTURE_H

#include <cstdint>
#include <vector>

namespace mujoco_world::film {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< rows from top to bottom, pixels from left to right
};

/// As a JPEG file. The same picture gives the same bytes. Throws std::runtime_error for a size that
/// JPEG does not have.
std::vector<std::uint8_t> to_jpeg(const Picture& picture);

}  // namespace mujoco_world::film

#endif
