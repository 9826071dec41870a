#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec.hpp"

namespace ream::ct {

/// Lowest HU kept: what scanners write outside their field of view (-2000, -3024) is air to us.
inline constexpr int16_t min_hu = -1024;

/// Whose CT it is, as the scanner's files say. Kept only when asked for (ReadOptions::keep_names).
struct PatientNames {
  std::string name, id;
};

/// A CT in memory, HU, x fastest. Voxel (u,v,w) fills [(u,v,w), (u,v,w)+1] * spacing of the volume frame,
/// whose origin is the minimum corner (half a voxel before the first voxel's centre). World is LPS mm.
struct HuVolume {
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones();
  Pose world_from_volume;
  std::vector<int16_t> hu;
  std::string source;                 ///< for people, without patient names
  std::vector<std::string> warnings;  ///< what was odd or repaired while reading; no names of files or people
  std::optional<PatientNames> patient;

  size_t voxel_count() const {
    return static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y()) * static_cast<size_t>(dims.z());
  }
  size_t index(int u, int v, int w) const {
    return static_cast<size_t>(u) +
           static_cast<size_t>(dims.x()) *
               (static_cast<size_t>(v) + static_cast<size_t>(dims.y()) * static_cast<size_t>(w));
  }
  Vec3 world_of_centre(const Vec3i& o) const {
    return world_from_volume.point(((o.cast<double>().array() + 0.5) * spacing_mm.array()).matrix());
  }
  /// Voxel that holds a world point; may lie outside.
  Vec3i voxel_at_world(const Vec3& world_mm) const {
    const Vec3 p = world_from_volume.inverse().point(world_mm);
    return (p.array() / spacing_mm.array()).floor().cast<int>().matrix();
  }
  bool contains(const Vec3i& o) const { return (o.array() >= 0).all() && (o.array() < dims.array()).all(); }
};

/// The voxels that touch the world box `roi_mm` (its bounding box in the volume's axes when those are
/// oblique). Throws Error invalid_input when the box has no volume or does not meet the CT.
HuVolume cropped(const HuVolume& volume, const Aabb& roi_mm);

/// Gaussian of standard deviation `sigma_mm`, separable, edges repeated, rounded to whole HU after each axis.
/// Sigma 0 returns the volume unchanged. Throws Error invalid_input for a negative sigma or one above 20
/// voxels.
void smooth(HuVolume& volume, double sigma_mm);

/// One slice of a volume across a voxel axis (0 u, 1 v, 2 w), rows of the lower remaining axis first: across
/// w it is nx * ny with x fastest, across v nx * nz with x fastest, across u ny * nz with y fastest. Needs an
/// index within the dims.
template <typename T>
std::vector<T> slice_of(std::span<const T> voxels, const Vec3i& dims, int axis, int index) {
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y()),
             nz = static_cast<size_t>(dims.z());
  const size_t step[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
  const size_t across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
  const size_t first = static_cast<size_t>(index) * step[axis];
  std::vector<T> slice;
  slice.reserve(count[across] * count[down]);
  for (size_t row = 0; row < count[down]; ++row)
    for (size_t i = 0; i < count[across]; ++i)
      slice.push_back(voxels[first + row * step[down] + i * step[across]]);
  return slice;
}

/// "x,y,z" with one decimal each, for messages.
inline std::string text_of_point(const Vec3& p) {
  const auto one = [](double v) {
    const std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 2);
  };
  return one(p.x()) + "," + one(p.y()) + "," + one(p.z());
}

}  // namespace ream::ct
