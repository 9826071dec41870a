#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "render/snapshot.hpp"
#include "voxel/bone_model.hpp"

namespace ream::python {

/// What a pixel shows; ream.Label has the same numbers.
enum class PixelLabel : uint8_t { nothing = 0, cancellous = 1, cortical = 2, cartilage = 3, reamer = 4 };

inline constexpr int max_picture_edge_pixels = 4096;
/// Of the camera in front of the glenoid.
inline constexpr double default_camera_distance_mm = 105.0;

/// Bone as it is, and the reamer in it.
struct VoxelScene {
  const voxel::BoneModel& bone;
  const uint8_t* coverage_before;        ///< before the first tick, as bone.coverage
  const TriangleMesh* reamer = nullptr;  ///< null: none; reamer frame
  Pose grid_from_reamer = {};
};

/// Pixels row after row, top row first; all four show the same rays.
struct VoxelPicture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;     ///< three a pixel
  std::vector<float> depth_mm;  ///< along the viewing direction; infinite where nothing is seen
  std::vector<uint8_t> labels;  ///< PixelLabel
  std::vector<uint8_t> cut;     ///< 1 where bone was cut (surface::cut_share)
};

/// One ray through the middle of each pixel, to where trilinear coverage crosses one half. The same numbers
/// on every machine, but for the last bit of the field of view's tangent. `camera`: world frame. Error
/// invalid_input for cameras and sizes that cannot be.
VoxelPicture draw_voxels(const VoxelScene& scene, const Pose& grid_from_world, const render::Camera& camera,
                         int width, int height);

}  // namespace ream::python
