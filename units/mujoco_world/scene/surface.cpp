#include "units/mujoco_world/scene/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "units/mujoco_world/mujoco_api.h"

namespace mujoco_world::scene {
namespace {

using Triple = std::array<double, 3>;

std::uint32_t add_vertex(Surface& surface, const Triple& position, const Triple& normal) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  const Triple unit = length > 0
                          ? Triple{normal[0] / length, normal[1] / length, normal[2] / length}
                          : Triple{0, 0, 1};
  for (const double number : position) surface.positions.push_back(static_cast<float>(number));
  for (const double number : unit) surface.normals.push_back(static_cast<float>(number));
  return static_cast<std::uint32_t>(surface.positions.size() / 3 - 1);
}

void add_triangle(Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  surface.corners.insert(surface.corners.end(), {a, b, c});
}

/// a, b, c, d one after the other around it.
void add_quad(Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t d) {
  add_triangle(surface, a, b, c);
  add_triangle(surface, a, c, d);
}

void add_flat_quad(Surface& surface, const std::array<Triple, 4>& corners, const Triple& normal) {
  std::array<std::uint32_t, 4> index{};
  for (std::size_t i = 0; i < 4; ++i) index[i] = add_vertex(surface, corners[i], normal);
  add_quad(surface, index[0], index[1], index[2], index[3]);
}

/// A point of what is turned about z, and the normal there.
struct ProfilePoint {
  double radius, height;
  double outward, upward;
};

/// From the lowest point to the highest; x and y are scaled afterwards.
Surface turn(const std::vector<ProfilePoint>& profile, int slices, double x_scale = 1,
             double y_scale = 1) {
  Surface surface;
  const auto columns = static_cast<std::uint32_t>(slices) + 1;
  for (const ProfilePoint& point : profile) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double angle = 2 * mjPI * (i % (columns - 1)) / slices;
      const double x = std::cos(angle);
      const double y = std::sin(angle);
      add_vertex(surface, {point.radius * x * x_scale, point.radius * y * y_scale, point.height},
                 {point.outward * x / x_scale, point.outward * y / y_scale, point.upward});
    }
  }
  for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
    const bool is_edge = profile[row].radius == profile[row + 1].radius &&
                         profile[row].height == profile[row + 1].height;
    if (is_edge) continue;  // where the normal changes
    const bool begins_at_pole = profile[row].radius == 0;
    const bool ends_at_pole = profile[row + 1].radius == 0;
    for (std::uint32_t i = row * columns; i + 1 < (row + 1) * columns; ++i) {
      if (!begins_at_pole) add_triangle(surface, i, i + 1, i + 1 + columns);
      if (!ends_at_pole) add_triangle(surface, i, i + 1 + columns, i + columns);
    }
  }
  return surface;
}

/// Adds the part of a sphere between two latitudes [rad].
void add_arc(std::vector<ProfilePoint>& profile, double radius, double middle, double from,
             double to, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double latitude = from + (to - from) * i / steps;
    const bool is_pole = std::abs(latitude) == mjPI / 2;
    const double cosine = is_pole ? 0 : std::cos(latitude);
    const double sine = std::sin(latitude);
    profile.push_back({radius * cosine, middle + radius * sine, cosine, sine});
  }
}

struct Facets {
  int slices, stacks;
};

Facets facets_of(const mjModel& model) {
  return {std::max(3, model.vis.quality.numslices),
          2 * std::max(1, model.vis.quality.numstacks / 2)};
}

Surface ellipsoid(const Triple& size, const Facets& facets) {
  std::vector<ProfilePoint> profile;
  add_arc(profile, 1, 0, -mjPI / 2, mjPI / 2, facets.stacks);
  for (ProfilePoint& point : profile) {
    point.height *= size[2];
    point.upward /= size[2];
  }
  return turn(profile, facets.slices, size[0], size[1]);
}

Surface capsule(double radius, double half, const Facets& facets) {
  std::vector<ProfilePoint> profile;
  add_arc(profile, radius, -half, -mjPI / 2, 0, facets.stacks / 2);
  add_arc(profile, radius, half, 0, mjPI / 2, facets.stacks / 2);
  return turn(profile, facets.slices);
}

Surface cylinder(double radius, double half, const Facets& facets) {
  return turn({{0, -half, 0, -1},
               {radius, -half, 0, -1},
               {radius, -half, 1, 0},
               {radius, half, 1, 0},
               {radius, half, 0, 1},
               {0, half, 0, 1}},
              facets.slices);
}

Surface box(const Triple& size) {
  Surface surface;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::array<Triple, 4> corners{};
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      constexpr double kAround[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      for (std::size_t i = 0; i < 4; ++i) {
        corners[i][axis] = side * size[axis];
        corners[i][u] = side * kAround[i][0] * size[u];  // the other way round on the other side
        corners[i][v] = kAround[i][1] * size[v];
      }
      Triple normal{};
      normal[axis] = side;
      add_flat_quad(surface, corners, normal);
    }
  }
  return surface;
}

Surface plane(double x, double y) {
  Surface surface;
  add_flat_quad(surface, {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}}, {0, 0, 1});
  return surface;
}

/// Vertices that differ in their normal or in their place in the texture are several.
Surface mesh(const mjModel& model, int mesh) {
  Surface surface;
  const bool has_places = model.mesh_texcoordadr[mesh] >= 0;
  std::map<std::array<int, 3>, std::uint32_t> known;
  for (int face = 0; face < model.mesh_facenum[mesh]; ++face) {
    std::array<std::uint32_t, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      const api::MeshCorner corner = api::mesh_corner(&model, mesh, face, i);
      const std::array<int, 3> key{corner.vertex, corner.normal, corner.texture_place};
      auto [found, is_new] = known.try_emplace(key, 0);
      if (is_new) {
        const float* position = model.mesh_vert + 3 * corner.vertex;
        const float* normal = model.mesh_normal + 3 * corner.normal;
        found->second = add_vertex(surface, {position[0], position[1], position[2]},
                                   {normal[0], normal[1], normal[2]});
        if (has_places) {
          const float* place = model.mesh_texcoord + 2 * corner.texture_place;
          surface.texture_places.insert(surface.texture_places.end(), place, place + 2);
        }
      }
      corners[static_cast<std::size_t>(i)] = found->second;
    }
    add_triangle(surface, corners[0], corners[1], corners[2]);
  }
  return surface;
}

/// A grid of heights on a block.
class HeightField {
 public:
  HeightField(const mjModel& model, int field)
      : size_(model.hfield_size + 4 * field),
        rows_(model.hfield_nrow[field]),
        columns_(model.hfield_ncol[field]),
        heights_(model.hfield_data + model.hfield_adr[field]) {}

  Surface surface() {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        add_vertex(surface_, at(row, column), normal(row, column));
      }
    }
    for (int row = 0; row + 1 < rows_; ++row) {
      for (int column = 0; column + 1 < columns_; ++column) {
        const auto first = static_cast<std::uint32_t>(row * columns_ + column);
        const auto above = first + static_cast<std::uint32_t>(columns_);
        add_quad(surface_, first, first + 1, above + 1, above);
      }
    }
    for (int column = 0; column + 1 < columns_; ++column) {
      add_side(0, column, 0, column + 1, {0, -1, 0});
      add_side(rows_ - 1, column + 1, rows_ - 1, column, {0, 1, 0});
    }
    for (int row = 0; row + 1 < rows_; ++row) {
      add_side(row + 1, 0, row, 0, {-1, 0, 0});
      add_side(row, columns_ - 1, row + 1, columns_ - 1, {1, 0, 0});
    }
    const int last_row = rows_ - 1;
    const int last_column = columns_ - 1;
    add_flat_quad(
        surface_,
        {{base(0, 0), base(last_row, 0), base(last_row, last_column), base(0, last_column)}},
        {0, 0, -1});
    return std::move(surface_);
  }

 private:
  Triple at(int row, int column) const {
    return {size_[0] * (2.0 * column / (columns_ - 1) - 1),
            size_[1] * (2.0 * row / (rows_ - 1) - 1), size_[2] * heights_[row * columns_ + column]};
  }
  Triple base(int row, int column) const {
    Triple place = at(row, column);
    place[2] = -size_[3];
    return place;
  }
  /// Of the neighbours' differences.
  Triple normal(int row, int column) const {
    const Triple west = at(row, std::max(column - 1, 0));
    const Triple east = at(row, std::min(column + 1, columns_ - 1));
    const Triple south = at(std::max(row - 1, 0), column);
    const Triple north = at(std::min(row + 1, rows_ - 1), column);
    return {-(east[2] - west[2]) / (east[0] - west[0]),
            -(north[2] - south[2]) / (north[1] - south[1]), 1};
  }
  void add_side(int row, int column, int next_row, int next_column, const Triple& outward) {
    add_flat_quad(surface_,
                  {{base(row, column), base(next_row, next_column), at(next_row, next_column),
                    at(row, column)}},
                  outward);
  }

  const double* size_;
  int rows_, columns_;
  const float* heights_;
  Surface surface_;
};

double extent_of_plane(const mjModel& model, double half) {
  return half > 0 ? half : std::max(1.0, model.vis.map.zfar * model.stat.extent);
}

Surface shape_of(const mjModel& model, int geom) {
  const double* size = model.geom_size + 3 * geom;
  const int data = model.geom_dataid[geom];
  const Facets facets = facets_of(model);
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return plane(extent_of_plane(model, size[0]), extent_of_plane(model, size[1]));
    case mjGEOM_SPHERE:
      return ellipsoid({size[0], size[0], size[0]}, facets);
    case mjGEOM_CAPSULE:
      return capsule(size[0], size[1], facets);
    case mjGEOM_ELLIPSOID:
      return ellipsoid({size[0], size[1], size[2]}, facets);
    case mjGEOM_CYLINDER:
      return cylinder(size[0], size[1], facets);
    case mjGEOM_BOX:
      return box({size[0], size[1], size[2]});
    case mjGEOM_HFIELD:
      return HeightField(model, data).surface();
    default:
      return data >= 0 && data < model.nmesh ? mesh(model, data) : Surface{};
  }
}

/// What MuJoCo's mapping of the object's x and y into the texture is (settexture() of its
/// renderer).
void put_texture_on(Surface& surface, const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const double* size = model.geom_size + 3 * geom;
  const int type = model.geom_type[geom];
  const bool is_round = type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER;
  const double half[2] = {size[0], is_round ? size[0] : size[1]};
  double scale[2];
  for (int i = 0; i < 2; ++i) {
    const double repeat = model.mat_texrepeat[2 * material + i];
    const bool is_per_metre = model.mat_texuniform[material] || half[i] <= 0;
    scale[i] = is_per_metre ? repeat : repeat / half[i];
  }
  for (std::size_t i = 0; i < surface.positions.size(); i += 3) {
    const double x = surface.positions[i];
    const double y = surface.positions[i + 1];
    surface.texture_places.push_back(static_cast<float>(0.5 * scale[0] * x - 0.5));
    surface.texture_places.push_back(static_cast<float>(-0.5 * scale[1] * y - 0.5));
  }
}

}  // namespace

Surface surface_of(const mjModel& model, int geom, bool is_textured) {
  Surface surface = shape_of(model, geom);
  if (!is_textured) {
    surface.texture_places.clear();
  } else if (surface.texture_places.empty()) {
    put_texture_on(surface, model, geom);
  }
  return surface;
}

Surface ball(const mjModel& model, double radius) { return spheroid(model, radius, radius); }

Surface spheroid(const mjModel& model, double across, double along) {
  return ellipsoid({across, across, along}, facets_of(model));
}

}  // namespace mujoco_world::scene
