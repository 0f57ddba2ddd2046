#include "units/mujoco_world/film/renderer.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <stdexcept>

#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/mjcf.h"

namespace mujoco_world::film {
namespace {

// finer shadows take most of the time, in software, and are not seen
constexpr int kShadowPerPixel = 3;
constexpr const char* kFilmCamera = "film";
constexpr int kMostDecorations = 10000;  // beside the model's geoms: sites, tendons, lights
constexpr double kHalo = 2.5;            // of the lamp's radius
constexpr float kHaloOpacity = 0.4F;

std::string cameras_of(const mjModel& model) {
  std::string names;
  for (int i = 0; i < model.ncam; ++i) {
    names += (names.empty() ? "'" : ", '") + name_of(model, mjOBJ_CAMERA, i) + "'";
  }
  return names.empty() ? "none; leave it empty for one that sees the whole world" : names;
}

/// Padding may differ, which costs a picture at most.
template <class T>
bool is_same(const T* one, const T* other, std::size_t count) {
  return count == 0 || std::memcmp(one, other, count * sizeof(T)) == 0;
}

/// Sets `kept` to `now`; returns whether they were equal before.
template <class T>
bool update(std::vector<T>& kept, const T* now, int count) {
  const auto size = static_cast<std::size_t>(count);
  if (kept.size() == size && is_same(kept.data(), now, size)) return true;
  kept.assign(now, now + size);
  return false;
}

mjvCamera choose_camera(const mjModel& model, const std::string& wanted) {
  mjvCamera camera;
  mjv_defaultFreeCamera(&model, &camera);
  const int id = mj_name2id(&model, mjOBJ_CAMERA, wanted.empty() ? kFilmCamera : wanted.c_str());
  if (id < 0 && !wanted.empty()) {
    throw std::runtime_error("film.camera: the world has no camera '" + wanted +
                             "'; its cameras are: " + cameras_of(model));
  }
  if (id >= 0) {
    camera.type = mjCAMERA_FIXED;
    camera.fixedcamid = id;
  }
  return camera;
}

void brighten(mjvGeom& lamp) {
  const float most = *std::max_element(lamp.rgba, lamp.rgba + 3);
  if (most > 0) std::for_each(lamp.rgba, lamp.rgba + 3, [most](float& part) { part /= most; });
  lamp.emission = 1;
}

/// Without it a small lamp is a pixel or two of a picture.
mjvGeom halo_of(const mjvGeom& lamp, double radius) {
  const double size[] = {kHalo * radius, 0, 0};
  const double middle[] = {lamp.pos[0], lamp.pos[1], lamp.pos[2]};
  const float colour[] = {lamp.rgba[0], lamp.rgba[1], lamp.rgba[2], kHaloOpacity * lamp.rgba[3]};
  mjvGeom halo{};
  mjv_initGeom(&halo, mjGEOM_SPHERE, size, middle, nullptr, colour);
  halo.emission = 1;
  return halo;
}

mjvGeom field_geom(const mjModel& model, const mjData& data, const ShownField& field) {
  const double width = kFieldWidth * field.reach;
  const double size[] = {width, width, field.reach};
  const float* site = model.site_rgba + 4 * field.site;
  const float colour[] = {site[0], site[1], site[2], kFieldOpacity};
  mjvGeom geom{};
  mjv_initGeom(&geom, mjGEOM_ELLIPSOID, size, data.site_xpos + 3 * field.site,
               data.site_xmat + 9 * field.site, colour);
  return geom;
}

/// mjr_makeContext() reads the environment, in which make_off_screen() has settings for a while.
std::mutex making;

}  // namespace

Renderer::Renderer(const mjModel& model, const View& view)
    : camera_(choose_camera(model, view.camera)), frame_{0, 0, view.width, view.height} {
  picture_.width = view.width;
  picture_.height = view.height;
  picture_.rgb.resize(std::size_t{3} * static_cast<std::size_t>(view.width) *
                      static_cast<std::size_t>(view.height));
  mjv_defaultOption(&options_);
  mjv_defaultScene(&scene_);
  mjr_defaultContext(&context_);
  const std::lock_guard lock(making);
  screen_ = make_off_screen();
  guarded([&] { screen_->with([&] { make(model); }); });
}

void Renderer::make(const mjModel& model) {
  mjModel sized = model;  // its arrays are the model's own
  sized.vis.global.offwidth = frame_.width;
  sized.vis.global.offheight = frame_.height;
  int& shadow = sized.vis.quality.shadowsize;
  shadow = std::min(shadow, kShadowPerPixel * std::max(frame_.width, frame_.height));
  mjr_makeContext(&sized, &context_, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  if (context_.currentBuffer != mjFB_OFFSCREEN) {
    throw std::runtime_error("OpenGL has no buffer of " + std::to_string(frame_.width) + " x " +
                             std::to_string(frame_.height) + " pixels");
  }
  mjv_makeScene(&model, &scene_, static_cast<int>(model.ngeom) + kMostDecorations);
}

Renderer::~Renderer() {
  mjv_freeScene(&scene_);
  try {
    guarded([&] { screen_->with([&] { mjr_freeContext(&context_); }); });
  } catch (const std::exception&) {  // it goes with the process
  }
}

const Picture& Renderer::draw(const mjModel& model, mjData& data, const Display& display) {
  guarded([&] {
    mjv_updateScene(&model, &data, &options_, nullptr, &camera_, mjCAT_ALL, &scene_);
    light_up(model, display.shining);
    for (const ShownField& field : display.fields) add(field_geom(model, data, field));
    if (is_unchanged(model)) return;
    screen_->with([&] {
      mjr_render(frame_, &scene_, &context_);
      read_pixels();
      const int error = mjr_getError();
      if (error != 0) throw std::runtime_error("OpenGL's error " + std::to_string(error));
    });
  });
  return picture_;
}

void Renderer::light_up(const mjModel& model, const std::vector<int>& shining) {
  if (shining.empty()) return;
  const int drawn = scene_.ngeom;  // the halos come behind them
  for (mjvGeom* geom = scene_.geoms; geom != scene_.geoms + drawn; ++geom) {
    if (geom->objtype != mjOBJ_GEOM) continue;
    if (std::find(shining.begin(), shining.end(), geom->objid) == shining.end()) continue;
    brighten(*geom);
    add(halo_of(*geom, model.geom_rbound[geom->objid]));
  }
}

/// As long as there is room.
void Renderer::add(const mjvGeom& geom) {
  if (scene_.ngeom < scene_.maxgeom) scene_.geoms[scene_.ngeom++] = geom;
}

bool Renderer::is_unchanged(const mjModel& model) {
  const bool has_same_geoms = update(sight_.geoms, scene_.geoms, scene_.ngeom);
  const bool has_same_lights = update(sight_.lights, scene_.lights, scene_.nlight);
  const bool has_same_camera = is_same(&sight_.camera, &scene_.camera[0], 1);
  sight_.camera = scene_.camera[0];
  const bool may_deform = model.nskin > 0 || api::has_deformables(&model);
  return has_same_geoms && has_same_lights && has_same_camera && !may_deform;
}

/// OpenGL's rows go from bottom to top.
void Renderer::read_pixels() {
  mjr_readPixels(picture_.rgb.data(), nullptr, frame_, &context_);
  const std::ptrdiff_t row = std::ptrdiff_t{3} * frame_.width;
  auto top = picture_.rgb.begin();
  auto bottom = picture_.rgb.end() - row;
  for (; top < bottom; top += row, bottom -= row) std::swap_ranges(top, top + row, bottom);
}

}  // namespace mujoco_world::film
