#include "score/deviation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/file.hpp"

namespace ream::score {
namespace {

/// Of the two voxels between whose centres a vertex lies; SIZE_MAX outside of the grid.
std::array<size_t, 2> voxels_beside(const voxel::VoxelGrid& grid, const Vec3f& vertex_mm) {
  const Vec3 at = (vertex_mm.cast<double>().array() / grid.spacing_mm.array() - 0.5).matrix();
  Vec3i low;
  int edge = 0;
  double farthest = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double nearest = std::round(at[axis]), off = std::abs(at[axis] - nearest);
    low[axis] = static_cast<int>(nearest);
    if (off > farthest) {
      farthest = off;
      edge = axis;
    }
  }
  low[edge] = static_cast<int>(std::floor(at[edge]));
  Vec3i high = low;
  ++high[edge];
  const auto index = [&](const Vec3i& o) { return grid.contains(o) ? grid.index(o) : SIZE_MAX; };
  return {index(low), index(high)};
}

/// What is known of the surface at a vertex.
enum class Origin { native, cut, pilot_hole };

Origin origin_of(const BoneStates& bone, const Vec3f& vertex_mm) {
  bool drilled = false;
  for (const size_t i : voxels_beside(bone.grid, vertex_mm)) {
    if (i == SIZE_MAX) continue;
    if (bone.left[i] != bone.start[i]) return Origin::cut;
    drilled = drilled || bone.start[i] != bone.native[i];
  }
  return drilled ? Origin::pilot_hole : Origin::native;
}

}  // namespace

int8_t deviation_code(double mm) {
  const double steps = std::floor(mm / deviation_step_mm + 0.5);
  return static_cast<int8_t>(std::clamp(steps, -127.0, 127.0));
}

std::vector<uint8_t> cut_vertices(std::span<const Vec3f> vertices_mm, const BoneStates& bone) {
  std::vector<uint8_t> cut(vertices_mm.size());
  for (size_t i = 0; i < cut.size(); ++i) cut[i] = origin_of(bone, vertices_mm[i]) == Origin::cut ? 1 : 0;
  return cut;
}

std::vector<int8_t> deviation_from_plan(std::span<const Vec3f> vertices_mm, const BoneStates& bone,
                                        const PlacedFront& planned, const TriangleTree& native_surface) {
  std::vector<int8_t> codes(vertices_mm.size(), deviation_unknown);
  for (size_t i = 0; i < codes.size(); ++i) {
    const Origin origin = origin_of(bone, vertices_mm[i]);
    if (origin == Origin::pilot_hole) continue;
    const Vec3 point = vertices_mm[i].cast<double>();
    const double beyond = planned.front.distance_mm(planned.front_from_grid.point(point));
    if (beyond <= 0.0)
      codes[i] = deviation_code(beyond);
    else if (origin == Origin::cut)
      codes[i] = deviation_code(native_surface.distance_mm(point, std::min(beyond, deviation_range_mm)));
  }
  return codes;
}

std::vector<int8_t> deviation_from_implant(std::span<const Vec3f> vertices_mm, const BoneStates& bone,
                                           const PlacedFront& implant) {
  std::vector<int8_t> codes(vertices_mm.size(), deviation_unknown);
  const double outer2 = implant.front.outer_mm() * implant.front.outer_mm();
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 point = implant.front_from_grid.point(vertices_mm[i].cast<double>());
    if (point.head<2>().squaredNorm() > outer2) continue;
    const double gap = implant.front.distance_mm(point);
    if (std::abs(gap) > far_from_implant_mm) continue;
    if (origin_of(bone, vertices_mm[i]) != Origin::pilot_hole) codes[i] = deviation_code(gap);
  }
  return codes;
}

void keep_face_only(const NativeGlenoid& native, const AchievedFace& left, const voxel::VoxelGrid& grid,
                    std::span<const Vec3f> vertices_mm, std::vector<int8_t>& codes) {
  // A face slopes by up to 60 degrees, and the nearest ray is up to 0.18 mm away.
  const double tolerance_mm = grid.spacing_mm.maxCoeff() + 0.3;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 at = native.rays().in_lattice(grid.world_from_grid.point(vertices_mm[i].cast<double>()));
    const int nearest = native.rays().nearest(at.x(), at.y());
    const auto ray = static_cast<size_t>(std::max(0, nearest));
    const bool on_face =
        nearest >= 0 && native.face()[ray] != 0 && std::abs(at.z() - left.surface_mm[ray]) < tolerance_mm;
    if (!on_face) codes[i] = deviation_unknown;
  }
}

std::vector<int8_t> wall_codes(const NativeGlenoid& native, const std::vector<double>& thickness_mm,
                               const AchievedFace& left, const voxel::VoxelGrid& grid,
                               std::span<const Vec3f> vertices_mm) {
  std::vector<int8_t> codes(vertices_mm.size(), deviation_unknown);
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 at = native.rays().in_lattice(grid.world_from_grid.point(vertices_mm[i].cast<double>()));
    const int ray = native.rays().nearest(at.x(), at.y());
    if (ray < 0 || thickness_mm[static_cast<size_t>(ray)] == no_surface_mm) continue;
    const double steps = std::floor(thickness_mm[static_cast<size_t>(ray)] / wall_step_mm + 0.5);
    codes[i] = static_cast<int8_t>(std::clamp(steps, 0.0, 127.0));
  }
  keep_face_only(native, left, grid, vertices_mm, codes);
  return codes;
}

void write_deviation(const std::filesystem::path& json_path, const std::string& mesh_file, size_t vertices,
                     const DeviationFields& fields) {
  struct Field {
    const char *name, *words;
    const std::vector<int8_t>& codes;
    double step_mm = deviation_step_mm;
  };
  std::vector<std::byte> bytes;
  nlohmann::json listed = nlohmann::json::array();
  for (const Field& field :
       {Field{"plan", "beyond the planned surface; negative: bone stands that the plan removes",
              fields.from_plan},
        Field{"implant", "gap to the back of the seated implant; negative: bone would stand into it",
              fields.from_implant},
        Field{"wall", "bone left behind the reamed face, along its normal, to where the bone ends first",
              fields.wall, wall_step_mm}}) {
    if (field.codes.size() != vertices || vertices == 0) continue;
    listed.push_back(
        {{"name", field.name}, {"offset", bytes.size()}, {"step_mm", field.step_mm}, {"words", field.words}});
    const auto* first = reinterpret_cast<const std::byte*>(field.codes.data());
    bytes.insert(bytes.end(), first, first + vertices);
  }
  std::filesystem::path bin_path = json_path;
  bin_path.replace_extension(".bin");
  write_file_atomically(bin_path, bytes);
  const nlohmann::json description = {
      {"revision", deviation_revision},       {"mesh", mesh_file},
      {"file", bin_path.filename().string()}, {"vertices", vertices},
      {"step_mm", deviation_step_mm},         {"range_mm", deviation_range_mm},
      {"unknown", deviation_unknown},         {"fields", listed}};
  write_json_file(json_path, description);
}

}  // namespace ream::score
