#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "case/landmarks.hpp"
#include "score/bone_surface.hpp"
#include "score/cutting_surface.hpp"
#include "score/ray_lattice.hpp"
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
  static constexpr double min_spacing_mm = 0.25;  ///< of points nearer to each other one is enough
  static uint64_t key_of(const Vec3i& cell);

  std::vector<Vec3f> points_mm_;  ///< cell after cell, relative to origin_mm_
  Vec3 origin_mm_ = Vec3::Zero();
  std::unordered_map<uint64_t, std::pair<uint32_t, uint32_t>> cells_;  ///< first and end
};

/// The dense plate under the face, along rays. Density shows it where the bone within 1.5 mm of the surface
/// is denser by at least 0.25 g/cc than that 4 to 6 mm below (medians over the face); it ends where density
/// falls below the middle of both. Rays on which it does not end within 5 mm (they run along the shell), or
/// does not begin, get the median thickness. Where density does not show it at all it is 1.9 mm thick (Frich
/// 1998).
struct SubchondralPlate {
  static constexpr double assumed_mm = 1.9;

  bool found_by_density = false;
  double median_mm = assumed_mm;  ///< along the rays
  std::vector<double>
      thickness_mm;  ///< of every ray, from the subchondral surface on; of rays of the face only
};

/// `subchondral_mm`: depth of bone, cartilage left out, of every ray; `face`: rays that count.
SubchondralPlate find_plate(const voxel::BoneModel& bone, const RayLattice& rays,
                            const std::vector<double>& subchondral_mm, const std::vector<uint8_t>& face);

/// What a session is measured against, beside the bone itself.
struct Task {
  case_::Anatomy anatomy;
  std::optional<case_::Plan> plan;
  shell::ToolProfile reamer;  ///< the last that was used
};

/// A glenoid before anything was done to it (the pilot hole is not cut either), measured along rays that are
/// parallel to the planned axis; without a plan to the inverse normal of the glenoid's frame. Everything that
/// scoring needs to know of the untouched bone, made once a session (about 0.2 s for a glenoid at 0.2 mm).
/// Rays reach 10 mm beyond the reamer, 0.25 mm apart.
class NativeGlenoid {
 public:
  static constexpr double spacing_mm = 0.25, beyond_reamer_mm = 10.0;

  /// `native`: the untouched bone; not needed afterwards. Error invalid_input without plan and glenoid frame.
  NativeGlenoid(Task task, const voxel::BoneModel& native);

  const Task& task() const { return task_; }
  const RayLattice& rays() const { return rays_; }
  /// Of every ray, mm: where it meets the face first (cartilage, where there is some), where bone begins, and
  /// where it leaves the bone again; no_surface_mm where it does not.
  const std::vector<double>& surface_mm() const { return surface_mm_; }
  const std::vector<double>& subchondral_mm() const { return subchondral_mm_; }
  const std::vector<double>& exit_mm() const { return exit_mm_; }
  /// 1: the ray meets the face, which is what is connected to its middle without a slope of over 60 degrees
  /// against the rays, without its outermost quarter millimetre (of coarser bone, as many quarters as make a
  /// voxel), and does not run into the pilot hole.
  const std::vector<uint8_t>& face() const { return face_; }
  const SubchondralPlate& plate() const { return plate_; }
  const OuterCortex& outer_cortex() const { return *outer_cortex_; }
  const CuttingMeridian& reamer() const { return reamer_; }
  /// On every `stride`-th ray each way; shares the outer cortex.
  NativeGlenoid thinned(int stride) const;

 private:
  NativeGlenoid() = default;
  void find_depths(const voxel::BoneModel& native);
  void leave_out_pilot_hole(double margin_mm);
  std::vector<uint8_t> connected_to_middle() const;
  std::vector<uint8_t> without_edge(const std::vector<uint8_t>& face) const;
  void find_outer_cortex(const voxel::BoneModel& native);

  Task task_;
  CuttingMeridian reamer_;
  RayLattice rays_;
  std::vector<double> surface_mm_, subchondral_mm_, exit_mm_;
  std::vector<uint8_t> face_;
  SubchondralPlate plate_;
  std::shared_ptr<const OuterCortex> outer_cortex_;
};

}  // namespace ream::score
