// Mesa's off-screen interface, as its header GL/osmesa.h has it: it draws in software, into memory.
#include <array>
#include <stdexcept>

#include "units/mujoco_world/film/library.h"
#include "units/mujoco_world/film/off_screen.h"

namespace mujoco_world::film {
namespace {

using Context = struct osmesa_context*;

constexpr unsigned kRgba = 0x1908;          // OSMESA_RGBA
constexpr unsigned kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE
constexpr int kType = 0x23;                 // OSMESA_TYPE

struct Functions {
  Context (*create)(unsigned format, int depth_bits, int stencil_bits, int accum_bits,
                    Context shared);
  void (*destroy)(Context);
  unsigned char (*make_current)(Context, void* buffer, unsigned type, int width, int height);
  Context (*current)();
  void (*get_integer)(int name, int* value);
  unsigned char (*color_buffer)(Context, int* width, int* height, int* format, void** buffer);

  Functions() {
    const Library library{"libOSMesa.so.8", "libOSMesa.so.6"};
    library.find("OSMesaCreateContextExt", create);
    library.find("OSMesaDestroyContext", destroy);
    library.find("OSMesaMakeCurrent", make_current);
    library.find("OSMesaGetCurrentContext", current);
    library.find("OSMesaGetIntegerv", get_integer);
    library.find("OSMesaGetColorBuffer", color_buffer);
  }
};

/// Puts the context that is current back at the end.
class KeepCurrent {
 public:
  explicit KeepCurrent(const Functions& gl) : gl_(gl), context_(gl.current()) {
    if (context_ == nullptr) return;
    int format = 0;
    gl_.get_integer(kType, &type_);
    gl_.color_buffer(context_, &width_, &height_, &format, &buffer_);
  }
  ~KeepCurrent() {
    gl_.make_current(context_, buffer_, static_cast<unsigned>(type_), width_, height_);
  }
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  const Functions& gl_;
  Context context_;
  int type_ = 0;
  int width_ = 0;
  int height_ = 0;
  void* buffer_ = nullptr;
};

class Osmesa : public OffScreen {
 public:
  explicit Osmesa(const Functions& gl) : gl_(gl), context_(gl.create(kRgba, 24, 8, 0, nullptr)) {
    if (context_ == nullptr) throw std::runtime_error("it gives no context");
  }
  ~Osmesa() override { gl_.destroy(context_); }

  void with(const std::function<void()>& work) override {
    const KeepCurrent keep(gl_);
    if (!gl_.make_current(context_, window_.data(), kUnsignedByte, kSide, kSide)) {
      throw std::runtime_error("OSMesa does not make its context current");
    }
    work();
  }

 private:
  static constexpr int kSide = 16;  // what is drawn goes into a buffer of MuJoCo's, not here

  const Functions& gl_;
  Context context_;
  std::array<unsigned char, std::size_t{4} * kSide * kSide> window_{};
};

}  // namespace

std::unique_ptr<OffScreen> make_osmesa() {
  static const Functions gl;
  return std::make_unique<Osmesa>(gl);
}

}  // namespace mujoco_world::film
