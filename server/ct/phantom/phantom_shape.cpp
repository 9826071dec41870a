#include "ct/phantom/phantom_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "ct/phantom/implicit_solids.hpp"

namespace ream::ct {
namespace {

// Where the glenoid lies in the world of a right shoulder, LPS mm.
const Vec3 glenoid_centre_mm(-150.0, -10.0, 20.0);

constexpr double medial_end_mm = 103.0;

const double max_version_rad = radians_from_degrees(50.0);
constexpr double min_gradient = 0.3;
constexpr double least_gap_mm = 2.0;  // between the humerus and acromion or coracoid
constexpr double rim_rounding_mm = 0.8;
constexpr double shaft_radius_mm = 12.0;

// Wear: how far the face lies medial (B3: 14 +- 4 mm at its worst place), and by how much its
// radius exceeds that of head and joint space.
constexpr double central_wear_mm = 4.0, posterior_wear_mm = 9.0, worn_radius_excess_mm = 1.0;
double wear_mm_of(PhantomType type) {
  return type == PhantomType::a2 ? central_wear_mm : type == PhantomType::b3 ? posterior_wear_mm : 0.0;
}

/// By how much a face is turned against what was asked for: as it grew, and by wear (B3 24 +- 7 degrees of
/// retroversion, C1 more than 25, D anteverted).
struct Turned {
  double native_rad = 0, worn_rad = 0;
};
Turned turned_of(const PhantomParams& params) {
  const double asked = params.version_rad;
  const auto by = [](double degrees, double limit_deg) {
    return std::pair{radians_from_degrees(degrees), radians_from_degrees(limit_deg)};
  };
  const auto [turn, limit] = params.type == PhantomType::b3   ? by(-18.0, -16.0)
                             : params.type == PhantomType::c1 ? by(-25.0, -26.0)
                             : params.type == PhantomType::d  ? by(12.0, 1.0)
                                                              : std::pair{0.0, 0.0};
  if (turn == 0.0) return {};
  const double made = turn < 0.0 ? std::min(asked + turn, limit) : std::max(asked + turn, limit);
  return params.type == PhantomType::b3 ? Turned{0.0, made - asked} : Turned{made - asked, 0.0};
}

// A head that has slid: how far, as a share of its radius (B1 over 55 % subluxated, D under 40, both of the
// diameter), the joint space that is left where it comes closest, and the largest sine of
// the direction of that place, seen from the middle of the face's sphere.
constexpr double slid_share = 0.27, narrowed_share = 0.4, max_slid_sine = 0.8;
bool has_slid(PhantomType type) { return type == PhantomType::b1 || type == PhantomType::d; }

/// sin and cos of the platform's library can differ in the last bit; rounded far below any voxel they do not.
double settled(double v) { return std::floor(v * 1099511627776.0 + 0.5) / 1099511627776.0; }
double sine(double a) { return settled(std::sin(a)); }
double cosine(double a) { return settled(std::cos(a)); }
double tangent(double a) { return settled(std::tan(a)); }

// The neoglenoid: where the ridge lies behind the middle of the face, how long its chord is as a share of the
// glenoid's width, and how far it is turned into retroversion (26 degrees) against the paleoglenoid.
constexpr double ridge_behind_middle_mm = 1.0, chord_per_width = 0.48;
constexpr double turned_cos = 0.89879404629916699, turned_sin = 0.43837114678907742;
constexpr double neoglenoid_radius_excess_mm = 2.0;  // over that of head and joint space

// Osteophytes: a bead of this radius around the lower rim, so much wider than the rim and raised over the
// face continued to it.
constexpr double bead_radius_mm = 2.2, bead_widening = 1.12, bead_raised_mm = -1.0;
constexpr int bead_parts = 10;

/// Depth of a sphere of that radius at a distance from its deepest point, measured across.
double sagitta(double radius, double across) {
  return radius - std::sqrt(std::max(0.0, radius * radius - across * across));
}

/// Largest r for which `inside` holds on [0, r], to the last bit that matters.
template <typename Inside>
double reach(double upper, Inside&& inside) {
  double low = 0.0, high = upper;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (inside(middle) ? low : high) = middle;
  }
  return low;
}

double version_of(const Vec3& normal, const Vec3& lateral, const Vec3& posterior) {
  return -std::atan2(normal.dot(posterior), normal.dot(lateral));
}

}  // namespace

PhantomShape::PhantomShape(const PhantomParams& params) : params_(params), centre_(glenoid_centre_mm) {
  if (params.anatomical) anatomical_.emplace(*params.anatomical);
  const double c = cosine(params.scapular_plane_rad), s = sine(params.scapular_plane_rad);
  lateral_ = Vec3(-c, -s, 0.0);
  superior_ = Vec3::UnitZ();
  posterior_ = Vec3(-s, c, 0.0);
  const Turned turned = turned_of(params);
  const double native_rad = params.version_rad + turned.native_rad;
  version_rad_ = native_rad + turned.worn_rad;
  if (std::abs(version_rad_) > max_version_rad)
    throw Error(ErrorKind::invalid_input,
                "phantom: a glenoid of that type and version would be turned by " +
                    std::to_string(std::lround(degrees_from_radians(version_rad_))) +
                    " degrees, must be between -50 and 50");
  vault_ = frame_of(native_rad);
  medial_in_vault_ =
      -Vec3(lateral_.dot(vault_.superior), lateral_.dot(vault_.anterior), lateral_.dot(vault_.normal));
  face_ = version_rad_ == native_rad ? vault_ : frame_of(version_rad_);
  const double wear_mm = wear_mm_of(params.type);
  worn_centre_ = wear_mm > 0.0 ? Vec3(centre_ - wear_mm * lateral_) : centre_;
  face_radius_mm_ = wear_mm > 0.0 ? params_.head_radius_mm + params.joint_space_mm + worn_radius_excess_mm
                                  : params.glenoid_radius_mm;
  if (has_slid(params.type))
    face_radius_mm_ = std::max(face_radius_mm_, params.head_radius_mm * (1.0 + slid_share / max_slid_sine) +
                                                    narrowed_share * params.joint_space_mm);
  sphere_centre_ = worn_centre_ + face_radius_mm_ * face_.normal;
  place_head();
  if (params.type == PhantomType::b2) carve_neoglenoid();
}

PhantomShape::FaceFrame PhantomShape::frame_of(double version_rad) const {
  FaceFrame frame;
  // Science 2.1: version = -atan2(n.z, n.x), inclination = atan2(n.y, n.x).
  frame.normal = (lateral_ + tangent(params_.inclination_rad) * superior_ - tangent(version_rad) * posterior_)
                     .normalized();
  frame.superior = (superior_ - superior_.dot(frame.normal) * frame.normal).normalized();
  const Vec3 across = frame.superior.cross(frame.normal);
  frame.anterior = across.dot(posterior_) < 0.0 ? across : Vec3(-across);
  return frame;
}

/// Opposite the middle of the face, or slid along it: there the joint space is narrower.
void PhantomShape::place_head() {
  head_centre_ = worn_centre_ + (params_.joint_space_mm + params_.head_radius_mm) * face_.normal;
  if (!has_slid(params_.type)) return;
  const double from_centre_mm =
      face_radius_mm_ - params_.head_radius_mm - narrowed_share * params_.joint_space_mm;
  const double back_mm =
      (params_.type == PhantomType::b1 ? slid_share : -slid_share) * params_.head_radius_mm;
  const double out_mm = std::sqrt(from_centre_mm * from_centre_mm - back_mm * back_mm);
  head_centre_ = sphere_centre_ - out_mm * face_.normal - back_mm * face_.anterior;
}

double PhantomShape::depth_under_face_mm(const Vec3& world_mm) const {
  const double depth = (world_mm - sphere_centre_).norm() - face_radius_mm_;
  return neoglenoid_ ? std::min(depth, depth_under_neoglenoid_mm(world_mm)) : depth;
}

double PhantomShape::posterior_mm(const Vec3& world_mm) const {
  return -(world_mm - centre_).dot(face_.anterior);
}

Vec3 PhantomShape::in_scapula(const Vec3& offset) const {
  return {offset.dot(lateral_), offset.dot(superior_), offset.dot(posterior_)};
}

/// Vault, neck and body: egg-shaped sections whose half axes change with the depth along -x. Scaled to about
/// mm.
double PhantomShape::body_value(const Vec3& offset) const {
  double s = offset.dot(vault_.superior), t = offset.dot(vault_.anterior), depth = 0.0;
  const double height_above = offset.dot(vault_.normal);
  if (height_above < 0.0) {
    depth = height_above / medial_in_vault_.z();
    s -= depth * medial_in_vault_.x();
    t -= depth * medial_in_vault_.y();
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
  const double simple = rounded_max(section, depth - medial_end_mm, joint_rounding_mm);
  const double share = anatomical_ ? AnatomicalScapula::body_share(depth) : 0.0;
  if (share == 0.0) return simple;
  return (1.0 - share) * simple + share * anatomical_->body_value(in_scapula(offset));
}

/// Spine, acromion and coracoid, scapular frame.
double PhantomShape::processes_value(const Vec3& p) const {
  if (anatomical_) return anatomical_->processes_value(p);
  const Vec3 tip(30.0, 34.0, 8.0);
  const ProcessBases bases = process_bases(p);
  double d = rounded_min(bases.spine, bases.acromion, joint_rounding_mm);
  d = rounded_min(d, capsule(p, acromion_corner, tip, 5.5, 5.0), joint_rounding_mm);
  return std::min(
      d, rounded_min(bases.coracoid,
                     capsule(p, coracoid_bend, coracoid_tip, coracoid_radius_mm, coracoid_tip_radius_mm),
                     joint_rounding_mm));
}

double PhantomShape::body_under_face_value(const Vec3& world_mm) const {
  const Vec3 offset = world_mm - centre_;
  const double above = offset.dot(vault_.normal);
  const double d = rounded_max(body_value(offset), -depth_under_face_mm(world_mm), rim_rounding_mm);
  return std::max(d, above - 0.5 * params_.glenoid_radius_mm);
}

double PhantomShape::body_with_osteophytes_value(const Vec3& world_mm) const {
  const double body = body_under_face_value(world_mm);
  if (params_.type != PhantomType::osteophytes) return body;
  return rounded_min(body, osteophytes_value(world_mm), rim_rounding_mm);
}

/// Where a head has moved to an acromion or a coracoid, it has worn that. Farther off they do not count.
double PhantomShape::processes_beside_humerus_value(const Vec3& world_mm, double body) const {
  const double processes = processes_value(in_scapula(world_mm - centre_));
  if (!anatomical_ || processes >= body + joint_rounding_mm) return processes;
  return std::max(processes, least_gap_mm - humerus_mm(world_mm));
}

PhantomShape::ScapulaValue PhantomShape::scapula_value(const Vec3& world_mm) const {
  // rounded_min() returns the smaller of two that differ by more than its width; within a step of the
  // gradient, 0.01 mm, neither changes by so much more.
  constexpr double apart = joint_rounding_mm + 0.5;
  const double body = body_with_osteophytes_value(world_mm);
  const double processes = processes_beside_humerus_value(world_mm, body);
  const MadeBy made_by = processes > body + apart   ? MadeBy::body
                         : body > processes + apart ? MadeBy::processes
                                                    : MadeBy::both;
  return {rounded_min(body, processes, joint_rounding_mm), made_by};
}

double PhantomShape::scapula_value(const Vec3& world_mm, MadeBy made_by) const {
  switch (made_by) {
    case MadeBy::body: return body_with_osteophytes_value(world_mm);
    case MadeBy::processes:
      return processes_beside_humerus_value(world_mm, std::numeric_limits<double>::max());
    case MadeBy::both: break;
  }
  return scapula_value(world_mm).value;
}

bool PhantomShape::is_process(const Vec3& world_mm) const {
  return anatomical_ && processes_value(in_scapula(world_mm - centre_)) < body_under_face_value(world_mm);
}

bool PhantomShape::is_behind_middle(const Vec3& world_mm) const {
  return (world_mm - worn_centre_).dot(face_.anterior) < 0.0;
}

Vec3 PhantomShape::scapula_gradient(const Vec3& world_mm, MadeBy made_by) const {
  constexpr double step = 0.01;
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = step * Vec3::Unit(axis);
    gradient[axis] =
        (scapula_value(world_mm + along, made_by) - scapula_value(world_mm - along, made_by)) / (2.0 * step);
  }
  return gradient;
}

double PhantomShape::scapula_mm(const Vec3& world_mm) const {
  constexpr double near_mm = 6.0;
  static_assert(near_mm + joint_rounding_mm + 1.0 < AnatomicalScapula::far_mm);  // nothing jumps there
  const auto [value, made_by] = scapula_value(world_mm);
  // Far from the surface the scale of the implicit function does not matter.
  if (std::abs(value) > near_mm) return value;
  return value / std::max(min_gradient, scapula_gradient(world_mm, made_by).norm());
}

Vec3 PhantomShape::on_scapula(const Vec3& near_mm) const {
  constexpr int steps = 2;
  constexpr double max_step_mm = 0.5;
  Vec3 p = near_mm;
  for (int i = 0; i < steps; ++i) {
    const auto [value, made_by] = scapula_value(p);
    const Vec3 gradient = scapula_gradient(p, made_by);
    const double slope = std::max(min_gradient, gradient.norm());
    p -= std::clamp(value / slope, -max_step_mm, max_step_mm) / slope * gradient;
  }
  return p;
}

double PhantomShape::humerus_mm(const Vec3& world_mm) const {
  const double head = (world_mm - head_centre_).norm() - params_.head_radius_mm;
  if (anatomical_) {
    const double scale = params_.head_radius_mm / mean_head_radius_mm;
    const double shaft = scale * anatomical_shaft_mm(in_scapula(world_mm - head_centre_) / scale);
    return rounded_min(head, shaft, 4.0);
  }
  const Vec3 shaft_top = head_centre_ + 10.0 * lateral_;
  const Vec3 shaft_end = shaft_top + Vec3(0.0, 0.0, -300.0) + 20.0 * lateral_;
  return rounded_min(head, capsule(world_mm, shaft_top, shaft_end, shaft_radius_mm, shaft_radius_mm), 6.0);
}

/// Tubercles, surgical neck and shaft about the head's centre, in the scapular frame; all lateral of the
/// joint.
double PhantomShape::anatomical_shaft_mm(const Vec3& p) {
  const Vec3 greater(14.0, 4.0, 7.0), lesser(10.0, 0.0, -17.0), neck(10.0, -12.0, 0.0),
      surgical(14.0, -44.0, 0.0), distal(34.0, -320.0, 0.0);
  double d =
      rounded_min(capsule(p, surgical, distal, 12.5, 11.0), capsule(p, neck, surgical, 16.0, 12.5), 6.0);
  d = rounded_min(d, capsule(p, greater, neck, 12.0, 12.0), 4.0);
  return rounded_min(d, capsule(p, lesser, neck, 7.5, 8.0), 3.0);
}

/// In the section across the middle of the face: from the ridge the chord of the neoglenoid runs posterior,
/// turned medially; its sphere stands on that chord.
void PhantomShape::carve_neoglenoid() {
  Neoglenoid neo;
  neo.radius_mm = params_.head_radius_mm + params_.joint_space_mm + neoglenoid_radius_excess_mm;
  const Vec3 ridge = centre_ - ridge_behind_middle_mm * face_.anterior +
                     sagitta(face_radius_mm_, ridge_behind_middle_mm) * face_.normal;
  const Vec3 along = -turned_cos * face_.anterior - turned_sin * face_.normal;
  neo.normal = turned_cos * face_.normal - turned_sin * face_.anterior;
  const double half_chord = 0.5 * chord_per_width * params_.glenoid_width_mm;
  const double to_chord = std::sqrt(neo.radius_mm * neo.radius_mm - half_chord * half_chord);
  neo.sphere_centre_mm = ridge + half_chord * along + to_chord * neo.normal;
  neoglenoid_ = neo;
  head_centre_ = neo.sphere_centre_mm - neoglenoid_radius_excess_mm * neo.normal;
}

double PhantomShape::depth_under_neoglenoid_mm(const Vec3& world_mm) const {
  if (!neoglenoid_) return 1e3;
  return (world_mm - neoglenoid_->sphere_centre_mm).norm() - neoglenoid_->radius_mm;
}

double PhantomShape::osteophytes_value(const Vec3& world_mm) const {
  const double height = params_.glenoid_height_mm, half_width = 0.5 * params_.glenoid_width_mm;
  // A rational point of the half circle for each u in [-1, 1]: no trigonometry, the same bits everywhere.
  const auto bead = [&](int i) -> Vec3 {
    const double u = -0.8 + 1.6 * i / bead_parts;
    const double down = (1.0 - u * u) / (1.0 + u * u), across = 2.0 * u / (1.0 + u * u);
    const double s =
        -widest_below_middle * height - (0.5 - widest_below_middle) * height * down * bead_widening;
    const double t = half_width * across * bead_widening;
    const double raised = sagitta(face_radius_mm_, std::sqrt(s * s + t * t)) + bead_raised_mm;
    return centre_ + s * face_.superior + t * face_.anterior + raised * face_.normal;
  };
  double d = 1e3;
  for (int i = 0; i < bead_parts; ++i)
    d = std::min(d, capsule(world_mm, bead(i), bead(i + 1), bead_radius_mm, bead_radius_mm));
  return d;
}

Vec3 PhantomShape::on_face(double superior_mm, double anterior_mm) const {
  const Vec3 flat = worn_centre_ + superior_mm * face_.superior + anterior_mm * face_.anterior;
  const auto height_on = [&](const Vec3& sphere_centre, double radius) {
    const Vec3 to_centre = sphere_centre - flat;
    const double up = to_centre.dot(face_.normal);
    return up - std::sqrt(std::max(0.0, radius * radius - (to_centre.squaredNorm() - up * up)));
  };
  double height = height_on(sphere_centre_, face_radius_mm_);
  if (neoglenoid_)
    height = std::min(height, height_on(neoglenoid_->sphere_centre_mm, neoglenoid_->radius_mm));
  return flat + height * face_.normal;
}

double PhantomShape::reach_superior_mm(double direction) const {
  return reach(0.6 * params_.glenoid_height_mm,
               [&](double r) { return body_value(on_face(direction * r, 0.0) - centre_) < 0.0; });
}

double PhantomShape::reach_anterior_mm(double direction) const {
  const double level = -widest_below_middle * params_.glenoid_height_mm;
  return reach(0.6 * params_.glenoid_width_mm,
               [&](double r) { return body_value(on_face(level, direction * r) - centre_) < 0.0; });
}

/// The rim points lie on the articular surface at its rim, opposite ones equally far from the middle, so that
/// their lines have exactly the face's directions.
case_::Landmarks PhantomShape::landmarks() const {
  const auto world = [&](const Vec3& p) -> Vec3 {
    return centre_ + p.x() * lateral_ + p.y() * superior_ + p.z() * posterior_;
  };
  case_::Landmarks l;
  const double scale = params_.anatomical ? params_.anatomical->scale : 1.0;
  const double level = -widest_below_middle * params_.glenoid_height_mm;
  const double pole = std::min(reach_superior_mm(1.0), reach_superior_mm(-1.0));
  double front = reach_anterior_mm(1.0), back = reach_anterior_mm(-1.0);
  if (!neoglenoid_) front = back = std::min(front, back);
  l.glenoid_centre_mm = worn_centre_;
  l.superior_rim_mm = on_face(pole, 0.0);
  l.inferior_rim_mm = on_face(-pole, 0.0);
  l.anterior_rim_mm = on_face(level, front);
  l.posterior_rim_mm = on_face(level, -back);
  l.trigonum_mm = world(scale * spine_root);
  l.inferior_angle_mm = world(scale * inferior_angle);
  l.humeral_head = case_::HumeralHead{head_centre_, params_.head_radius_mm};
  if (params_.type != PhantomType::osteophytes && params_.type != PhantomType::osteoporotic)
    l.walch = to_text(params_.type);
  if (neoglenoid_) {
    const double ridge = reach(back, [&](double r) {
      const Vec3 p = on_face(level, -r);
      return std::abs((p - sphere_centre_).norm() - face_radius_mm_) < 1e-9;
    });
    l.biconcavity_mm = {*l.anterior_rim_mm, on_face(level, -ridge), *l.posterior_rim_mm};
  }
  return l;
}

GroundTruth PhantomShape::truth() const {
  GroundTruth truth;
  truth.type = params_.type;
  truth.version_rad = version_rad_;
  truth.inclination_rad = params_.inclination_rad;
  truth.glenoid = {worn_centre_, face_.normal, face_.superior, face_.anterior};
  truth.articular_sphere_centre_mm = sphere_centre_;
  truth.articular_radius_mm = face_radius_mm_;
  truth.glenoid_height_mm = params_.glenoid_height_mm;
  truth.glenoid_width_mm = params_.glenoid_width_mm;
  truth.plate_mm = params_.plate_mm;
  truth.landmarks = landmarks();
  truth.spine_root_mm = *truth.landmarks.trigonum_mm;
  truth.inferior_angle_mm = *truth.landmarks.inferior_angle_mm;
  truth.humeral_head_centre_mm = head_centre_;
  truth.humeral_head_radius_mm = params_.head_radius_mm;
  if (turned_of(params_).worn_rad != 0.0) truth.premorbid_version_rad = params_.version_rad;
  if (neoglenoid_) add_biconcavity(truth);
  return truth;
}

void PhantomShape::add_biconcavity(GroundTruth& truth) const {
  const auto& line = truth.landmarks.biconcavity_mm;
  const auto face_along = [&](const Vec3& anterior) -> Vec3 {
    const Vec3 normal = face_.superior.cross(anterior).normalized();
    return normal.dot(lateral_) < 0.0 ? Vec3(-normal) : normal;
  };
  const Vec3 native = face_along(line[0] - line[2]);
  truth.premorbid_version_rad = params_.version_rad;
  truth.paleo_version_rad = version_of(face_along(line[0] - line[1]), lateral_, posterior_);
  truth.neo_version_rad = version_of(face_along(line[1] - line[2]), lateral_, posterior_);
  truth.version_rad = version_of(native, lateral_, posterior_);
  truth.inclination_rad = std::atan2(native.dot(superior_), native.dot(lateral_));
  truth.glenoid.lateral = native;
  const Vec3 across = face_.superior.cross(native);
  truth.glenoid.anterior = across.dot(posterior_) < 0.0 ? across : Vec3(-across);
}

}  // namespace ream::ct
