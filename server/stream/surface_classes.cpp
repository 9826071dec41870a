#include "stream/surface_classes.hpp"

#include "surface/octahedral.hpp"

namespace ream::stream {
namespace {

/// Deep enough to lie in bone that the surface bounds, and no deeper than a thin cortex.
constexpr float depth_samples = 0.75f;
constexpr size_t vertices_per_byte = 4;

}  // namespace

SurfaceClasses::SurfaceClasses(const voxel::BoneModel& bone)
    : grid_(bone.grid),
      density_(bone.density),
      class_of_code_(voxel::class_table(bone.cortical_threshold_g_cc)),
      layout_(bone.grid) {}

voxel::BoneClass SurfaceClasses::under(const surface::BlockVertex& vertex, uint32_t block, int stride) const {
  const Vec3f at_mm = surface::position_mm(vertex, layout_.coordinates(block), grid_.spacing_mm);
  const Vec3f outward = surface::direction_from_octahedral(vertex.ox, vertex.oy);
  const float depth_mm =
      depth_samples * static_cast<float>(stride) * static_cast<float>(grid_.min_spacing_mm());
  const Vec3i voxel = grid_.voxel_at((at_mm - depth_mm * outward).cast<double>());
  const Vec3i nearest = voxel.cwiseMax(0).cwiseMin(grid_.dims.array().matrix() - Vec3i::Ones());
  return class_of_code_[density_[grid_.index(nearest)]];
}

std::vector<uint8_t> SurfaceClasses::packed(std::span<const surface::BlockVertex> vertices, uint32_t block,
                                            int stride) const {
  if (density_.empty()) return {};
  std::vector<uint8_t> bytes((vertices.size() + vertices_per_byte - 1) / vertices_per_byte);
  for (size_t i = 0; i < vertices.size(); ++i)
    bytes[i / vertices_per_byte] |= static_cast<uint8_t>(
        static_cast<unsigned>(under(vertices[i], block, stride)) << (2 * (i % vertices_per_byte)));
  return bytes;
}

}  // namespace ream::stream
