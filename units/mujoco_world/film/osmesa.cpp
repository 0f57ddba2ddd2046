// Mesa's off-screen interface, as its header GL/osmesa.h has it: it draws in software, into memory.
#include <array>
#include <stdexcept>

#include "units/mujoco_world/film/at_end.h"
#include "units/mujoco_world/film/library.h"
#include "units/mujoco_world/film/off_screen.h"

namespace mujoco_world::film {
namespace {

using OsmesaContext = struct osmesa_context*;

constexpr unsigned kRgba = 0x1908;          // OSMESA_RGBA
constexpr unsigned kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE
constexpr int kType = 0x23;                 // OSMESA_TYPE

struct OsmesaFunctions {
  OsmesaContext (*create)(unsigned format, int depth_bits, int stencil_bits, int accum_bits,
                          OsmesaContext shared);
  void (*destroy)(OsmesaContext);
  unsigned char (*make_current)(OsmesaContext, void* buffer, unsigned type, int width, int height);
  OsmesaContext (*current)();
  void (*get_integer)(int name, int* value);
  unsigned char (*color_buffer)(OsmesaContext, int* width, int* height, int* format, void** buffer);

  OsmesaFunctions() {
    const Library library{"libOSMesa.so.8", "libOSMesa.so.6"};
    library.find("OSMesaCreateContextExt", create);
    library.find("OSMesaDestroyContext", destroy);
    library.find("OSMesaMakeCurrent", make_current);
    library.find("OSMesaGetCurrentContext", current);
    library.find("OSMesaGetIntegerv", get_integer);
    library.find("OSMesaGetColorBuffer", color_buffer);
  }
};

/// The context that is current is put back at the end of the result's life.
auto keep_current(const OsmesaFunctions& gl) {
  const OsmesaContext context = gl.current();
  int type = 0;
  int width = 0;
  int height = 0;
  void* buffer = nullptr;
  if (context != nullptr) {
    int format = 0;
    gl.get_integer(kType, &type);
    gl.color_buffer(context, &width, &height, &format, &buffer);
  }
  return AtEnd(
      [=, &gl] { gl.make_current(context, buffer, static_cast<unsigned>(type), width, height); });
}

class Osmesa : public OffScreen {
 public:
  explicit Osmesa(const OsmesaFunctions& gl)
      : gl_(gl), context_(gl.create(kRgba, 24, 8, 0, nullptr)) {
    if (context_ == nullptr) throw std::runtime_error("it gives no context");
  }
  ~Osmesa() override { gl_.destroy(context_); }

  void with(const std::function<void()>& work) override {
    const auto keep = keep_current(gl_);
    if (!gl_.make_current(context_, window_.data(), kUnsignedByte, kSide, kSide)) {
      throw std::runtime_error("OSMesa does not make its context current");
    }
    work();
  }

 private:
  static constexpr int kSide = 16;  // what is drawn goes into a buffer of MuJoCo's, not here

  const OsmesaFunctions& gl_;
  OsmesaContext context_;
  std::array<unsigned char, std::size_t{4} * kSide * kSide> window_{};
};

}  // namespace

std::unique_ptr<OffScreen> make_osmesa() {
  static const OsmesaFunctions gl;
  return std::make_unique<Osmesa>(gl);
}

}  // namespace mujoco_world::film
