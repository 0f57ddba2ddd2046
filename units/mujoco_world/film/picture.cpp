#include "units/mujoco_world/film/picture.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <jpeglib.h>

namespace mujoco_world::film {
namespace {

constexpr int kQuality = 85;  // of 100

[[noreturn]] void fail(j_common_ptr state) {
  std::array<char, JMSG_LENGTH_MAX> text{};
  state->err->format_message(state, text.data());
  throw std::runtime_error(std::string("cannot write a JPEG: ") + text.data());
}

/// libjpeg's state, and the memory that it writes into. An error leaves it through its frames, as
/// one of MuJoCo's does (hooks.h).
class Compressor {
 public:
  explicit Compressor(const Picture& picture) {
    state_.err = jpeg_std_error(&errors_);
    errors_.error_exit = &fail;
    jpeg_create_compress(&state_);
    jpeg_mem_dest(&state_, &bytes_, &size_);
    state_.image_width = static_cast<JDIMENSION>(picture.width);
    state_.image_height = static_cast<JDIMENSION>(picture.height);
    state_.input_components = 3;
    state_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&state_);
    jpeg_set_quality(&state_, kQuality, TRUE);
    state_.optimize_coding = TRUE;
  }
  ~Compressor() {
    jpeg_destroy_compress(&state_);
    std::free(bytes_);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  std::vector<std::uint8_t> compress(const Picture& picture) {
    jpeg_start_compress(&state_, TRUE);
    const std::size_t row_size = std::size_t{3} * state_.image_width;
    while (state_.next_scanline < state_.image_height) {
      // it reads the row only
      auto* row = const_cast<JSAMPLE*>(picture.rgb.data() + state_.next_scanline * row_size);
      jpeg_write_scanlines(&state_, &row, 1);
    }
    jpeg_finish_compress(&state_);
    return {bytes_, bytes_ + size_};
  }

 private:
  jpeg_compress_struct state_{};
  jpeg_error_mgr errors_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::vector<std::uint8_t> to_jpeg(const Picture& picture) {
  return Compressor(picture).compress(picture);
}

}  // namespace mujoco_world::film
