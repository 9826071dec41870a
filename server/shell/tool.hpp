#pragma once
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

/// The envelope swept by the spindle as a surface of revolution about z. The meridian runs from the tip on
/// the axis (radius 0, largest z) outwards and back to the axis behind the tool; segment i joins points i and
/// i+1 and has roles[i]. The tool frame's origin is the apex of the cutting surface continued to the axis, so
/// a nipple reaches to positive z. Bodies are closed: the last point is on the axis again.
struct ToolProfile {
  std::vector<ProfilePoint> points;
  std::vector<SurfaceRole> roles;

  double max_radius_mm() const;
  double min_z_mm() const;
  double max_z_mm() const;
};

/// A reamer in its own frame. For meshes, `mesh` is the file's surface in the tool frame and the profile is
/// measured from it; for parametric tools `mesh` is the profile revolved.
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

/// The reamer of the bench case: as a point shell of 0.1 mm it has the 213 thousand points of the thesis
/// (section 5.4.2). Asked for by the word "thesis" or by this text.
inline constexpr const char* thesis_tool = "ellipse 16,8 nipple 3,8 back 1.25";

/// A tool by words or from a mesh file. Words, lengths in mm:
/// - "sphere R[,outer]": cutting cap of radius R, by default out to the smaller of R and 18.25;
/// - "ellipse a,b": cutting cap with semi-axes a across and b along the axis (thesis, appendix A);
/// - each optionally followed by " nipple r,h" (radius, height above the apex) and " back H" (height of the
///   cylinder behind the cap, by default 4);
/// - the name of a built-in reamer (reamer_library.hpp), such as "thesis".
///
/// Anything else is the path of a mesh, which needs an axis, or one is estimated from its symmetry of
/// revolution. Errors: usage for unknown words or impossible numbers; invalid_input for a mesh whose axis
/// cannot be found or that does not reach it; those of load_mesh.
Tool make_tool(const std::string& description, const std::optional<ToolAxis>& axis = std::nullopt);

/// The profile revolved into `segments` sides, closed, counter-clockwise from outside. For pictures and
/// voxelization of parametric tools.
TriangleMesh revolve(const ToolProfile& profile, int segments);

}  // namespace ream::shell
