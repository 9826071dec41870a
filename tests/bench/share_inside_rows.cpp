#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include "bench/baselines/flat_kernel.hpp"
#include "bench/collide_parts.hpp"
#include "bench/depth_of_share.hpp"
#include "bench/our_contact.hpp"
#include "core/process_memory.hpp"
#include "sim/model.hpp"

namespace ream::bench {
namespace {

constexpr unsigned pose_seed = 42;
constexpr int inside_pose_count = 300, rounds = 5;
constexpr double inside_shell_spacing_mm = 0.1;

/// What the issue asks of one share of points inside; 0: nothing.
struct Goals {
  double best_us = 0.0, opencl_us = 0.0, best_times = 0.0, opencl_times = 0.0;
};

/// How the tool meets the face. On the plan's axis it lies close to the whole face before much of it is
/// inside, so that at 5 % inside 9 % are engaged and as many again are within a voxel. At its edge about as
/// many points are engaged as are inside.
struct Approach {
  const char* name;
  Vec3 shift_mm, tilt_rad;  ///< plan frame
};
const std::array approaches{Approach{"on the axis", Vec3::Zero(), Vec3::Zero()},
                            Approach{"at the edge", Vec3(8.0, 0.0, 0.0), Vec3(0.2, 0.0, 0.0)}};

/// The tool's apex at a depth below the entry, along the plan's axis.
QuantisedPose planned_pose(const case_::Case& c, const Approach& approach, double depth_mm,
                           const Vec3& tilt_rad) {
  const Pose plan_from_tool{rotation_from_small_vector(approach.tilt_rad + tilt_rad),
                            approach.shift_mm + Vec3(0.0, 0.0, depth_mm)};
  return quantised(c.bone.grid.world_from_grid.inverse() * sim::world_from_plan(*c.plan) * plan_from_tool);
}

/// A reamer at work around one depth: 0.1 um a tick down for 25 ticks and up again, and a tilt that wanders
/// by 5 urad a tick (0.08 um at the rim). Seated reaming at 52 N moves 0.04 um a tick.
std::vector<QuantisedPose> creeping_poses(const case_::Case& c, const Approach& approach, double depth_mm) {
  constexpr double creep_mm = 1e-4, tilt_step_rad = 5e-6, tilt_limit_rad = 1e-4;
  constexpr int stroke = 25;
  std::mt19937 random(pose_seed);
  std::uniform_real_distribution<double> one(-tilt_step_rad, tilt_step_rad);
  std::vector<QuantisedPose> poses;
  Vec3 tilt = Vec3::Zero();
  for (int i = 0; i < inside_pose_count; ++i) {
    for (int axis = 0; axis < 2; ++axis)
      tilt[axis] = std::clamp(tilt[axis] + one(random), -tilt_limit_rad, tilt_limit_rad);
    const int phase = i % (2 * stroke);
    const int ticks_down = phase < stroke ? phase : 2 * stroke - phase;
    poses.push_back(planned_pose(c, approach, depth_mm + creep_mm * (ticks_down - stroke / 2), tilt));
  }
  return poses;
}

/// What a share is measured with.
struct Contenders {
  case_::Case bone_case;
  shell::PointShell point_shell;
  MortonShell codes;
  Voxmap voxmap;
  OurBone bone;
  OurContact ours;
  gpu::Queue queue;
  FlatKernel flat;
  FlatThreads flat_threads;

  explicit Contenders(case_::Case c)
      : bone_case(std::move(c)),
        point_shell(shell::make_point_shell(shell::make_tool(shell::thesis_tool), inside_shell_spacing_mm)),
        codes(morton_shell(point_shell)),
        voxmap(voxmap_of(bone_case.bone)),
        bone(bone_case.bone),
        ours(bone, point_shell),
        queue(gpu::choose_device("auto", gpu::Use::tick)),
        flat(queue, voxmap, codes),
        flat_threads(voxmap, codes) {}

  std::vector<Contender> all() {
    return {
        ours.cpu(),
        ours.opencl(queue.device()),
        {"flat kernel, OpenCL", [this](const QuantisedPose& p) { return int64_t{flat.contact(p).inside}; }},
        {"flat, C++ one thread",
         [this](const QuantisedPose& p) { return int64_t{flat_contact_cpu(voxmap, codes, p).inside}; }},
        {"flat, decoded once, branch-free, two threads",
         [this](const QuantisedPose& p) { return int64_t{flat_threads.contact(p).inside}; }}};
  }
};

/// A tenth of the times is at most this. For ratios: on a machine with other work a long kernel is
/// interrupted more often than not and a short one rarely, which would flatter the short one; undisturbed,
/// the poses are all alike.
double undisturbed_us(const Samples& s) { return s.percentile(0.1); }

std::vector<Row> rows_of(const std::vector<Samples>& s, const std::string& name, double all_points,
                         const Goals& goals) {
  const Samples &cpu = s[0], &opencl = s[1], &flat = s[2], &fair = s[4];
  const double best_times = undisturbed_us(flat) / std::min(undisturbed_us(cpu), undisturbed_us(opencl));
  std::vector<Row> rows{
      {"collide", name + "points inside", 100.0 * flat.mean_found() / all_points, 0.0, "%", 0.0},
      {"collide", name + "points engaged, ours", 100.0 * cpu.mean_found() / all_points, 0.0, "%", 0.0}};
  for (const Samples& who : s) {
    const double goal_us = &who == &opencl ? goals.opencl_us : 0.0;
    rows.push_back({"collide", name + who.name + ", p50", who.percentile(0.5), 0.0, "us", goal_us});
    rows.push_back({"collide", name + who.name + ", p99", who.percentile(0.99), 0.0, "us", 0.0});
  }
  rows.push_back({"collide", name + "best backend, p50",
                  std::min(cpu.percentile(0.5), opencl.percentile(0.5)), 0.0, "us", goals.best_us});
  rows.push_back({"collide", name + "flat kernel / best backend, p10", best_times, 0.0, "times",
                  goals.best_times, Goal::at_least});
  rows.push_back({"collide", name + "flat kernel / ours, OpenCL, p10",
                  undisturbed_us(flat) / undisturbed_us(opencl), 0.0, "times", goals.opencl_times,
                  Goal::at_least});
  rows.push_back({"collide", name + "fair CPU form / ours, cpu, p10",
                  undisturbed_us(fair) / undisturbed_us(cpu), 0.0, "times", 0.0, Goal::at_least});
  return rows;
}

}  // namespace

std::vector<Row> share_inside_rows(const case_::Case& planned_case) {
  case_::Case copy = planned_case;
  case_::cut_pilot_hole(copy.bone, *copy.plan);
  Contenders scene(std::move(copy));
  prefer_huge_pages(scene.voxmap.gray.data(), scene.voxmap.gray.size());
  const std::vector<Contender> contenders = scene.all();
  const auto points = static_cast<double>(scene.codes.codes.size());
  std::vector<Row> rows;
  for (const auto& [share, goals] :
       {std::pair{0.05, Goals{20.0, 70.0, 60.0, 25.0}}, std::pair{0.20, Goals{200.0, 0.0, 10.0, 0.0}}})
    for (const Approach& approach : approaches) {
      const auto at = [&](double mm) { return planned_pose(scene.bone_case, approach, mm, Vec3::Zero()); };
      const double depth_mm = depth_of_share(scene.voxmap, scene.codes, share, -5.0, 25.0, at);
      const std::vector<QuantisedPose> poses = creeping_poses(scene.bone_case, approach, depth_mm);
      const std::vector<Samples> samples = measure_in_turns(contenders, poses, rounds);
      char name[96];
      std::snprintf(name, sizeof name,
                    "thesis-5-4-2 contact, %.0f %% inside %s, 0.1 um/tick: ", 100.0 * share, approach.name);
      for (Row& row : rows_of(samples, name, points, goals)) rows.push_back(std::move(row));
    }
  return rows;
}

}  // namespace ream::bench
