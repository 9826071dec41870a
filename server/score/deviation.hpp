#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_tree.hpp"
#include "score/component.hpp"
#include "score/cutting_surface.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::score {

/// A deviation as one signed byte: steps of 1/32 mm, saturating at 127 steps (3.97 mm) either way; -128 where
/// there is nothing to compare.
inline constexpr double deviation_step_mm = 1.0 / 32.0;
inline constexpr int8_t deviation_unknown = -128;
inline constexpr double deviation_range_mm = 127.0 * deviation_step_mm;

int8_t deviation_code(double mm);
/// Not of deviation_unknown.
inline double deviation_mm(int8_t code) { return code * deviation_step_mm; }

/// Coverage of one bone at three moments, in the order of VoxelGrid::index: untouched; with the pilot hole,
/// as it was before the first tick; as it is now. All outlive it.
struct BoneStates {
  const voxel::VoxelGrid& grid;
  const uint8_t *native, *start, *left;
};

/// A surface to compare with, put somewhere in the grid.
struct PlacedFront {
  SweptFront front;
  Pose front_from_grid;
};

/// 1 for every vertex that removal has made, else 0; vertices as below.
std::vector<uint8_t> cut_vertices(std::span<const Vec3f> vertices_mm, const BoneStates& bone);

/// How far the surface that is left lies beyond the planned one, vertex by vertex: positive where it is too
/// deep, negative where bone stands that should be gone. The planned surface is the native one less what the
/// reamer sweeps as planned. Unknown where nothing was removed and nothing should be, and in the pilot hole.
/// `vertices_mm`: of the surface of `left`, grid frame, on edges between voxel centres as marching cubes puts
/// them (whole_surface, BlockExtractor at stride 1). `native_surface`: of the untouched bone, grid frame, at
/// least within the range of what was removed.
std::vector<int8_t> deviation_from_plan(std::span<const Vec3f> vertices_mm, const BoneStates& bone,
                                        const PlacedFront& planned, const TriangleTree& native_surface);

/// How far the surface that is left lies behind an implant's back, vertex by vertex: a gap is positive, bone
/// that stands into the implant negative. Unknown beside the implant, in the pilot hole, and where the
/// surface is farther than `far_from_implant_mm`.
std::vector<int8_t> deviation_from_implant(std::span<const Vec3f> vertices_mm, const BoneStates& bone,
                                           const PlacedFront& implant);
inline constexpr double far_from_implant_mm = 8.0;

/// Makes unknown what lies anywhere but on what is left of the native face: on the vault's wall and back, and
/// beside the face. Seating is that of the face, so the shares of an implant's map are, too. `left`: the face
/// as it is now. `codes`: of the vertices, grid frame of `grid`.
void keep_face_only(const NativeGlenoid& native, const AchievedFace& left, const voxel::VoxelGrid& grid,
                    std::span<const Vec3f> vertices_mm, std::vector<int8_t>& codes);

/// Steps in which the thickness of a wall is told (wall_thickness_mm), mm: up to 31.75 mm.
inline constexpr double wall_step_mm = 0.25;

/// Thickness of wall behind a surface, vertex by vertex, in steps of wall_step_mm: that of the nearest ray.
/// Unknown off what was reamed. `thickness_mm`: wall_thickness_mm; the others as for keep_face_only().
std::vector<int8_t> wall_codes(const NativeGlenoid& native, const std::vector<double>& thickness_mm,
                               const AchievedFace& left, const voxel::VoxelGrid& grid,
                               std::span<const Vec3f> vertices_mm);

/// Maps of one surface; a field is empty when there is nothing to compare with.
struct DeviationFields {
  std::vector<int8_t> from_plan, from_implant;
  std::vector<int8_t> wall;  ///< in steps of wall_step_mm
};

/// Of what write_deviation() writes; 2: with the wall, and a step for every field.
inline constexpr int deviation_revision = 2;

/// Writes `json_path` (proto/deviation.schema.json) and beside it a file of the same stem that ends in .bin:
/// one byte a vertex and field in the order of the vertices of `mesh_file`, which has `vertices` of them.
/// Error io.
void write_deviation(const std::filesystem::path& json_path, const std::string& mesh_file, size_t vertices,
                     const DeviationFields& fields);

}  // namespace ream::score
