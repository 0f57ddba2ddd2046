// How geoms look: their materials and textures in a glTF document, and their meshes.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_LOOKS_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_LOOKS_H

#include <array>
#include <map>
#include <tuple>

#include <mujoco/mujoco.h>
#include <tiny_gltf.h>

namespace mujoco_world::scene {

using Colour = std::array<double, 4>;  ///< red, green, blue as they are displayed (sRGB), opacity

/// As MuJoCo draws it: its own colour, if it has one, else its material's.
Colour colour_of(const mjModel& model, int geom);

/// Of a lamp that shines, as in a film: its hue at full brightness.
Colour lit(const Colour& colour);

/// Of numbers that are displayed what glTF has, which is light: the transfer function of sRGB
/// (IEC 61966-2-1).
double linear(double displayed);

/// Adds meshes, each look once, to a document. The result of functions is the index of a mesh; -1
/// if the geom has no surface.
class Looks {
 public:
  Looks(const mjModel& model, tinygltf::Model& document) : model_(model), document_(document) {}

  int mesh_of(int geom);
  int lit_mesh_of(int lamp);
  int halo_of(int lamp);
  /// The field of a coil at a site, where it reaches 1 m.
  int field_of(int site);

 private:
  /// The texture of a material: of two dimensions as a texture, another one as its mean colour.
  struct Texture {
    int index = -1;
    std::array<double, 3> mean{1, 1, 1};
  };
  /// A geom's shape and place in a texture, and its material in the document.
  using MeshKey = std::tuple<int, int, std::array<double, 3>, int, int>;

  Texture texture_of(int material);
  Texture add_texture(int texture);
  int material_of(int geom);
  int add_shining(const Colour& colour);
  int add_material(tinygltf::Material material);
  int mesh_with(int geom, int material);
  int add_mesh(const struct Surface& surface, int material);

  const mjModel& model_;
  tinygltf::Model& document_;
  std::map<int, Texture> textures_;                                // of MuJoCo's textures
  std::map<std::pair<int, std::array<float, 4>>, int> materials_;  // of MuJoCo's, with a colour
  std::map<MeshKey, int> meshes_;
};

}  // namespace mujoco_world::scene

#endif
