#include "support/swept_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ream::test {
namespace {

constexpr int block_edge = 4;
constexpr double coarse_step_mm = 0.02;
/// A tool on its way out brushes bricks whose turn does not come before it has gone: 128 are cut in a tick, a
/// quarter of that in ticks that list the near ones anew, and the largest tool of these tests has 3,600 near
/// it. While it draws back it moves by some micrometres from turn to turn, so it must have gone on for twice
/// as long.
constexpr size_t ticks_to_every_turn = 70;

/// Upper bound of how far any point of the body moves between two poses.
double motion_mm(const Pose& a, const Pose& b, double size_mm) {
  return (a.translation_mm - b.translation_mm).norm() + (a.rotation - b.rotation).norm() * size_mm;
}

/// Poses in which the tool cut, thinned to one every `step_mm` of motion; the last is always there.
std::vector<Pose> thinned(const std::vector<Pose>& poses, double step_mm, double size_mm) {
  std::vector<Pose> kept;
  for (size_t i = 0; i < poses.size(); ++i)
    if (kept.empty() || i + 1 == poses.size() || motion_mm(kept.back(), poses[i], size_mm) > step_mm)
      kept.push_back(poses[i]);
  std::reverse(kept.begin(), kept.end());  // the deepest first
  return kept;
}

/// Coarse for voxels far from the new surface, fine near it; the deepest poses first.
struct Path {
  Path(const std::vector<Pose>& poses, double fine_step_mm, double size_mm)
      : fine(thinned(poses, fine_step_mm, size_mm)), coarse(thinned(poses, coarse_step_mm, size_mm)) {}

  std::vector<Pose> fine, coarse;
};

bool removed_bone(const record::TickReport& r) {
  return std::any_of(std::begin(r.coverage_removed), std::end(r.coverage_removed),
                     [](int64_t levels) { return levels != 0; });
}

struct CuttingPoses {
  std::vector<Pose> all;      ///< cut, however briefly; nothing is gone but what these swept
  std::vector<Pose> settled;  ///< went on cutting until every brick's turn had come; what these swept is gone
};

CuttingPoses cutting_poses(const std::vector<record::TickReport>& reports, const voxel::VoxelGrid& grid) {
  const Pose grid_from_world = grid.world_from_grid.inverse();
  CuttingPoses poses;
  size_t cut_on = 0;  // ticks that cut without a pause, counted from the end
  for (size_t i = reports.size(); i-- > 0;) {
    const auto& r = reports[i];
    cut_on = r.cutting ? cut_on + 1 : 0;
    if (!r.cutting && !removed_bone(r)) continue;
    poses.all.push_back((grid_from_world * r.world_from_tool).inverse());
    if (cut_on > ticks_to_every_turn) poses.settled.push_back(poses.all.back());
  }
  std::reverse(poses.all.begin(), poses.all.end());
  std::reverse(poses.settled.begin(), poses.settled.end());
  return poses;
}

class Comparison {
 public:
  Comparison(const voxel::BoneModel& bone, const std::vector<uint8_t>& before, const CuttingBody& body,
             const CuttingPoses& poses, double tolerance_mm)
      : bone_(bone),
        before_(before),
        body_(body),
        edge_mm_(bone.grid.spacing_mm.minCoeff()),
        tolerance_mm_(tolerance_mm),
        fine_step_mm_(edge_mm_ / 64.0),
        all_(poses.all, fine_step_mm_, 2.0 * body.size_mm()),
        settled_(poses.settled, fine_step_mm_, 2.0 * body.size_mm()) {}

  SweptTally run() {
    tally_.poses = all_.fine.size();
    tally_.settled_poses = settled_.fine.size();
    tally_.voxels = before_.size();
    const Vec3i& dims = bone_.grid.dims;
    for (int w = 0; w < dims.z(); w += block_edge)
      for (int v = 0; v < dims.y(); v += block_edge)
        for (int u = 0; u < dims.x(); u += block_edge) compare_block({u, v, w});
    tally_.removed_mm3 = static_cast<double>(tally_.levels_removed) * bone_.grid.voxel_volume_mm3() / 255.0;
    return tally_;
  }

 private:
  double nearest_mm(const std::vector<Pose>& tool_from_grid, const Vec3& point_mm,
                    double low_enough_mm) const {
    double nearest = CuttingBody::reach_mm;
    for (const Pose& pose : tool_from_grid) {
      const Vec3 p = pose.point(point_mm);
      nearest = std::min(nearest, body_.distance_mm(std::hypot(p.x(), p.y()), p.z()));
      if (nearest <= low_enough_mm) break;
    }
    return nearest;
  }

  void compare_block(const Vec3i& first) {
    const Vec3 size = (bone_.grid.spacing_mm.array() * double(block_edge)).matrix();
    const Vec3 middle = (first.cast<double>().array() * bone_.grid.spacing_mm.array()).matrix() + 0.5 * size;
    const double near_mm = 0.5 * size.norm() + outside_mm() + coarse_step_mm;
    const bool measurable = near_mm < CuttingBody::reach_mm;
    const bool far = measurable && nearest_mm(all_.coarse, middle, near_mm) > near_mm;
    for (int w = first.z(); w < first.z() + block_edge; ++w)
      for (int v = first.y(); v < first.y() + block_edge; ++v)
        for (int u = first.x(); u < first.x() + block_edge; ++u) compare_voxel(u, v, w, far);
  }

  void compare_voxel(int u, int v, int w, bool far) {
    const size_t i = bone_.grid.index(u, v, w);
    const uint8_t was = before_[i], is = bone_.coverage[i];
    tally_.grown += is > was;
    if (was == 0) return;
    ++tally_.bone_before;
    tally_.levels_removed += was - is;
    const Vec3& spacing = bone_.grid.spacing_mm;
    const Vec3 centre((u + 0.5) * spacing.x(), (v + 0.5) * spacing.y(), (w + 0.5) * spacing.z());
    if (far) return judge_kept(was, is, CuttingBody::reach_mm);
    // A thinned path can only be farther away than the whole one, by at most its step.
    const double coarse = nearest_mm(settled_.coarse, centre, -inside_mm());
    if (coarse <= -inside_mm()) return judge_gone(is, coarse);
    const double any = nearest_mm(all_.coarse, centre, -inside_mm());
    if (any - coarse_step_mm >= outside_mm()) return judge_kept(was, is, any);
    judge(was, is, nearest_mm(all_.fine, centre, -inside_mm()),
          nearest_mm(settled_.fine, centre, -inside_mm()));
  }

  void judge(uint8_t was, uint8_t is, double distance_mm, double settled_mm) {
    if (settled_mm <= -inside_mm()) return judge_gone(is, settled_mm);
    if (distance_mm - fine_step_mm_ >= outside_mm()) return judge_kept(was, is, distance_mm);
    ++tally_.at_surface;
    note_extremes(was, is, distance_mm, settled_mm);
    const double low = level(distance_mm - fine_step_mm_ - tolerance_mm_) - 1.0;
    const double high = level(settled_mm + edge_mm_ / 64.0 + tolerance_mm_) + 1.0;
    tally_.off_at_surface += is < std::min<double>(was, low) || is > std::min<double>(was, high);
  }

  void judge_gone(uint8_t is, double distance_mm) {
    ++tally_.must_be_gone;
    tally_.not_gone += is != 0;
    note_extremes(255, is, distance_mm, distance_mm);
  }

  void judge_kept(uint8_t was, uint8_t is, double distance_mm) {
    ++tally_.must_be_kept;
    tally_.not_kept += is != was;
    note_extremes(was, is, distance_mm, distance_mm);
  }

  void note_extremes(uint8_t was, uint8_t is, double distance_mm, double settled_mm) {
    if (is != 0) tally_.deepest_kept_mm = std::max(tally_.deepest_kept_mm, -settled_mm);
    if (is != was && distance_mm < CuttingBody::reach_mm)
      tally_.farthest_changed_mm = std::max(tally_.farthest_changed_mm, distance_mm);
  }

  double level(double distance_mm) const {
    return std::clamp(255.0 * (0.5 + distance_mm / edge_mm_), 0.0, 255.0);
  }
  double inside_mm() const { return edge_mm_ * (0.5 + 1.0 / 64.0) + tolerance_mm_; }
  double outside_mm() const { return edge_mm_ * 0.5 + tolerance_mm_; }

  const voxel::BoneModel& bone_;
  const std::vector<uint8_t>& before_;
  const CuttingBody& body_;
  double edge_mm_, tolerance_mm_, fine_step_mm_;
  Path all_, settled_;
  SweptTally tally_;
};

}  // namespace

std::string SweptTally::text() const {
  std::ostringstream out;
  out << voxels << " voxels, " << bone_before << " of them bone, against " << poses << " poses, "
      << settled_poses << " of them settled: " << must_be_gone << " must be gone (" << not_gone << " wrong), "
      << must_be_kept << " must be kept (" << not_kept << " wrong), " << at_surface << " at the new surface ("
      << off_at_surface << " wrong), " << grown << " grown; removed " << removed_mm3
      << " mm3; bone left at most " << deepest_kept_mm << " mm inside, changed at most "
      << farthest_changed_mm << " mm outside";
  return out.str();
}

int64_t reported_levels(const std::vector<record::TickReport>& reports) {
  int64_t sum = 0;
  for (const auto& r : reports)
    for (const int64_t levels : r.coverage_removed) sum += levels;
  return sum;
}

SweptTally compare_with_sweep(const voxel::BoneModel& bone, const std::vector<uint8_t>& before,
                              const CuttingBody& body, const std::vector<record::TickReport>& reports,
                              double tolerance_mm) {
  return Comparison(bone, before, body, cutting_poses(reports, bone.grid), tolerance_mm).run();
}

}  // namespace ream::test
