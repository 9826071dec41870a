#include "report/session_pictures.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/split_mesh.hpp"
#include "render/camera.hpp"
#include "report/deviation_scale.hpp"
#include "shell/tool.hpp"
#include "surface/removed_share.hpp"

namespace ream::report {
namespace {

constexpr int picture_width = 960, picture_height = 720;
constexpr double aspect = static_cast<double>(picture_width) / picture_height;
constexpr double distance_mm = 420.0;
constexpr double face_half_height_mm = 25.0, axis_half_height_mm = 30.0, oblique_half_height_mm = 32.0;
constexpr double rod_radius_mm = 0.7, rod_outside_mm = 34.0, rod_inside_mm = 18.0, dash_mm = 3.0;
const Vec3f planned_ink{0.02f, 0.02f, 0.02f}, achieved_ink{0.72f, 0.10f, 0.02f};

/// Directions in which pictures are taken, world, unit, square to each other.
struct Directions {
  Vec3 medial, superior, anterior;
};

Directions directions_of(const ReamedBone& bone) {
  Directions d;
  d.medial = bone.plan.axis_direction.normalized();
  const Vec3 up = bone.glenoid ? bone.glenoid->superior : Vec3(Vec3::UnitZ());
  const Vec3 front = bone.glenoid ? bone.glenoid->anterior : Vec3(-Vec3::UnitY());
  d.superior = up - d.medial * d.medial.dot(up);
  if (d.superior.norm() < 1e-6) d.superior = rotation_with_z_along(d.medial).col(0);
  d.superior.normalize();
  d.anterior = d.medial.cross(d.superior);
  if (d.anterior.dot(front) < 0.0) d.anterior = -d.anterior;
  return d;
}

render::Camera camera_from(const Vec3& target_mm, const Vec3& towards_eye, const Vec3& up,
                           double half_height_mm) {
  render::Camera camera;
  camera.target_mm = target_mm;
  camera.eye_mm = target_mm + distance_mm * towards_eye.normalized();
  camera.up = up;
  camera.vertical_field_of_view_rad = 2.0 * std::atan(half_height_mm / distance_mm);
  return camera;
}

void add_label(Picture& picture, const render::Camera& camera, const Vec3& at_mm, const std::string& words) {
  if (const auto place = render::place_in_picture(camera, aspect, at_mm))
    picture.labels.push_back({(*place)[0], (*place)[1], words});
}

render::Layer layer_of(const TriangleMesh& mesh, const ReamedBone& bone,
                       const std::vector<render::VertexColour>* colours = nullptr) {
  render::Layer layer;
  layer.mesh = &mesh;
  layer.world_from_mesh = bone.world_from_grid;
  layer.colours = colours;
  return layer;
}

/// Superior, anterior and so on at the borders of a picture that looks along the axis.
void add_face_labels(Picture& picture, const render::Camera& camera, const Directions& d) {
  const double up = 0.92 * face_half_height_mm, side = 0.84 * aspect * face_half_height_mm;
  add_label(picture, camera, camera.target_mm + up * d.superior, "superior");
  add_label(picture, camera, camera.target_mm - up * d.superior, "inferior");
  add_label(picture, camera, camera.target_mm + side * d.anterior, "anterior");
  add_label(picture, camera, camera.target_mm - side * d.anterior, "posterior");
}

Picture oblique(const ReamedBone& bone, const std::vector<render::Layer>& layers, const Directions& d) {
  const Vec3 eye = -0.86 * d.medial + 0.30 * d.superior + 0.41 * d.anterior;
  const render::Camera camera = camera_from(bone.plan.entry_mm, eye, d.superior, oblique_half_height_mm);
  Picture picture;
  picture.image = render::draw(layers, camera, picture_width, picture_height);
  return picture;
}

Picture before(const ReamedBone& bone, const Directions& d) {
  Picture picture = oblique(bone, {layer_of(bone.before, bone)}, d);
  picture.title = "Before";
  picture.caption = "The glenoid as it was given to the trainee.";
  if (bone.plan.pilot_hole)
    picture.caption = "The glenoid as it was given to the trainee, its pilot hole drilled.";
  return picture;
}

Picture after(const ReamedBone& bone, const Directions& d) {
  const auto [rest, fresh] = split_at(bone.after, bone.removed, surface::cut_share);
  std::vector<render::Layer> layers = {layer_of(rest, bone), layer_of(fresh, bone)};
  layers[1].colour = render::cut_bone_colour;
  Picture picture = oblique(bone, layers, d);
  picture.title = "After";
  picture.caption = fresh.triangles.empty() ? "Nothing was cut." : "The reamed area is dark red.";
  return picture;
}

Picture painted_face(const ReamedBone& bone, const std::vector<render::VertexColour>& colours,
                     const Directions& d) {
  const render::Camera camera = camera_from(bone.plan.entry_mm, -d.medial, d.superior, face_half_height_mm);
  Picture picture;
  picture.image = render::draw({layer_of(bone.after, bone, &colours)}, camera, picture_width, picture_height);
  add_face_labels(picture, camera, d);
  return picture;
}

Picture face_map(const ReamedBone& bone, const std::vector<int8_t>& codes, const Directions& d) {
  Picture picture = painted_face(bone, deviation_colours(codes), d);
  picture.is_map = true;
  return picture;
}

Picture wall_map(const ReamedBone& bone, const Directions& d) {
  Picture picture = painted_face(bone, wall_colours(bone.wall), d);
  picture.title = "Bone left behind the reamed face";
  picture.caption = "Along its normal, from dark to light: " + wall_classes_in_words() + ".";
  return picture;
}

TriangleMesh rod(const WorldAxis& axis, bool dashed) {
  TriangleMesh mesh;
  const Pose world_from_axis{rotation_with_z_along(axis.direction), axis.point_mm};
  const double step_mm = dashed ? 2.0 * dash_mm : rod_outside_mm + rod_inside_mm;
  for (double from = -rod_outside_mm; from < rod_inside_mm; from += step_mm) {
    const double to = std::min(from + (dashed ? dash_mm : step_mm), rod_inside_mm);
    shell::ToolProfile profile;
    profile.points = {{0.0, to}, {rod_radius_mm, to}, {rod_radius_mm, from}, {0.0, from}};
    profile.roles.assign(3, shell::SurfaceRole::smooth);
    const TriangleMesh piece = shell::revolve(profile, 16).transformed(world_from_axis);
    const auto base = static_cast<uint32_t>(mesh.vertices_mm.size());
    mesh.vertices_mm.insert(mesh.vertices_mm.end(), piece.vertices_mm.begin(), piece.vertices_mm.end());
    for (const auto& t : piece.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  return mesh;
}

/// Planned axis dashed, achieved whole, in the bone as if it were glass.
Picture axes(const ReamedBone& bone, const Directions& d, const render::Camera& camera) {
  const WorldAxis planned{bone.plan.entry_mm, d.medial};
  std::vector<TriangleMesh> rods = {rod(planned, true)};
  if (bone.achieved) rods.push_back(rod(*bone.achieved, false));
  std::vector<render::Layer> layers;
  for (size_t i = 0; i < rods.size(); ++i) {
    render::Layer layer;
    layer.mesh = &rods[i];
    layer.colour = i == 0 ? planned_ink : achieved_ink;
    layers.push_back(layer);
  }
  render::Layer glass = layer_of(bone.after, bone);
  glass.opacity = 0.45f;
  layers.push_back(glass);
  Picture picture;
  picture.image = render::draw(layers, camera, picture_width, picture_height);
  return picture;
}

Picture axes_from_below(const ReamedBone& bone, const Directions& d) {
  const render::Camera camera = camera_from(bone.plan.entry_mm, -d.superior, d.anterior, axis_half_height_mm);
  Picture picture = axes(bone, d, camera);
  picture.title = "Axis from below";
  picture.caption = "As an axial slice is read: version. Planned axis dashed, achieved axis whole.";
  const double up = 0.92 * axis_half_height_mm, side = 0.86 * aspect * axis_half_height_mm;
  add_label(picture, camera, camera.target_mm + up * d.anterior, "anterior");
  add_label(picture, camera, camera.target_mm - up * d.anterior, "posterior");
  add_label(picture, camera, camera.target_mm - side * d.medial, "lateral");
  return picture;
}

Picture axes_from_the_front(const ReamedBone& bone, const Directions& d) {
  const render::Camera camera = camera_from(bone.plan.entry_mm, d.anterior, d.superior, axis_half_height_mm);
  Picture picture = axes(bone, d, camera);
  picture.title = "Axis from the front";
  picture.caption = "Inclination. Planned axis dashed, achieved axis whole.";
  const double up = 0.92 * axis_half_height_mm, side = 0.86 * aspect * axis_half_height_mm;
  add_label(picture, camera, camera.target_mm + up * d.superior, "superior");
  add_label(picture, camera, camera.target_mm - up * d.superior, "inferior");
  add_label(picture, camera, camera.target_mm - side * d.medial, "lateral");
  return picture;
}

}  // namespace

Picture strain_picture(const ReamedBone& bone, const std::vector<int8_t>& codes) {
  Picture picture = painted_face(bone, strain_colours(codes), directions_of(bone));
  picture.title = "Strain of the bone under the component, as reamed";
  picture.caption = "The greatest of all loads, from light to dark: " + strain_classes_in_words() + ".";
  return picture;
}

std::vector<Picture> session_pictures(const ReamedBone& bone) {
  const Directions d = directions_of(bone);
  std::vector<Picture> pictures;
  pictures.push_back(before(bone, d));
  pictures.push_back(after(bone, d));
  if (!bone.from_plan.empty()) {
    pictures.push_back(face_map(bone, bone.from_plan, d));
    pictures.back().title = "Achieved against planned surface";
    pictures.back().caption =
        "Too high: bone that the plan removes is left. Too deep (hatched): deeper than planned.";
  }
  if (!bone.from_implant.empty()) {
    pictures.push_back(face_map(bone, bone.from_implant, d));
    pictures.back().title = "Gap to the seated implant";
    pictures.back().caption =
        "Too high: bone stands where the implant is. Too deep (hatched): a gap behind the implant.";
  }
  if (!bone.wall.empty()) pictures.push_back(wall_map(bone, d));
  pictures.push_back(axes_from_below(bone, d));
  pictures.push_back(axes_from_the_front(bone, d));
  return pictures;
}

}  // namespace ream::report
