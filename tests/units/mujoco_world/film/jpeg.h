// Pictures of a film as they are seen.
#ifndef STRIDE_TESTS_UNITS_MUJOCO_WORLD_FILM_JPEG_H
#define STRIDE_TESTS_UNITS_MUJOCO_WORLD_FILM_JPEG_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <jpeglib.h>

#include "units/mujoco_world/film/picture.h"

namespace stride::tests {

/// Ends the process where the bytes are no JPEG.
inline mujoco_world::film::Picture decoded(const std::vector<std::uint8_t>& bytes) {
  jpeg_decompress_struct state{};
  jpeg_error_mgr errors{};
  state.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&state);
  jpeg_mem_src(&state, bytes.data(), bytes.size());
  jpeg_read_header(&state, TRUE);
  jpeg_start_decompress(&state);
  mujoco_world::film::Picture picture{
      static_cast<int>(state.output_width), static_cast<int>(state.output_height), {}};
  picture.rgb.resize(std::size_t{3} * state.output_width * state.output_height);
  while (state.output_scanline < state.output_height) {
    JSAMPROW row = picture.rgb.data() + std::size_t{3} * state.output_width * state.output_scanline;
    jpeg_read_scanlines(&state, &row, 1);
  }
  jpeg_finish_decompress(&state);
  jpeg_destroy_decompress(&state);
  return picture;
}

}  // namespace stride::tests

#endif
