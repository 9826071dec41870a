#include "ct/segment/shoulder_steps.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {
namespace {

// Vertebrae reach a share of 0.39, heads cut off by the field of view 0.5, whole ones up to 0.9.
constexpr double min_share = 0.42, share_of_best = 0.6;
constexpr double seed_reach_mm = 5.0, seed_ball_mm = 2.0;

/// World x points left.
double medial_x(case_::Side side) { return side == case_::Side::right ? 1.0 : -1.0; }

void mark_seed(std::vector<uint8_t>& markers, const HuVolume& volume, const Mask& bone,
               const std::optional<Vec3>& seed_mm, BoneLabel label) {
  if (!seed_mm) return;
  const auto nearest = nearest_set(bone, volume, *seed_mm, seed_reach_mm);
  if (!nearest)
    throw Error(ErrorKind::invalid_input, "no bone within 5 mm of the " + to_text(label) + "'s seed " +
                                              text_of_point(*seed_mm) +
                                              " mm; give a point in the bone (LPS) or lower the threshold");
  const Vec3 centre = volume.world_of_centre(*nearest);
  const Vec3i reach = (seed_ball_mm / volume.spacing_mm.array()).ceil().cast<int>().matrix();
  const Vec3i low = (*nearest - reach).cwiseMax(0),
              high = (*nearest + reach).cwiseMin((volume.dims.array() - 1).matrix());
  for (int w = low.z(); w <= high.z(); ++w)
    for (int v = low.y(); v <= high.y(); ++v)
      for (int u = low.x(); u <= high.x(); ++u) {
        const size_t i = volume.index(u, v, w);
        const bool near = (volume.world_of_centre({u, v, w}) - centre).norm() <= seed_ball_mm;
        if (bone[i] && near) markers[i] = static_cast<uint8_t>(label);
      }
  markers[volume.index(nearest->x(), nearest->y(), nearest->z())] = static_cast<uint8_t>(label);
}

// The glenoid faces the head from medial and somewhat behind (the scapular plane is turned 30 to 45 degrees
// forward).
const Vec3 to_glenoid(0.8, 0.6, 0.0);
constexpr double towards_glenoid_cosine = 0.77;

/// From the head's centre, x medial.
Vec3 offset_from(const HumeralHead& head, case_::Side side, const Vec3& world_mm) {
  Vec3 offset = world_mm - head.centre_mm;
  offset.x() *= medial_x(side);
  return offset;
}

/// What a place about the head must be, by anatomy alone; offsets from the head's centre, mm, x medial.
BoneLabel sure_label(const Vec3& offset, const HumeralHead& head) {
  constexpr double within_head_mm = 2.0;
  // The glenoid's vault begins behind 2 to 5 mm of joint space.
  constexpr double vault_from_mm = 3.0, vault_to_mm = 14.0;
  // The scapula ends 57 mm medial of the head in front (coracoid) and 110 mm behind (medial border).
  constexpr double past_coracoid_mm = 65.0, in_front_mm = 5.0, past_blade_mm = 140.0;
  const double distance = offset.norm();
  if (distance <= head.radius_mm - within_head_mm) return BoneLabel::humerus;
  if (offset.x() > past_blade_mm || (offset.x() > past_coracoid_mm && offset.y() < -in_front_mm))
    return BoneLabel::other;
  const bool towards = offset.dot(to_glenoid) >= towards_glenoid_cosine * distance;
  if (towards && distance >= head.radius_mm + vault_from_mm && distance <= head.radius_mm + vault_to_mm)
    return BoneLabel::scapula;
  return BoneLabel::none;
}

void mark_anatomy(std::vector<uint8_t>& markers, const HuVolume& volume, const Mask& bone,
                  const HumeralHead& head, case_::Side side) {
  size_t i = 0;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u, ++i) {
        if (!bone[i]) continue;
        const Vec3 offset = offset_from(head, side, volume.world_of_centre({u, v, w}));
        markers[i] = static_cast<uint8_t>(sure_label(offset, head));
      }
}

/// Keeps the largest part of a label's markers: flecks in front of the glenoid are calcified soft tissue or
/// osteophytes.
size_t keep_largest(std::vector<uint8_t>& markers, const Vec3i& dims, BoneLabel label) {
  const Mask all = mask_of(markers, label), kept = largest_part(all, dims);
  for (size_t i = 0; i < markers.size(); ++i)
    if (all[i] && !kept[i]) markers[i] = 0;
  return count_set(kept);
}

}  // namespace

std::optional<HumeralHead> find_head(const HuVolume& volume, double threshold_hu, case_::Side side,
                                     const Seeds& seeds) {
  const auto heads = head_candidates(volume, threshold_hu);
  std::optional<HumeralHead> best;
  if (seeds.humerus_mm) {
    for (const HumeralHead& head : heads)
      if ((head.centre_mm - *seeds.humerus_mm).norm() < head.radius_mm && (!best || head.share > best->share))
        best = head;
    return best ? best : fitted_head(volume, threshold_hu, *seeds.humerus_mm);
  }
  for (const HumeralHead& head : heads) {
    if (head.share < min_share || head.share < share_of_best * heads.front().share) continue;
    const bool farther = best && medial_x(side) * (head.centre_mm.x() - best->centre_mm.x()) < 0.0;
    if (!best || farther) best = head;
  }
  return best;
}

Aabb shoulder_box_mm(const HumeralHead& head, case_::Side side) {
  constexpr double medial_mm = 165.0, lateral_mm = 60.0, front_mm = 95.0, behind_mm = 165.0, up_mm = 90.0,
                   down_mm = 200.0;
  const Vec3& c = head.centre_mm;
  const double m = medial_x(side);
  Aabb box;
  box.include(c + Vec3(m * medial_mm, -front_mm, -down_mm));
  box.include(c + Vec3(-m * lateral_mm, behind_mm, up_mm));
  return box;
}

std::vector<uint8_t> shoulder_markers(const HuVolume& volume, double threshold_hu,
                                      const std::optional<HumeralHead>& head, case_::Side side,
                                      const Seeds& seeds) {
  std::vector<uint8_t> markers(volume.voxel_count());
  const Mask bone = above_threshold(volume, threshold_hu);
  if (head) {
    mark_anatomy(markers, volume, bone, *head, side);
    if (keep_largest(markers, volume.dims, BoneLabel::scapula) == 0 && !seeds.scapula_mm)
      throw Error(ErrorKind::invalid_input,
                  "no bone on the medial side of the humeral head at " + text_of_point(head->centre_mm) +
                      " mm, where the " + case_::to_text(side) +
                      " glenoid must be; check the side, lower the threshold or give a seed in the scapula");
  }
  mark_seed(markers, volume, bone, seeds.scapula_mm, BoneLabel::scapula);
  // With a head its seed has served: it chose the head, and may lie in thin spongy bone.
  if (!head) mark_seed(markers, volume, bone, seeds.humerus_mm, BoneLabel::humerus);
  mark_seed(markers, volume, bone, seeds.clavicle_mm, BoneLabel::clavicle);
  return markers;
}

std::optional<Vec3> glenoid_facing(const HumeralHead& head, case_::Side side, const HuVolume& volume,
                                   const std::vector<uint8_t>& labels) {
  constexpr double face_mm = 8.0;  // joint space and a little bone
  Vec3 sum = Vec3::Zero();
  double nearest = head.radius_mm + face_mm, count = 0.0;
  size_t i = 0;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u, ++i) {
        if (labels[i] != static_cast<uint8_t>(BoneLabel::scapula)) continue;
        const Vec3 place = volume.world_of_centre({u, v, w});
        const Vec3 offset = offset_from(head, side, place);
        const double distance = offset.norm();
        if (distance > head.radius_mm + face_mm || offset.dot(to_glenoid) < 0.5 * distance) continue;
        sum += (place - head.centre_mm) / distance;
        nearest = std::min(nearest, distance);
        ++count;
      }
  if (count == 0.0) return std::nullopt;
  return head.centre_mm + nearest * sum.normalized();
}

}  // namespace ream::ct
