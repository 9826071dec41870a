#include "ct/phantom_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "ct/phantom_distance.hpp"

namespace ream::ct {
namespace {

// Where the glenoid lies in the world of a right shoulder, LPS mm.
const Vec3 glenoid_centre_mm(-150.0, -10.0, 20.0);

constexpr double medial_end_mm = 103.0;

constexpr double rim_rounding_mm = 0.8, joint_rounding_mm = 3.0;
constexpr double head_radius_mm = PhantomShape::head_radius_mm, shaft_radius_mm = 12.0;

// Central wear: how far the face lies medial, and by how much its radius exceeds that of head and joint
// space.
constexpr double central_wear_mm = 4.0, worn_radius_excess_mm = 1.0;

/// sin and cos of the platform's library can differ in the last bit; rounded far below any voxel they do not.
double settled(double v) { return std::floor(v * 1099511627776.0 + 0.5) / 1099511627776.0; }
double sine(double a) { return settled(std::sin(a)); }
double cosine(double a) { return settled(std::cos(a)); }
double tangent(double a) { return settled(std::tan(a)); }

double triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, normal = ab.cross(-ca);
  const bool above = normal.cross(ab).dot(p - a) >= 0 && normal.cross(bc).dot(p - b) >= 0 &&
                     normal.cross(ca).dot(p - c) >= 0;
  if (above) return std::abs(normal.dot(p - a)) / normal.norm();
  return std::min({capsule(p, a, b, 0, 0), capsule(p, b, c, 0, 0), capsule(p, c, a, 0, 0)});
}

/// Smooth step between knots: value at `x` of a piecewise curve with flat tangents at its knots.
template <size_t N>
double eased(const double (&at)[N], const double (&value)[N], double x) {
  if (x <= at[0]) return value[0];
  for (size_t i = 1; i < N; ++i)
    if (x < at[i]) {
      const double t = (x - at[i - 1]) / (at[i] - at[i - 1]);
      return value[i - 1] + (value[i] - value[i - 1]) * t * t * (3.0 - 2.0 * t);
    }
  return value[N - 1];
}

}  // namespace

PhantomShape::PhantomShape(const PhantomParams& params) : params_(params), centre_(glenoid_centre_mm) {
  const double c = cosine(params.scapular_plane_rad), s = sine(params.scapular_plane_rad);
  lateral_ = Vec3(-c, -s, 0.0);
  superior_ = Vec3::UnitZ();
  posterior_ = Vec3(-s, c, 0.0);
  // Science 2.1: version = -atan2(n.z, n.x), inclination = atan2(n.y, n.x).
  face_normal_ =
      (lateral_ + tangent(params.inclination_rad) * superior_ - tangent(params.version_rad) * posterior_)
          .normalized();
  face_superior_ = (superior_ - superior_.dot(face_normal_) * face_normal_).normalized();
  const Vec3 across = face_superior_.cross(face_normal_);
  face_anterior_ = across.dot(posterior_) < 0.0 ? across : Vec3(-across);
  medial_in_face_ =
      -Vec3(lateral_.dot(face_superior_), lateral_.dot(face_anterior_), lateral_.dot(face_normal_));
  const bool worn = params.type == PhantomType::a2;
  worn_centre_ = worn ? Vec3(centre_ - central_wear_mm * lateral_) : centre_;
  face_radius_mm_ =
      worn ? head_radius_mm + params.joint_space_mm + worn_radius_excess_mm : params.glenoid_radius_mm;
  sphere_centre_ = worn_centre_ + face_radius_mm_ * face_normal_;
  head_centre_ = worn_centre_ + (params.joint_space_mm + head_radius_mm) * face_normal_;
  if (params.type == PhantomType::b2) carve_neoglenoid();
}

double PhantomShape::depth_under_face_mm(const Vec3& world_mm) const {
  const double depth = (world_mm - sphere_centre_).norm() - face_radius_mm_;
  return neoglenoid_ ? std::min(depth, depth_under_neoglenoid_mm(world_mm)) : depth;
}

double PhantomShape::posterior_mm(const Vec3& world_mm) const {
  return -(world_mm - centre_).dot(face_anterior_);
}

/// Vault, neck and body: egg-shaped sections whose half axes change with the depth along -x. Scaled to about
/// mm.
double PhantomShape::body_value(const Vec3& offset) const {
  double s = offset.dot(face_superior_), t = offset.dot(face_anterior_), depth = 0.0;
  const double height_above = offset.dot(face_normal_);
  if (height_above < 0.0) {
    depth = height_above / medial_in_face_.z();
    s -= depth * medial_in_face_.x();
    t -= depth * medial_in_face_.y();
  }
  // Share of the face's half width left at a depth, then half thickness of the body; and growth of the
  // heights.
  static constexpr double depth_at[] = {0.0, 24.0, 45.0, 60.0};
  static constexpr double thickness_share[] = {1.0, 0.50, 0.22, 0.20};
  static constexpr double lower_at[] = {0.0, 14.0, 40.0, 80.0};
  static constexpr double lower_share[] = {1.0, 0.92, 2.6, 7.0};
  static constexpr double upper_share[] = {1.0, 0.85, 1.2, 1.6};
  const double height = params_.glenoid_height_mm;
  const double half_width = 0.5 * params_.glenoid_width_mm * eased(depth_at, thickness_share, depth);
  const double lower =
      (0.5 - PhantomShape::widest_below_middle) * height * eased(lower_at, lower_share, depth);
  const double upper =
      (0.5 + PhantomShape::widest_below_middle) * height * eased(lower_at, upper_share, depth);
  const double from_widest = s + PhantomShape::widest_below_middle * height;
  const double along = from_widest / (from_widest < 0.0 ? lower : upper), across = t / half_width;
  const double section = (std::sqrt(along * along + across * across) - 1.0) * half_width;
  return rounded_max(section, depth - medial_end_mm, joint_rounding_mm);
}

/// Spine, acromion and coracoid, scapular frame.
double PhantomShape::processes_value(const Vec3& p) const {
  const Vec3 notch(-14.0, 12.0, 20.0), corner(8.0, 26.0, 34.0), tip(30.0, 34.0, 8.0);
  const Vec3 neck_top(-28.0, 10.0, 2.0), spine_start(-103.0, 0.0, 1.0);
  double d = triangle_distance(p, spine_start, neck_top, notch) - 1.6;
  d = rounded_min(d, capsule(p, spine_start, notch, 2.5, 4.5), joint_rounding_mm);
  d = rounded_min(d, capsule(p, notch, corner, 4.5, 5.5), joint_rounding_mm);
  d = rounded_min(d, capsule(p, corner, tip, 5.5, 5.0), joint_rounding_mm);
  const Vec3 coracoid_base(-16.0, 15.0, -2.0), coracoid_bend(-10.0, 32.0, -14.0),
      coracoid_tip(10.0, 27.0, -34.0);
  d = std::min(d, rounded_min(capsule(p, coracoid_base, coracoid_bend, 6.0, 6.0),
                              capsule(p, coracoid_bend, coracoid_tip, 6.0, 4.5), joint_rounding_mm));
  return d;
}

double PhantomShape::scapula_value(const Vec3& world_mm) const {
  const Vec3 offset = world_mm - centre_;
  const Vec3 in_scapula(offset.dot(lateral_), offset.dot(superior_), offset.dot(posterior_));
  const double above = offset.dot(face_normal_);
  double d = rounded_max(body_value(offset), -depth_under_face_mm(world_mm), rim_rounding_mm);
  d = std::max(d, above - 0.5 * params_.glenoid_radius_mm);
  if (params_.type == PhantomType::osteophytes)
    d = rounded_min(d, osteophytes_value(world_mm), rim_rounding_mm);
  return rounded_min(d, processes_value(in_scapula), joint_rounding_mm);
}

double PhantomShape::scapula_mm(const Vec3& world_mm) const {
  constexpr double near_mm = 6.0, step = 0.01;
  const double value = scapula_value(world_mm);
  // Far from the surface the scale of the implicit function does not matter.
  if (std::abs(value) > near_mm) return value;
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = step * Vec3::Unit(axis);
    gradient[axis] = (scapula_value(world_mm + along) - scapula_value(world_mm - along)) / (2.0 * step);
  }
  return value / std::max(0.3, gradient.norm());
}

double PhantomShape::humerus_mm(const Vec3& world_mm) const {
  const double head = (world_mm - head_centre_).norm() - head_radius_mm;
  const Vec3 shaft_top = head_centre_ + 10.0 * lateral_;
  const Vec3 shaft_end = shaft_top + Vec3(0.0, 0.0, -300.0) + 20.0 * lateral_;
  return rounded_min(head, capsule(world_mm, shaft_top, shaft_end, shaft_radius_mm, shaft_radius_mm), 6.0);
}

}  // namespace ream::ct
