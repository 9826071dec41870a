#include <Eigen/Geometry>
#include <cmath>

#include "ct/phantom_distance.hpp"
#include "ct/phantom_shape.hpp"

namespace ream::ct {
namespace {

// Landmarks in the scapular frame, mm.
const Vec3 spine_root(-105.0, 0.0, 0.0), inferior_angle(-88.0, -108.0, 0.0);

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

/// In the section across the middle of the face: from the ridge the chord of the neoglenoid runs posterior,
/// turned medially; its sphere stands on that chord.
void PhantomShape::carve_neoglenoid() {
  Neoglenoid neo;
  neo.radius_mm = head_radius_mm + params_.joint_space_mm + neoglenoid_radius_excess_mm;
  const Vec3 ridge = centre_ - ridge_behind_middle_mm * face_anterior_ +
                     sagitta(face_radius_mm_, ridge_behind_middle_mm) * face_normal_;
  const Vec3 along = -turned_cos * face_anterior_ - turned_sin * face_normal_;
  neo.normal = turned_cos * face_normal_ - turned_sin * face_anterior_;
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
    return centre_ + s * face_superior_ + t * face_anterior_ + raised * face_normal_;
  };
  double d = 1e3;
  for (int i = 0; i < bead_parts; ++i)
    d = std::min(d, capsule(world_mm, bead(i), bead(i + 1), bead_radius_mm, bead_radius_mm));
  return d;
}

Vec3 PhantomShape::on_face(double superior_mm, double anterior_mm) const {
  const Vec3 flat = worn_centre_ + superior_mm * face_superior_ + anterior_mm * face_anterior_;
  const auto height_on = [&](const Vec3& sphere_centre, double radius) {
    const Vec3 to_centre = sphere_centre - flat;
    const double up = to_centre.dot(face_normal_);
    return up - std::sqrt(std::max(0.0, radius * radius - (to_centre.squaredNorm() - up * up)));
  };
  double height = height_on(sphere_centre_, face_radius_mm_);
  if (neoglenoid_)
    height = std::min(height, height_on(neoglenoid_->sphere_centre_mm, neoglenoid_->radius_mm));
  return flat + height * face_normal_;
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
  const double level = -widest_below_middle * params_.glenoid_height_mm;
  const double pole = std::min(reach_superior_mm(1.0), reach_superior_mm(-1.0));
  double front = reach_anterior_mm(1.0), back = reach_anterior_mm(-1.0);
  if (!neoglenoid_) front = back = std::min(front, back);
  l.glenoid_centre_mm = worn_centre_;
  l.superior_rim_mm = on_face(pole, 0.0);
  l.inferior_rim_mm = on_face(-pole, 0.0);
  l.anterior_rim_mm = on_face(level, front);
  l.posterior_rim_mm = on_face(level, -back);
  l.trigonum_mm = world(spine_root);
  l.inferior_angle_mm = world(inferior_angle);
  l.humeral_head = case_::HumeralHead{head_centre_, head_radius_mm};
  if (params_.type == PhantomType::a1 || params_.type == PhantomType::a2 || params_.type == PhantomType::b2)
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
  truth.version_rad = params_.version_rad;
  truth.inclination_rad = params_.inclination_rad;
  truth.glenoid = {worn_centre_, face_normal_, face_superior_, face_anterior_};
  truth.articular_sphere_centre_mm = sphere_centre_;
  truth.articular_radius_mm = face_radius_mm_;
  truth.glenoid_height_mm = params_.glenoid_height_mm;
  truth.glenoid_width_mm = params_.glenoid_width_mm;
  truth.plate_mm = params_.plate_mm;
  truth.landmarks = landmarks();
  truth.spine_root_mm = *truth.landmarks.trigonum_mm;
  truth.inferior_angle_mm = *truth.landmarks.inferior_angle_mm;
  truth.humeral_head_centre_mm = head_centre_;
  truth.humeral_head_radius_mm = head_radius_mm;
  if (neoglenoid_) add_biconcavity(truth);
  return truth;
}

void PhantomShape::add_biconcavity(GroundTruth& truth) const {
  const auto& line = truth.landmarks.biconcavity_mm;
  const auto face_along = [&](const Vec3& anterior) -> Vec3 {
    const Vec3 normal = face_superior_.cross(anterior).normalized();
    return normal.dot(lateral_) < 0.0 ? Vec3(-normal) : normal;
  };
  const Vec3 native = face_along(line[0] - line[2]);
  truth.premorbid_version_rad = params_.version_rad;
  truth.paleo_version_rad = version_of(face_along(line[0] - line[1]), lateral_, posterior_);
  truth.neo_version_rad = version_of(face_along(line[1] - line[2]), lateral_, posterior_);
  truth.version_rad = version_of(native, lateral_, posterior_);
  truth.inclination_rad = std::atan2(native.dot(superior_), native.dot(lateral_));
  truth.glenoid.lateral = native;
  const Vec3 across = face_superior_.cross(native);
  truth.glenoid.anterior = across.dot(posterior_) < 0.0 ? across : Vec3(-across);
}

}  // namespace ream::ct
