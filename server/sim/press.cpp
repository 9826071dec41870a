#include "sim/press.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/clock.hpp"
#include "core/units.hpp"
#include "force/edge_load.hpp"
#include "sim/approach.hpp"

namespace ream::sim {
namespace {

/// Full symmetric matrix of a part's second sums in mm and rad, times `scale`, added to `m`.
void add(force::Mat6& m, const collide::ContactSums::Part& part, double moment_length_mm, double scale) {
  size_t k = 0;
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = i; j < 6; ++j) {
      const double unit = (i < 3 ? 1.0 : moment_length_mm) * (j < 3 ? 1.0 : moment_length_mm);
      const double value = static_cast<double>(part.second[k++]) * unit * scale;
      m[6 * i + j] += value;
      if (i != j) m[6 * j + i] += value;
    }
}

/// Largest of the three translational diagonal sums: n_x^2, n_y^2, n_z^2.
double max_translational(const collide::ContactSums::Part& part) {
  return static_cast<double>(std::max({part.second[0], part.second[6], part.second[11]}));
}

/// Of weights and components of the contact sums: 1/127 each.
constexpr double component = 1.0 / 127.0;

/// Cutting edge of one unit of weight, mm: area / edge_radius_mm of all lips, as r comes in by the weight.
double edge_mm_of_weight(const Model& model) {
  const double area_mm2 = model.contact_shell.cell_area_mm2 / shell::area_weights_a_face;
  return force::lip_count / (2.0 * pi * collide::edge_radius_mm) * area_mm2;
}

/// Shares, mean densities, area and edge of what the cutting surface engages.
force::EngagedBone engaged_bone(const Model& model, const collide::ContactSums& sums) noexcept {
  force::EngagedBone bone;
  int64_t total = 0;
  for (const int64_t weight : sums.class_weight) total += weight;
  if (total == 0) return bone;
  bone.area_mm2 =
      static_cast<double>(sums.cutting.area) / shell::area_weights_a_face * model.contact_shell.cell_area_mm2;
  bone.edge_mm = max_translational(sums.cutting) * component * component * edge_mm_of_weight(model);
  bone.resistance_s_mm =
      static_cast<double>(sums.resistance) / static_cast<double>(total) / force::edge_resistance_codes_s_mm;
  for (size_t k = 0; k < 3; ++k) {
    if (sums.class_weight[k] == 0) continue;
    const auto weight = static_cast<double>(sums.class_weight[k]);
    bone.share[k] = weight / static_cast<double>(total);
    bone.density_g_cc[k] =
        k == static_cast<size_t>(voxel::BoneClass::cartilage)
            ? voxel::cartilage_density_g_cc
            : static_cast<double>(sums.class_density[k]) * voxel::density_step_g_cc / weight;
  }
  return bone;
}

/// Takes the axis out of what resists.
void free_along_axis(force::Mat6& m) {
  for (size_t i = 0; i < 6; ++i) m[6 * 2 + i] = m[6 * i + 2] = 0.0;
}

/// The 6x6 resistance from the contact sums: scaled so that full axial contact has the feed
/// model's resistance, whatever the engaged area. A standing spindle (or thrust too small to cut) makes
/// cutting contact block like guiding contact.
force::Resistance contact_resistance(const Model& model, const collide::ContactSums& sums,
                                     double resistance_n_s_mm, bool cuts) noexcept {
  force::Resistance resistance;
  const double length = model.contact_shell.moment_length_mm;
  const double axial = max_translational(sums.cutting);
  if (cuts && axial > 0.0) add(resistance.cutting, sums.cutting, length, resistance_n_s_mm / axial);
  if (!cuts) add(resistance.guiding, sums.cutting, length, 1.0);
  add(resistance.guiding, sums.guiding, length, 1.0);
  // Normals point out of the tool, into the bone; the way out is the other way.
  Vec3 into = Vec3::Zero();
  for (size_t i = 0; i < 3; ++i)
    into[static_cast<Eigen::Index>(i)] = static_cast<double>(sums.cutting.first[i] + sums.guiding.first[i]);
  const double squared = into.squaredNorm();
  if (squared > 0.0) resistance.outward = -into / std::sqrt(squared);
  return resistance;
}

/// Bone pushes and never holds. The matrix knows no sides: normals that differ would make it hold a tool that
/// the hand draws back along its axis out of the pocket that it cut. Bone there has the tool's own shape, so
/// the way back leads away from every point of it. Elsewhere an edge of the tool may have bone behind it.
void let_go(const collide::ContactSums& sums, force::Resistance& resistance) {
  if (resistance.outward.z() > 0.0 || sums.guiding.first[2] < 0) return;
  free_along_axis(resistance.cutting);
  free_along_axis(resistance.guiding);
}

/// Advance against contact: no point goes farther than one look for contact allows, so that nothing is
/// jumped.
Pose moved_within_a_voxel(const Model& model, const Pose& world_from_tool, const force::Vec6& motion) {
  const Pose whole = moved(world_from_tool, motion);
  const double limit_mm = look_every_voxels * model.thin_step_mm;
  const double path_mm = path_bound_mm(model, world_from_tool, whole);
  return path_mm <= limit_mm ? whole : moved(world_from_tool, motion, limit_mm / path_mm);
}

/// Sum of weight times normal over the cutting part.
Vec3 weighted_normal(const collide::ContactSums& sums) {
  return component * Vec3(static_cast<double>(sums.cutting.first[0]),
                          static_cast<double>(sums.cutting.first[1]),
                          static_cast<double>(sums.cutting.first[2]));
}

/// What the lips' load along their path does to the tool, tool frame: each drags against its motion, the
/// spindle's, which is about +z. Its part about the axis is the spindle's affair.
force::Vec6 sideways_pull(const collide::ContactSums& sums, double load_n, double height_mm) {
  const Vec3 force_n =
      load_n * component *
      Vec3(static_cast<double>(sums.cutting.around[1]), -static_cast<double>(sums.cutting.around[0]), 0.0);
  return {force_n.x(), force_n.y(), 0.0, -height_mm * force_n.y(), height_mm * force_n.x(), 0.0};
}

/// Load of the edge along its normal, N per unit of weight, that gives the force with which the cut resisted
/// this motion.
double load_of_cut_n(const force::Resistance& cut, const force::Vec6& motion, const Vec3& normal) {
  double along_n = 0.0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 6; ++j)
      along_n += normal[static_cast<Eigen::Index>(i)] * cut.cutting[6 * i + j] * motion[j] / tick_s;
  const double squared = normal.squaredNorm();
  return squared > 0.0 ? std::max(0.0, along_n / squared) : 0.0;
}

/// The coupling as far as it may stretch now: to the device's largest force, less while that ramps up.
force::CouplingParameters yielding(const Model& model, const State& state) {
  force::CouplingParameters coupling = model.coupling;
  if (!model.virtual_mass)
    coupling.stretch_max_mm =
        state.output.start_up.gain() * model.settings.limits.force_max_n / coupling.stiffness_n_mm;
  return coupling;
}

struct Pressed {
  force::CouplingStep step;
  force::Resistance resistance;  ///< without friction
  Vec3 outward;

  /// Simulated, that presses the tool against the bone.
  double normal_force_n() const {
    const auto& w = step.wrench_on_tool;
    return -(w[0] * outward.x() + w[1] * outward.y() + w[2] * outward.z());
  }
};

/// Of the tool's origin, grid frame: bone may have moved since.
Vec3 place_on_bone_mm(const State& state) {
  return state.world_from_grid.inverse().point(state.world_from_tool.translation_mm);
}

/// A tool on bone in one tick, before it moves.
struct Contact {
  const Model& model;
  const State& state;
  const collide::ContactSums& sums;
  const force::EngagedBone& bone;
  const force::CuttingLoad& cutting;
  const force::Vec6 delta;  ///< handle minus tool

  /// The tick's coupling when the lips cut, or when they only rub.
  Pressed pressed(bool cuts) const {
    // At a given thrust the feed per revolution stays.
    const double slowed = cuts ? model.settings.feed.spindle_rad_s / state.spindle.speed_rad_s() : 1.0;
    force::Resistance resistance = contact_resistance(model, sums, cutting.resistance_n_s_mm * slowed, cuts);
    if (delta[2] < 0.0 && in_own_pocket()) let_go(sums, resistance);
    const force::Resistance without_friction = resistance;
    force::Sliding slid = sliding(resistance.outward);
    if (cuts && cutting.tangential_ratio > 0.0) slid.friction = cutting.tangential_ratio;
    resistance.pull = sideways_pull(sums, drag_n(cuts), slid.point_mm.z());
    force::add_friction(slid, resistance);
    return {force::couple(yielding(model, state), resistance, delta, tick_s), without_friction,
            resistance.outward};
  }

  /// Load of the edge along its normal, N per unit of weight.
  double edge_load_n(const Pressed& pressed, bool cuts) const {
    const Vec3 normal = weighted_normal(sums);
    if (cuts) return load_of_cut_n(pressed.resistance, pressed.step.tool_motion, normal);
    const double size = normal.norm();
    return size > 0.0 ? std::max(0.0, pressed.normal_force_n()) / size : 0.0;
  }

  force::SpindleLoad holding_back(const State& after, double thrust_n, bool cuts, bool asked_reversed) const {
    force::SpindleLoad load;
    const double speed_rad_s = state.spindle.speed_rad_s();
    const bool reversed = speed_rad_s < 0.0 || (speed_rad_s == 0.0 && asked_reversed);
    load.lips_bite = bone.any() && !reversed && after.normal_force_n >= force::start_threshold_n;
    const double ratio = reversed ? force::friction_coefficient : cutting.tangential_ratio;
    load.torque_n_mm = ratio > 0.0 ? ratio * after.edge_load_n * collide::edge_radius_mm *
                                         static_cast<double>(sums.cutting.area)
                                   : cutting.torque_arm_mm * std::max(0.0, thrust_n);
    // Standing steel rests on the few points that stand out; under load it sinks in until more of them carry
    // it.
    if (!cuts && ratio > 0.0)
      load.torque_n_mm =
          std::min(load.torque_n_mm, ratio * std::max(0.0, thrust_n) * model.profile.max_radius_mm);
    return load;
  }

 private:
  /// Along the lips' path, N per unit of weight, of the load of the tick before; lips that turn backwards
  /// rub.
  double drag_n(bool cuts) const {
    if (cuts) return cutting.tangential_ratio * state.edge_load_n;
    return state.spindle.speed_rad_s() < 0.0 ? -force::friction_coefficient * state.edge_load_n : 0.0;
  }

  /// How the engaged surface slid in the tick before.
  force::Sliding sliding(const Vec3& outward) const {
    const auto& t = state.tool_twist;
    force::Sliding s;
    s.point_mm = model.surface_place.point_mm(-outward);
    s.normal_force_n = state.normal_force_n;
    const Vec3 velocity_mm_s = Vec3(t[0], t[1], t[2]) + Vec3(t[3], t[4], t[5]).cross(s.point_mm);
    s.along_speed_mm_s = (velocity_mm_s - outward * outward.dot(velocity_mm_s)).norm();
    s.turn_speed_rad_s = std::abs(state.spindle.speed_rad_s()) + std::abs(t[5]);
    s.mean_radius_mm = mean_radius_mm(s.point_mm);
    return s;
  }

  bool in_own_pocket() const {
    return (place_on_bone_mm(state) - state.last_cut_mm).norm() < model.profile.max_radius_mm;
  }

  /// Of the engaged edge, whose weight is area over radius; of the place where only guiding surface touches.
  double mean_radius_mm(const Vec3& point_mm) const {
    int64_t edge = 0;
    for (const int64_t weight : sums.class_weight) edge += weight;
    if (edge == 0) return std::sqrt(point_mm.x() * point_mm.x() + point_mm.y() * point_mm.y());
    return collide::edge_radius_mm * static_cast<double>(sums.cutting.area) / static_cast<double>(edge);
  }
};

}  // namespace

force::Vec6 handle_minus_tool(const Pose& world_from_tool, const Pose& world_from_handle) noexcept {
  const Mat3 tool_from_world = world_from_tool.rotation.transpose();
  const Vec3 d = tool_from_world * (world_from_handle.translation_mm - world_from_tool.translation_mm);
  const Vec3 r = turn_between(world_from_tool.rotation, world_from_handle.rotation);
  return {d.x(), d.y(), d.z(), r.x(), r.y(), r.z()};
}

Pose moved(const Pose& world_from_tool, const force::Vec6& motion, double fraction) noexcept {
  const Vec3 shift(motion[0], motion[1], motion[2]), turn(motion[3], motion[4], motion[5]);
  return {orthonormalized(world_from_tool.rotation * rotation_from_small_vector(fraction * turn)),
          world_from_tool.translation_mm + world_from_tool.rotation * (fraction * shift)};
}

double max_travel_mm(const Model& model, const State& state, double stretch_mm) noexcept {
  if (!model.settings.spindle || model.virtual_mass) return std::numeric_limits<double>::infinity();
  // Without the start-up's gain, which would freeze a tool that a pause left in the bone.
  const double most_n = model.settings.limits.force_max_n;
  const double force_n =
      model.coupling.force_scale * std::min(model.coupling.stiffness_n_mm * stretch_mm, most_n);
  const double gained_mm_s = mm_s2_per_n_kg * force_n / model.settings.spindle->mass_kg * tick_s;
  return (state.tool_speed_mm_s + gained_mm_s) * tick_s;
}

void add_slip(const Model& model, const State& state, const Pose& world_from_handle,
              ToolLoad& load) noexcept {
  const force::CouplingParameters coupling = yielding(model, state);
  const force::Vec6 delta = handle_minus_tool(state.world_from_tool, world_from_handle);
  const Vec3 stretch_mm(delta[0], delta[1], delta[2]);
  Vec3 force_n =
      coupling.stiffness_n_mm * coupling.force_scale * clamp_length(stretch_mm, coupling.stretch_max_mm);
  // As in contact: what pulls the hand in is not felt.
  force_n.z() = std::max(0.0, force_n.z());
  load.spring.force_n += force_n;
  load.unlimited_force_n += model.coupling.stiffness_n_mm * stretch_mm.norm();
}

ToolLoad press(const Model& model, State& state, const collide::ContactSums& sums,
               const device::DeviceInput& input, TickReport& report) noexcept {
  const force::EngagedBone bone = engaged_bone(model, sums);
  const force::CuttingLoad cutting =
      bone.any() ? model.feed->load(bone, state.thrust_n) : force::CuttingLoad{};
  const Contact contact{model, state,   sums,
                        bone,  cutting, handle_minus_tool(state.world_from_tool, input.world_from_handle)};
  const bool turns_forward =
      state.spindle.speed_rad_s() > force::Spindle::standing_share * model.settings.feed.spindle_rad_s;
  bool cuts = turns_forward;
  Pressed pressed = contact.pressed(cuts);
  if (cuts && pressed.normal_force_n() < force::start_threshold_n) {
    cuts = false;
    pressed = contact.pressed(cuts);
  }

  const Pose before = state.world_from_tool;
  const auto& d = contact.delta;
  const double stretch_mm = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  force::Vec6 motion = pressed.step.tool_motion;
  const double travel_mm = std::sqrt(motion[0] * motion[0] + motion[1] * motion[1] + motion[2] * motion[2]);
  const double travelled_mm = (before.translation_mm - state.tick_from_mm).norm();
  const double most_mm = std::max(0.0, max_travel_mm(model, state, stretch_mm + travelled_mm) - travelled_mm);
  if (travel_mm > most_mm)
    for (size_t i = 0; i < 3; ++i) motion[i] *= most_mm / travel_mm;
  if (cuts) state.last_cut_mm = place_on_bone_mm(state);
  state.world_from_tool = moved_within_a_voxel(model, before, motion);
  state.free_path_mm = -1.0;
  for (size_t i = 0; i < 6; ++i) state.tool_twist[i] = motion[i] / tick_s;

  const auto& w = pressed.step.wrench_on_tool;
  ToolLoad load;
  load.spring = {Vec3(w[0], w[1], w[2]), Vec3(w[3], w[4], w[5])};
  load.unlimited_force_n =
      model.coupling.stiffness_n_mm * Vec3(contact.delta[0], contact.delta[1], contact.delta[2]).norm();
  load.cuts = cuts;
  load.edge_mm = bone.edge_mm;
  state.normal_force_n = std::max(0.0, pressed.normal_force_n());
  state.edge_load_n = contact.edge_load_n(pressed, cuts);
  load.spindle = contact.holding_back(state, w[2], cuts, input.drive.reversed);

  report.engaged = true;
  report.weakened = pressed.step.yielded;
  report.cutting = cuts;
  report.thrust_n = w[2];
  report.torque_n_mm = load.spring.torque_n_mm.norm();
  report.feed_rate_mm_s =
      before.rotation.col(2).dot(state.world_from_tool.translation_mm - before.translation_mm) / tick_s;
  report.density_g_cc = bone.mean_density_g_cc();
  for (size_t k = 0; k < 3; ++k) report.share[k] = bone.share[k];
  report.engaged_points = sums.engaged();
  load.area_mm2 = bone.area_mm2;
  return load;
}

}  // namespace ream::sim
