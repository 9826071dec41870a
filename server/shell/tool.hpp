#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream::shell {

/// What a piece of the tool's surface does: only cutting removes bone and defines the density that is felt;
/// guiding (nipple) may touch but never removes; smooth is the back and the rim.
enum class SurfaceRole : uint8_t { cutting = 0, guiding = 1, smooth = 2 };

/// Corner of the meridian of the tool, tool frame: radius from the axis and height along it, mm.
struct ProfilePoint {
  double radius_mm = 0.0, z_mm = 0.0;
};

/// The envelope swept by the spindle as a surface of revolution about z. The meridian runs from the tip on the
/// axis (radius 0, largest z) outwards and back to the axis behind the tool; segment i joins points i and i+1 and
/// has roles[i]. The tool frame's origin is the apex of the cutting surface continued to the axis, so a nipple reaches to
/// positive z. Bodies are closed: the last point is on the axis again.
struct ToolProfile {
  std::vector<ProfilePoint> points;
  std::vector<SurfaceRole> roles;

  double max_radius_mm() const;
  double min_z_mm() const;
  double max_z_mm() const;
};

/// A reamer in its own frame. For meshes, `mesh` is the file's surface in the tool frame and the profile is measured
/// from it; for parametric tools `mesh` is the profile revolved.
struct Tool {
  std::string name;  ///< as it was asked for
  TriangleMesh mesh;
  ToolProfile profile;
  Pose tool_from_mesh;
};

/// Axis of a mesh tool in the file's coordinates: a point on it and the feed direction.
struct ToolAxis {
  Vec3 point_mm = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
};

/// "sphere R", "ellipse a,b" (semi-axes across and along the axis, mm), each optionally followed by
/// " nipple r,h", or the path of a mesh (needs an axis, or one is estimated from the mesh's revolution symmetry).
/// Errors: usage for unknown words or impossible numbers; those of load_mesh.
Tool make_tool(const std::string& description, const std::optional<ToolAxis>& axis = std::nullopt);

/// The profile revolved into `segments` sides, closed, counter-clockwise from outside. For pictures and voxelization
/// of parametric tools.
TriangleMesh revolve(const ToolProfile& profile, int segments);

}  // namespace ream::shell
