// EGL 1.5 without a display (Khronos, "EGL Graphics System"; the extensions
// EGL_MESA_platform_surfaceless, EGL_EXT_platform_device, EGL_KHR_surfaceless_context): drawn by
// the graphics card's driver or, where there is none, by Mesa in software.
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "units/mujoco_world/film/library.h"
#include "units/mujoco_world/film/off_screen.h"

namespace mujoco_world::film {
namespace {

using Display = void*;
using Config = void*;
using Context = void*;
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

struct Functions {
  void (*(*address)(const char* name))();
  Display (*platform_display)(unsigned platform, void* native, const std::intptr_t* attributes);
  unsigned (*initialize)(Display, Int* major, Int* minor);
  unsigned (*bind_api)(unsigned api);
  unsigned (*query_api)();
  unsigned (*choose_config)(Display, const Int* attributes, Config*, Int size, Int* count);
  Context (*create_context)(Display, Config, Context shared, const Int* attributes);
  unsigned (*destroy_context)(Display, Context);
  unsigned (*make_current)(Display, Surface draw, Surface read, Context);
  Display (*current_display)();
  Surface (*current_surface)(Int which);
  Context (*current_context)();
  Int (*error)();

  Functions() {
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

/// Puts what is current back at the end; OpenGL is the API until then.
class KeepCurrent {
 public:
  explicit KeepCurrent(const Functions& egl) : egl_(egl), api_(egl.query_api()) {
    egl_.bind_api(kOpenGl);
    display_ = egl_.current_display();
    draw_ = egl_.current_surface(kDraw);
    read_ = egl_.current_surface(kRead);
    context_ = egl_.current_context();
  }
  ~KeepCurrent() {
    if (context_ != nullptr) egl_.make_current(display_, draw_, read_, context_);
    egl_.bind_api(api_);
  }
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  const Functions& egl_;
  unsigned api_;
  Display display_;
  Surface draw_;
  Surface read_;
  Context context_;
};

std::vector<Display> displays(const Functions& egl) {
  std::vector<Display> displays{egl.platform_display(kPlatformSurfaceless, nullptr, nullptr)};
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

struct Place {
  Display display = nullptr;
  Context context = nullptr;
};

/// A display is not closed again: it is the process's, and others may use it.
Place make_place(const Functions& egl) {
  for (const Display display : displays(egl)) {
    if (display == nullptr || !egl.initialize(display, nullptr, nullptr)) continue;
    Config config = nullptr;
    Int count = 0;
    egl.choose_config(display, kWanted.data(), &config, 1, &count);
    if (count < 1) continue;
    const Context context = egl.create_context(display, config, nullptr, nullptr);
    if (context != nullptr) return {display, context};
  }
  throw std::runtime_error("no display gives a context, EGL's error " +
                           std::to_string(egl.error()));
}

class Egl : public OffScreen {
 public:
  explicit Egl(const Functions& egl) : egl_(egl) {
    const KeepCurrent keep(egl_);
    place_ = make_place(egl_);
  }
  ~Egl() override { egl_.destroy_context(place_.display, place_.context); }

  void with(const std::function<void()>& work) override {
    const KeepCurrent keep(egl_);
    const Release release{egl_, place_.display};
    if (!egl_.make_current(place_.display, nullptr, nullptr, place_.context)) {
      throw std::runtime_error("EGL does not make its context current, error " +
                               std::to_string(egl_.error()));
    }
    work();
  }

 private:
  struct Release {
    const Functions& egl;
    Display display;
    ~Release() { egl.make_current(display, nullptr, nullptr, nullptr); }
  };

  const Functions& egl_;
  Place place_;
};

}  // namespace

std::unique_ptr<OffScreen> make_egl() {
  static const Functions egl;
  return std::make_unique<Egl>(egl);
}

}  // namespace mujoco_world::film
