#include "units/mujoco_world/scene/looks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <stb_image_write.h>

#include "units/mujoco_world/display.h"
#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/mujoco_api.h"
#include "units/mujoco_world/scene/buffer.h"
#include "units/mujoco_world/scene/surface.h"

namespace mujoco_world::scene {
namespace {

// as MuJoCo has it where there is no material
constexpr float kDefaultSpecular = 0.5F;
constexpr float kDefaultShininess = 0.5F;
constexpr float kDefaultGrey[] = {0.5F, 0.5F, 0.5F, 1};

constexpr double kHalo = 2.5;  // as in a film: of the lamp's radius
constexpr double kHaloOpacity = 0.4;

/// Of Phong's exponent, 128 times the shininess, the roughness with the same width of the highlight
/// (B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007,
/// section 5.2). What hardly reflects is dull.
double roughness_of(double specular, double shininess) {
  const double sharp = std::pow(2 / (128 * std::clamp(shininess, 0.0, 1.0) + 2), 0.25);
  return 1 - std::clamp(specular, 0.0, 1.0) * (1 - sharp);
}

void append(void* bytes, void* data, int size) {
  const auto* const first = static_cast<const unsigned char*>(data);
  auto& all = *static_cast<std::vector<unsigned char>*>(bytes);
  all.insert(all.end(), first, first + size);
}

std::vector<double> light_of(const Colour& colour) {
  return {linear(colour[0]), linear(colour[1]), linear(colour[2])};
}

}  // namespace

double linear(double displayed) {
  const double x = std::clamp(displayed, 0.0, 1.0);
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Colour colour_of(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const float* own = model.geom_rgba + 4 * geom;
  const bool has_own = material < 0 || !std::equal(own, own + 4, kDefaultGrey);
  const float* rgba = has_own ? own : model.mat_rgba + 4 * material;
  return {rgba[0], rgba[1], rgba[2], rgba[3]};
}

Colour lit(const Colour& colour) {
  const double most = *std::max_element(colour.begin(), colour.begin() + 3);
  if (!(most > 0)) return colour;
  return {colour[0] / most, colour[1] / most, colour[2] / most, colour[3]};
}

Looks::Texture Looks::texture_of(int material) {
  const int texture = material < 0 ? -1 : api::texture_of(&model_, material);
  if (texture < 0) return {};
  const auto [found, is_new] = textures_.try_emplace(texture);
  if (is_new) found->second = add_texture(texture);
  return found->second;
}

Looks::Texture Looks::add_texture(int texture) {
  const auto [bytes, channels] = api::texture_data(&model_, texture);
  const int width = model_.tex_width[texture];
  const int height = model_.tex_height[texture];
  Texture added;
  if (model_.tex_type[texture] != mjTEXTURE_2D) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < pixels; ++i) {
        sum += bytes[i * static_cast<std::size_t>(channels) + k];
      }
      added.mean[k] = sum / (255 * static_cast<double>(pixels));
    }
    return added;
  }
  std::vector<unsigned char> png;
  const std::string name = name_of(model_, mjOBJ_TEXTURE, texture);
  if (stbi_write_png_to_func(&append, &png, width, height, channels, bytes, width * channels) ==
      0) {
    throw std::runtime_error("cannot make a PNG of the texture '" + name + "'");
  }
  if (document_.samplers.empty()) {
    tinygltf::Sampler& sampler = document_.samplers.emplace_back();
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  }
  tinygltf::Image& image = document_.images.emplace_back();
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = add_view(document_, png.data(), png.size(), 0);
  tinygltf::Texture& listed = document_.textures.emplace_back();
  listed.sampler = 0;
  listed.source = static_cast<int>(document_.images.size()) - 1;
  added.index = static_cast<int>(document_.textures.size()) - 1;
  return added;
}

int Looks::add_material(tinygltf::Material material) {
  document_.materials.push_back(std::move(material));
  return static_cast<int>(document_.materials.size()) - 1;
}

int Looks::material_of(int geom) {
  const int id = model_.geom_matid[geom];
  Colour colour = colour_of(model_, geom);
  const std::array<float, 4> rgba{static_cast<float>(colour[0]), static_cast<float>(colour[1]),
                                  static_cast<float>(colour[2]), static_cast<float>(colour[3])};
  const auto [found, is_new] = materials_.try_emplace({id, rgba}, -1);
  if (!is_new) return found->second;
  const Texture texture = texture_of(id);
  tinygltf::Material material;
  if (id >= 0) material.name = name_of(model_, mjOBJ_MATERIAL, id);
  auto& surface = material.pbrMetallicRoughness;
  for (std::size_t k = 0; k < 3; ++k) colour[k] *= texture.mean[k];
  surface.baseColorFactor = light_of(colour);
  surface.baseColorFactor.push_back(std::clamp(colour[3], 0.0, 1.0));
  surface.baseColorTexture.index = texture.index;
  const float metallic = id < 0 ? -1 : api::metallic_of(&model_, id);
  const float roughness = id < 0 ? -1 : api::roughness_of(&model_, id);
  surface.metallicFactor = std::clamp(metallic, 0.0F, 1.0F);
  surface.roughnessFactor =
      roughness >= 0 ? std::min(roughness, 1.0F)
                     : roughness_of(id < 0 ? kDefaultSpecular : model_.mat_specular[id],
                                    id < 0 ? kDefaultShininess : model_.mat_shininess[id]);
  if (const float emission = id < 0 ? 0 : model_.mat_emission[id]; emission > 0) {
    material.emissiveFactor =
        light_of({colour[0] * emission, colour[1] * emission, colour[2] * emission, 1});
    material.emissiveTexture.index = texture.index;
  }
  if (colour[3] < 1) material.alphaMode = "BLEND";
  return found->second = add_material(std::move(material));
}

/// Of that colour, whatever light falls on it.
int Looks::add_shining(const Colour& colour) {
  tinygltf::Material material;
  auto& surface = material.pbrMetallicRoughness;
  surface.baseColorFactor = {0, 0, 0, std::clamp(colour[3], 0.0, 1.0)};
  surface.metallicFactor = 0;
  material.emissiveFactor = light_of(colour);
  if (colour[3] < 1) material.alphaMode = "BLEND";
  return add_material(std::move(material));
}

int Looks::add_mesh(const Surface& surface, int material) {
  if (surface.corners.empty()) return -1;
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive triangles;
  triangles.mode = TINYGLTF_MODE_TRIANGLES;
  triangles.material = material;
  triangles.attributes["POSITION"] =
      add_floats(document_, surface.positions, TINYGLTF_TYPE_VEC3, kVertices);
  triangles.attributes["NORMAL"] =
      add_floats(document_, surface.normals, TINYGLTF_TYPE_VEC3, kVertices);
  if (!surface.texture_places.empty()) {
    triangles.attributes["TEXCOORD_0"] =
        add_floats(document_, surface.texture_places, TINYGLTF_TYPE_VEC2, kVertices);
  }
  triangles.indices = add_indices(document_, surface.corners);
  document_.meshes.emplace_back().primitives.push_back(std::move(triangles));
  return static_cast<int>(document_.meshes.size()) - 1;
}

int Looks::mesh_with(int geom, int material) {
  const bool is_textured = document_.materials[static_cast<std::size_t>(material)]
                               .pbrMetallicRoughness.baseColorTexture.index >= 0;
  const double* size = model_.geom_size + 3 * geom;
  const MeshKey key{model_.geom_type[geom],
                    model_.geom_dataid[geom],
                    {size[0], size[1], size[2]},
                    is_textured ? model_.geom_matid[geom] : -1,
                    material};
  const auto [found, is_new] = meshes_.try_emplace(key, -1);
  if (is_new) found->second = add_mesh(surface_of(model_, geom, is_textured), material);
  return found->second;
}

int Looks::mesh_of(int geom) { return mesh_with(geom, material_of(geom)); }

int Looks::lit_mesh_of(int lamp) {
  return mesh_with(lamp, add_shining(lit(colour_of(model_, lamp))));
}

int Looks::halo_of(int lamp) {
  Colour colour = lit(colour_of(model_, lamp));
  colour[3] *= kHaloOpacity;
  const double radius = kHalo * model_.geom_rbound[lamp];
  return radius > 0 ? add_mesh(ball(model_, radius), add_shining(colour)) : -1;
}

int Looks::field_of(int site) {
  const float* rgba = model_.site_rgba + 4 * site;
  tinygltf::Material material;
  auto& surface = material.pbrMetallicRoughness;
  surface.baseColorFactor = light_of({rgba[0], rgba[1], rgba[2], 1});
  surface.baseColorFactor.push_back(kFieldOpacity);
  surface.metallicFactor = 0;
  material.alphaMode = "BLEND";
  return add_mesh(spheroid(model_, kFieldWidth, 1), add_material(std::move(material)));
}

}  // namespace mujoco_world::scene
