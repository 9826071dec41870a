#pragma once
#include <vector>

#include "score/bone_surface.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {

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

}  // namespace ream::score
