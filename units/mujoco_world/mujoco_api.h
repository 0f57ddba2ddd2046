// What differs between MuJoCo 2.2 (Debian's) and today's 3 is here and nowhere else.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_MUJOCO_API_H
#define STRIDE_UNITS_MUJOCO_WORLD_MUJOCO_API_H

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <mujoco/mujoco.h>

#if mjVERSION_HEADER >= 230 && mjVERSION_HEADER < 3000000
#error \
    "this MuJoCo is not supported: take 2.2 (libmujoco-dev) or the one of scripts/fetch_mujoco3.sh"
#endif

namespace mujoco_world::api {

/// A corner of a mesh's triangle, as indices into the model's mesh_vert, mesh_normal and
/// mesh_texcoord; -1 where it has no texture coordinates.
struct MeshCorner {
  int vertex, normal, texture_place;
};

struct TextureData {
  const unsigned char* bytes;  ///< row after row, the upper one first
  int channels;
};

struct LightType {
  bool is_directional, is_spot;
};

static_assert(std::is_same_v<mjtNum, double>, "MuJoCo must be built in double precision");

// The state that integration depends on leaves out the applied forces: nothing here sets them.

#if mjVERSION_HEADER < 3000000

/// Enabled features that would make a world irreproducible: here the sensors' noise, from rand().
inline constexpr int kIrreproducible = mjENBL_SENSORNOISE;

/// Whether bodies that are not geoms can touch, too.
inline bool has_deformables(const mjModel*) { return false; }
inline int actuator_count(const mjModel* model) { return model->nu; }
inline int first_control(const mjModel*, int actuator) { return actuator; }
inline int control_count(const mjModel*, int) { return 1; }

/// Calls visit(array, length) for each array that integration depends on.
template <typename Visit>
void for_each_state_array(const mjModel* model, mjData* data, Visit visit) {
  visit(&data->time, 1);
  visit(data->qpos, model->nq);
  visit(data->qvel, model->nv);
  visit(data->act, model->na);
  visit(data->qacc_warmstart, model->nv);
  visit(data->ctrl, model->nu);
  visit(data->mocap_pos, 3 * model->nmocap);
  visit(data->mocap_quat, 4 * model->nmocap);
  visit(data->userdata, model->nuserdata);
}

inline std::size_t state_size(const mjModel* model, mjData* data) {
  std::size_t size = 0;
  for_each_state_array(model, data, [&](double*, int n) { size += static_cast<std::size_t>(n); });
  return size;
}

inline void get_state(const mjModel* model, mjData* data, double* state) {
  for_each_state_array(model, data,
                       [&](double* array, int n) { state = std::copy_n(array, n, state); });
}

inline void set_state(const mjModel* model, mjData* data, const double* state) {
  for_each_state_array(model, data, [&](double* array, int n) {
    std::copy_n(state, n, array);
    state += n;
  });
}

inline void clear_stack(mjData* data) { data->pstack = 0; }

/// Of what bodies carry, when mj_kinematics and mj_comPos have placed these.
inline void place_what_follows(const mjModel* model, mjData* data) {
  mj_camlight(model, data);
  mj_tendon(model, data);
}

inline std::pair<int, int> touching_geoms(const mjContact& contact) {
  return {contact.geom1, contact.geom2};
}

inline MeshCorner mesh_corner(const mjModel* model, int mesh, int face, int corner) {
  const int vertex = model->mesh_face[3 * (model->mesh_faceadr[mesh] + face) + corner];
  const int index = model->mesh_vertadr[mesh] + vertex;
  const int place = model->mesh_texcoordadr[mesh];
  return {index, index, place < 0 ? -1 : place + vertex};
}

/// Of the material's colour; -1: none.
inline int texture_of(const mjModel* model, int material) { return model->mat_texid[material]; }
inline TextureData texture_data(const mjModel* model, int texture) {
  return {model->tex_rgb + model->tex_adr[texture], 3};
}

/// How a surface reflects, where the material says that; below 0: it does not.
inline float metallic_of(const mjModel*, int) { return -1; }
inline float roughness_of(const mjModel*, int) { return -1; }

inline LightType light_type(const mjModel* model, int light) {
  const bool is_directional = model->light_directional[light];
  return {is_directional, !is_directional && model->light_cutoff[light] <= 90};
}
inline bool is_orthographic(const mjModel*, int) { return false; }

#else

/// Enabled features that would make a world irreproducible: here sleeping, which hides state.
inline constexpr int kIrreproducible = mjENBL_SLEEP;

inline bool has_deformables(const mjModel* model) { return model->nflex > 0; }
inline int actuator_count(const mjModel* model) { return static_cast<int>(model->nactuator); }
inline int first_control(const mjModel* model, int actuator) {
  return model->actuator_ctrladr[actuator];
}
inline int control_count(const mjModel* model, int actuator) {
  return model->actuator_ctrlnum[actuator];
}

inline constexpr int kState = mjSTATE_INTEGRATION & ~(mjSTATE_QFRC_APPLIED | mjSTATE_XFRC_APPLIED);

inline std::size_t state_size(const mjModel* model, mjData*) {
  return static_cast<std::size_t>(mj_stateSize(model, kState));
}
inline void get_state(const mjModel* model, mjData* data, double* state) {
  mj_getState(model, data, state, kState);
}
inline void set_state(const mjModel* model, mjData* data, const double* state) {
  mj_setState(model, data, state, kState);
}

inline void clear_stack(mjData* data) { data->pstack = data->pbase = 0; }

inline void place_what_follows(const mjModel* model, mjData* data) {
  mj_camlight(model, data);
  mj_flex(model, data);
  mj_tendon(model, data);
}

inline std::pair<int, int> touching_geoms(const mjContact& contact) {
  return {contact.geom[0], contact.geom[1]};
}

inline MeshCorner mesh_corner(const mjModel* model, int mesh, int face, int corner) {
  const int index = 3 * (model->mesh_faceadr[mesh] + face) + corner;
  const int place = model->mesh_texcoordadr[mesh];
  return {model->mesh_vertadr[mesh] + model->mesh_face[index],
          model->mesh_normaladr[mesh] + model->mesh_facenormal[index],
          place < 0 ? -1 : place + model->mesh_facetexcoord[index]};
}

inline int texture_of(const mjModel* model, int material) {
  const int* textures = model->mat_texid + mjNTEXROLE * material;
  return textures[mjTEXROLE_RGB] >= 0 ? textures[mjTEXROLE_RGB] : textures[mjTEXROLE_RGBA];
}
inline TextureData texture_data(const mjModel* model, int texture) {
  return {model->tex_data + model->tex_adr[texture], model->tex_nchannel[texture]};
}

inline float metallic_of(const mjModel* model, int material) {
  return model->mat_metallic[material];
}
inline float roughness_of(const mjModel* model, int material) {
  return model->mat_roughness[material];
}

inline LightType light_type(const mjModel* model, int light) {
  const int type = model->light_type[light];
  return {type == mjLIGHT_DIRECTIONAL, type == mjLIGHT_SPOT && model->light_cutoff[light] <= 90};
}
inline bool is_orthographic(const mjModel* model, int camera) {
  return model->cam_projection[camera] == mjPROJ_ORTHOGRAPHIC;
}

#endif

}  // namespace mujoco_world::api

#endif
