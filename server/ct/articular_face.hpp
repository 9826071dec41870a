#pragma once
#include <vector>

#include "case/case.hpp"

namespace ream::ct {

/// The face of a glenoid as a height map: cells `step_mm` wide along superior and anterior, each with how far
/// lateral of the centre its surface lies.
struct ArticularFace {
  double step_mm = 0.0;
  int half_cells = 0;               ///< cells from -half_cells to half_cells either way
  std::vector<double> height_mm;    ///< smoothed; NaN where there is no face
  std::vector<double> cosine;       ///< of the angle between the surface's normal and lateral
  std::vector<double> from_rim_mm;  ///< along the face, 0 outside it

  int across() const { return 2 * half_cells + 1; }
  size_t index(int superior, int anterior) const {
    return static_cast<size_t>((anterior + half_cells) * across() + superior + half_cells);
  }
};

/// The sheet of bone around the glenoid's centre, looked at from lateral: cells within `reach_mm` whose
/// surface lies within 10 mm of the centre's plane, connected to the centre over slopes of less than 55
/// degrees. Throws Error invalid_input when there is no bone under the centre.
ArticularFace articular_face(const voxel::BoneModel& bone, const case_::GlenoidFrame& glenoid,
                             double reach_mm);

}  // namespace ream::ct
