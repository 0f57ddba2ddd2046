// EGL 1.5 without a display (Khronos, "EGL Graphics System"; the extensions
// EGL_MESA_platform_surfaceless, EGL_EXT_platform_device, EGL_KHR_surfaceless_context): drawn by
// the graphics card's driver or, where there is none, by Mesa in software.
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "units/mujoco_world/film/at_end.h"
#include "units/mujoco_world/film/library.h"
#include "units/mujoco_world/film/off_screen.h"

namespace mujoco_world::film {
namespace {

using EglDisplay = void*;
using Config = void*;
using EglContext = void*;
using Surface = void*;
using Device = void*;
using Int = std::int32_t;

constexpr unsigned kOpenGl = 0x30A2;               // EGL_OPENGL_API
constexpr unsigned kPlatformSurfaceless = 0x31DD;  // EGL_PLATFORM_SURFACELESS_MESA
constexpr unsigned kPlatformDevice = 0x313F;       // EGL_PLATFORM_DEVICE_EXT
constexpr Int kDraw = 0x3059;
constexpr Int kRead = 0x305A;
constexpr Int kNone = 0x3038;
constexpr std::array<Int, 15> kWanted = {0x3024, 8,   // EGL_RED_SIZE
                                         0x3023, 8,   // EGL_GREEN_SIZE
                                         0x3022, 8,   // EGL_BLUE_SIZE
                                         0x3025, 24,  // EGL_DEPTH_SIZE
                                         0x3026, 8,   // EGL_STENCIL_SIZE
                                         0x3033, 1,   // EGL_SURFACE_TYPE: EGL_PBUFFER_BIT
                                         0x3040, 8,   // EGL_RENDERABLE_TYPE: EGL_OPENGL_BIT
                                         kNone};

struct EglFunctions {
  void (*(*address)(const char* name))();
  EglDisplay (*platform_display)(unsigned platform, void* native, const std::intptr_t* attributes);
  unsigned (*initialize)(EglDisplay, Int* major, Int* minor);
  unsigned (*bind_api)(unsigned api);
  unsigned (*query_api)();
  unsigned (*choose_config)(EglDisplay, const Int* attributes, Config*, Int size, Int* count);
  EglContext (*create_context)(EglDisplay, Config, EglContext shared, const Int* attributes);
  unsigned (*destroy_context)(EglDisplay, EglContext);
  unsigned (*make_current)(EglDisplay, Surface draw, Surface read, EglContext);
  EglDisplay (*current_display)();
  Surface (*current_surface)(Int which);
  EglContext (*current_context)();
  Int (*error)();

  EglFunctions() {
    const Library library{"libEGL.so.1"};
    library.find("eglGetProcAddress", address);
    library.find("eglGetPlatformDisplay", platform_display);
    library.find("eglInitialize", initialize);
    library.find("eglBindAPI", bind_api);
    library.find("eglQueryAPI", query_api);
    library.find("eglChooseConfig", choose_config);
    library.find("eglCreateContext", create_context);
    library.find("eglDestroyContext", destroy_context);
    library.find("eglMakeCurrent", make_current);
    library.find("eglGetCurrentDisplay", current_display);
    library.find("eglGetCurrentSurface", current_surface);
    library.find("eglGetCurrentContext", current_context);
    library.find("eglGetError", error);
  }
};

/// What is current is put back at the end of the result's life; OpenGL is the API until then.
auto keep_current(const EglFunctions& egl) {
  const unsigned api = egl.query_api();
  egl.bind_api(kOpenGl);
  const EglDisplay display = egl.current_display();
  const Surface draw = egl.current_surface(kDraw);
  const Surface read = egl.current_surface(kRead);
  const EglContext context = egl.current_context();
  return AtEnd([=, &egl] {
    if (context != nullptr) egl.make_current(display, draw, read, context);
    egl.bind_api(api);
  });
}

std::vector<EglDisplay> displays(const EglFunctions& egl) {
  std::vector<EglDisplay> displays{egl.platform_display(kPlatformSurfaceless, nullptr, nullptr)};
  const auto query = reinterpret_cast<unsigned (*)(Int most, Device*, Int * count)>(
      egl.address("eglQueryDevicesEXT"));
  std::array<Device, 16> devices{};
  Int count = 0;
  if (query != nullptr && !query(static_cast<Int>(devices.size()), devices.data(), &count)) {
    count = 0;
  }
  for (Int i = 0; i < count; ++i) {
    Device device = devices[static_cast<std::size_t>(i)];
    displays.push_back(egl.platform_display(kPlatformDevice, device, nullptr));
  }
  return displays;
}

struct DisplayContext {
  EglDisplay display = nullptr;
  EglContext context = nullptr;
};

/// The display is not closed again: it is the process's, and others may use it.
DisplayContext make_context(const EglFunctions& egl) {
  for (const EglDisplay display : displays(egl)) {
    if (display == nullptr || !egl.initialize(display, nullptr, nullptr)) continue;
    Config config = nullptr;
    Int count = 0;
    egl.choose_config(display, kWanted.data(), &config, 1, &count);
    if (count < 1) continue;
    const EglContext context = egl.create_context(display, config, nullptr, nullptr);
    if (context != nullptr) return {display, context};
  }
  throw std::runtime_error("no display gives a context, EGL's error " +
                           std::to_string(egl.error()));
}

class Egl : public OffScreen {
 public:
  explicit Egl(const EglFunctions& egl) : egl_(egl) {
    const auto keep = keep_current(egl_);
    own_ = make_context(egl_);
  }
  ~Egl() override { egl_.destroy_context(own_.display, own_.context); }

  void with(const std::function<void()>& work) override {
    const auto keep = keep_current(egl_);
    const AtEnd release([this] { egl_.make_current(own_.display, nullptr, nullptr, nullptr); });
    if (!egl_.make_current(own_.display, nullptr, nullptr, own_.context)) {
      throw std::runtime_error("EGL does not make its context current, error " +
                               std::to_string(egl_.error()));
    }
    work();
  }

 private:
  const EglFunctions& egl_;
  DisplayContext own_;
};

}  // namespace

std::unique_ptr<OffScreen> make_egl() {
  static const EglFunctions egl;
  return std::make_unique<Egl>(egl);
}

}  // namespace mujoco_world::film
