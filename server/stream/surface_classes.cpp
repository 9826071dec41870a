#include "stream/surface_classes.hpp"

#include <algorithm>
#include <cmath>

#include "stream/removed_bone.hpp"

namespace ream::stream {
namespace {

/// Deep enough to lie in bone that the surface bounds, and no deeper than a thin cortex.
constexpr float depth_samples = 0.75f;
constexpr size_t vertices_per_byte = 4;
constexpr double density_level_g_cc = 0.125;

}  // namespace

SurfaceClasses::SurfaceClasses(const voxel::BoneModel& bone)
    : grid_(bone.grid),
      density_(bone.density),
      class_of_code_(voxel::class_table(bone.cortical_threshold_g_cc)),
      layout_(bone.grid) {}

std::vector<uint8_t> SurfaceClasses::codes(std::span<const surface::BlockVertex> vertices, uint32_t block,
                                           int stride) const {
  std::vector<uint8_t> codes;
  if (density_.empty()) return codes;
  codes.reserve(vertices.size());
  const float depth_mm =
      depth_samples * static_cast<float>(stride) * static_cast<float>(grid_.min_spacing_mm());
  for (const surface::BlockVertex& vertex : vertices) {
    const Vec3f at_mm = surface::position_mm(vertex, layout_.coordinates(block), grid_.spacing_mm);
    const Vec3f outward = surface::direction_from_octahedral(vertex.ox, vertex.oy);
    const Vec3i voxel = grid_.voxel_at((at_mm - depth_mm * outward).cast<double>());
    const Vec3i nearest = voxel.cwiseMax(0).cwiseMin(grid_.dims.array().matrix() - Vec3i::Ones());
    codes.push_back(density_[grid_.index(nearest)]);
  }
  return codes;
}

std::vector<uint8_t> SurfaceClasses::packed_classes(std::span<const uint8_t> codes) const {
  std::vector<uint8_t> bytes((codes.size() + vertices_per_byte - 1) / vertices_per_byte);
  for (size_t i = 0; i < codes.size(); ++i)
    bytes[i / vertices_per_byte] |=
        static_cast<uint8_t>(static_cast<unsigned>(class_of(codes[i])) << (2 * (i % vertices_per_byte)));
  return bytes;
}

std::vector<uint8_t> SurfaceClasses::packed_densities(std::span<const uint8_t> codes) {
  std::vector<uint8_t> levels;
  for (const uint8_t code : codes) {
    const double level = std::clamp(std::round(voxel::density_g_cc(code) / density_level_g_cc), 1.0, 15.0);
    levels.push_back(code == voxel::cartilage_code ? uint8_t{0} : static_cast<uint8_t>(level));
  }
  return RemovedBone::packed(levels);
}

}  // namespace ream::stream
