#pragma once
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "report/material.hpp"

namespace ream::report {

/// An axis in the world; `direction` into the bone.
struct WorldAxis {
  Vec3 point_mm = Vec3::Zero(), direction = Vec3::UnitX();
};

/// What a session did to a bone, for pictures. Surfaces in the grid frame, mm.
struct ReamedBone {
  TriangleMesh before, after;  ///< both with the pilot hole
  std::vector<float> removed;  ///< of `after`, see surface::removed_shares
  /// Of `after`, see score/deviation.hpp; empty when there is nothing to compare with.
  std::vector<int8_t> from_plan, from_implant;
  std::vector<int8_t> wall;  ///< see score::wall_codes; empty when nothing of the face was reamed
  Pose world_from_grid;
  case_::Plan plan;
  case_::Side side = case_::Side::right;
  std::optional<case_::GlenoidFrame> glenoid;
  std::optional<WorldAxis> achieved;
};

/// Before, after, maps of deviation, planned and achieved axis from below and from the front. Views are along
/// the planned axis; superior and anterior are those of the glenoid frame, without one the patient's.
std::vector<Picture> session_pictures(const ReamedBone& bone);

/// The face, coloured by strain under a component: `codes` of the vertices of `after`, see strain_colours().
Picture strain_picture(const ReamedBone& bone, const std::vector<int8_t>& codes);

}  // namespace ream::report
