#pragma once
#include <string>
#include <vector>

#include "fe/element_codes.hpp"
#include "fe/voxel_mask.hpp"
#include "geometry/pose.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::fe {

/// What becomes a mesh: an element for every voxel of the mask, with its gray value. Elements are numbered in
/// the order of the mask's bits. The mesh frame has its axes along the grid's: voxel (u,v,w) fills
/// [(u,v,w), (u,v,w)+1] * spacing_mm + origin_mm.
struct ElementModel {
  VoxelMask mask;
  ElementCodes codes;
  voxel::GrayScale gray;
  Vec3 spacing_mm = Vec3::Ones(), origin_mm = Vec3::Zero();
  Pose world_from_mesh;               ///< to LPS mm; identity where the grid's axes are those of the world
  std::string source;                 ///< for people, without patient names
  std::vector<std::string> remarks;   ///< what was odd or left out
  bool gray_is_density_g_cc = false;  ///< apparent density; else nothing is known of the scale
};

}  // namespace ream::fe
