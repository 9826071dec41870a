#pragma once
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "score/bone_surface.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {

/// The surface of the untouched bone but for its face: what a peg must not come through. Points where the
/// coverage crosses its middle between neighbouring voxels, found again by place.
class OuterCortex {
 public:
  OuterCortex() = default;
  /// Within a world box; `is_face` says which points belong to the face and are left out.
  OuterCortex(const voxel::BoneModel& native, const Aabb& world_box_mm,
              const std::function<bool(const Vec3& world_mm)>& is_face);

  /// Distance to the nearest point, mm; empty when there is none within `reach_mm`.
  std::optional<double> distance_mm(const Vec3& world_mm, double reach_mm) const;
  size_t size() const { return points_mm_.size(); }

 private:
  static constexpr double cell_mm = 2.0;
  static constexpr double finest_mm = 0.25;  ///< of points nearer to each other one is enough
  static uint64_t key_of(const Vec3i& cell);

  std::vector<Vec3f> points_mm_;  ///< cell after cell, relative to origin_mm_
  Vec3 origin_mm_ = Vec3::Zero();
  std::unordered_map<uint64_t, std::pair<uint32_t, uint32_t>> cells_;  ///< first and end
};

}  // namespace ream::score
