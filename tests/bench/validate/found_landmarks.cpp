#include "bench/validate/found_landmarks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bench/validate/normal_noise.hpp"
#include "bench/validate/published_density.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::bench {
namespace {

constexpr double blade_radius_mm = 2.0, blade_g_cc = 1.2, tip_field_mm = 12.0, click_in_tip_mm = 6.0;
constexpr double guess_mm = 2.0;
/// A little within the outline, where the rounding of the rim has ended.
constexpr double within_rim_mm = 1.0;

/// Distance of a point from a triangle.
double from_triangle_mm(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 across = (b - a).cross(c - a);
  const auto left_of = [&](const Vec3& from, const Vec3& to) {
    return (to - from).cross(p - from).dot(across) >= 0.0;
  };
  if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::abs((p - a).dot(across.normalized()));
  const auto from_edge_mm = [&](const Vec3& from, const Vec3& to) {
    const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    return (p - from - t * (to - from)).norm();
  };
  return std::min({from_edge_mm(a, b), from_edge_mm(b, c), from_edge_mm(c, a)});
}

/// What is scanned about one tip of the blade; `inside`: towards its middle.
voxel::BoneModel imported_tip(const ScannedScapula& scanned, const case_::Landmarks& truth, const Vec3& tip,
                              const Vec3& inside, uint64_t seed) {
  const Vec3 &a = *truth.glenoid_centre_mm, &b = *truth.trigonum_mm, &c = *truth.inferior_angle_mm;
  const double bone_hu = published_hu(blade_g_cc);
  const auto true_hu = [&](const Vec3& at) {
    return from_triangle_mm(at, a, b, c) < blade_radius_mm ? bone_hu : soft_tissue_hu;
  };
  const Scan scan = take_scan(true_hu, Aabb{tip, tip}.grown(tip_field_mm), scanned.protocol, seed);
  return imported_bone(scan, scanned.glenoid.shoulder.side, tip + click_in_tip_mm * inside.normalized(),
                       std::nullopt, 1);
}

/// The middle of a tip's rounding, as it is clicked on in a view of the flat blade: 2 mm inside the outermost
/// half millimetre of bone in a direction.
Vec3 tip_seen(const voxel::BoneModel& bone, const Vec3& direction) {
  constexpr double layer_mm = 0.5;
  double farthest = -1e9;
  const auto each = [&](const auto& visit) {
    for (size_t i = 0; i < bone.coverage.size(); ++i)
      if (bone.coverage[i] >= voxel::solid_coverage)
        visit(bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i))));
  };
  each([&](const Vec3& at) { farthest = std::max(farthest, at.dot(direction)); });
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  each([&](const Vec3& at) {
    if (at.dot(direction) < farthest - layer_mm) return;
    sum += at;
    count += 1.0;
  });
  return sum / count - (blade_radius_mm - 0.5 * layer_mm) * direction;
}

/// How the face is looked at: unit vectors, `into` the bone.
struct View {
  Vec3 into, up, front;
};

class RimFinder {
 public:
  RimFinder(const voxel::BoneModel& bone, const View& view) : bone_(bone), view_(view) {}

  /// The surface seen at a place of the view.
  std::optional<Vec3> seen_at(const Vec3& place) const {
    constexpr double before_mm = 12.0;
    return case_::surface_along(bone_, place - before_mm * view_.into, view_.into);
  }
  /// The outermost point of the face on going `outward` across the view from a point of it: the last before
  /// the surface falls away by more than 60 degrees.
  Vec3 outline(const Vec3& from, const Vec3& outward) const {
    constexpr double step_mm = 0.1, farthest_mm = 30.0, steepest = 1.732;
    Vec3 last = seen_at(from).value_or(from);
    for (double r = step_mm; r < farthest_mm; r += step_mm) {
      const auto next = seen_at(from + r * outward);
      if (!next || std::abs((*next - last).dot(view_.into)) > steepest * step_mm + 0.1) return last;
      last = *next;
    }
    throw Error(ErrorKind::invalid_input, "the face of the scan has no rim");
  }
  /// A click within the outline that misses by so much.
  Vec3 click(const Vec3& rim, const Vec3& outward, const Vec3& miss) const {
    const auto seen = seen_at(rim - within_rim_mm * outward + miss);
    return seen.value_or(rim);
  }

 private:
  const voxel::BoneModel& bone_;
  View view_;
};

/// A turn about any axis, by no more than the observer's error.
Mat3 turned(const Observer& observer, NormalNoise& random) {
  const double most = radians_from_degrees(observer.view_error_deg);
  const Vec3 about(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
  return Eigen::AngleAxisd(most * random.between(0.0, 1.0), about.normalized()).toRotationMatrix();
}

View view_of(const test::AnalyticGlenoid& glenoid, const Observer& observer, NormalNoise& random) {
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  const Mat3 off = turned(observer, random);
  return {glenoid.mirrored(off * -face.n), glenoid.mirrored(off * face.superior),
          glenoid.mirrored(off * face.anterior)};
}

}  // namespace

ImportedScapula imported_scapula(const ScannedScapula& scanned) {
  ScannedGlenoid vault;
  vault.glenoid = scanned.glenoid;
  vault.protocol = scanned.protocol;
  vault.seed = scanned.seed;
  const case_::Landmarks truth = test::shoulder_landmarks(scanned.glenoid.shoulder);
  const Vec3 &a = *truth.glenoid_centre_mm, &b = *truth.trigonum_mm, &c = *truth.inferior_angle_mm;
  const Vec3 middle = (a + b + c) / 3.0;
  return {imported_bone(vault), imported_tip(scanned, truth, b, middle - b, scanned.seed + 1),
          imported_tip(scanned, truth, c, middle - c, scanned.seed + 2)};
}

case_::Landmarks found_landmarks(const ScannedScapula& scanned, const ImportedScapula& imported,
                                 const Observer& observer) {
  NormalNoise random(observer.seed);
  const View view = view_of(scanned.glenoid, observer, random);
  const auto miss = [&]() -> Vec3 {
    return observer.click_error_mm * (random.normal() * view.up + random.normal() * view.front);
  };
  const RimFinder finder(imported.vault, view);
  Vec3 middle = scanned.glenoid.mirrored(scanned.glenoid.frame().centre);
  middle += random.between(-guess_mm, guess_mm) * view.up + random.between(-guess_mm, guess_mm) * view.front;
  // The middle of what is seen, up and down, then to the front and back; once more from there.
  for (int look = 0; look < 2; ++look)
    for (const Vec3& way : {view.up, view.front})
      middle = 0.5 * (finder.outline(middle, way) + finder.outline(middle, -way));
  case_::Landmarks l;
  const auto rim = [&](const Vec3& outward) {
    return finder.click(finder.outline(middle, outward), outward, miss());
  };
  l.superior_rim_mm = rim(view.up);
  l.inferior_rim_mm = rim(-view.up);
  l.anterior_rim_mm = rim(view.front);
  l.posterior_rim_mm = rim(-view.front);
  l.glenoid_centre_mm = finder.seen_at(middle + miss());
  const case_::Landmarks truth = test::shoulder_landmarks(scanned.glenoid.shoulder);
  const Vec3 blade = (*truth.glenoid_centre_mm + *truth.trigonum_mm + *truth.inferior_angle_mm) / 3.0;
  const auto tip = [&](const voxel::BoneModel& bone, const Vec3& true_tip) -> Vec3 {
    return tip_seen(bone, turned(observer, random) * (true_tip - blade).normalized()) + miss();
  };
  l.trigonum_mm = tip(imported.trigonum, *truth.trigonum_mm);
  l.inferior_angle_mm = tip(imported.inferior_angle, *truth.inferior_angle_mm);
  return l;
}

}  // namespace ream::bench
