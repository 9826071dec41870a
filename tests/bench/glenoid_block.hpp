#pragma once
#include <vector>

#include "bench/baselines/flat_kernel.hpp"
#include "voxel/bone_model.hpp"

namespace ream::bench {

/// The bone of tables 4.1 to 4.5: in a cube of 64 mm, a glenoid-like block, an elliptic column of 28 x 40 mm
/// with a hollow spherical face of radius 35 mm towards +z. The same shape at every resolution.
inline constexpr double glenoid_cube_mm = 64.0;

/// `resolution` voxels a side, a multiple of 8. Density falls from cortical at the face to cancellous under
/// it.
voxel::BoneModel glenoid_block(int resolution);

/// The tool in front of the face, its apex `depth_mm` deep along the face's axis, shifted across it and
/// tilted.
QuantisedPose pose_at_face(double depth_mm, const Vec3& shift_mm = Vec3::Zero(),
                           const Vec3& tilt_rad = Vec3::Zero());

/// Seeded poses of severe collision: off the axis by up to 3 mm, tilted by up to 0.15 rad about each axis,
/// and so deep that a share of the points, spread evenly over 5 to 20 %, is inside.
std::vector<QuantisedPose> severe_poses(const MortonShell& shell, int count, unsigned seed);

}  // namespace ream::bench
