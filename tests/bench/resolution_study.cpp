#include "bench/resolution_study.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "bench/baselines/yau.hpp"
#include "bench/baselines/zheng.hpp"
#include "bench/glenoid_block.hpp"
#include "bench/memory.hpp"
#include "core/process_memory.hpp"

namespace ream::bench {
namespace {

constexpr unsigned seed = 41;
constexpr int pose_count = 64, baseline_rounds = 2, our_rounds = 3, finest_rounds = 10, held_rounds = 2;
constexpr int pose_search_shell = 128;
/// Ticks that the tool stays at some of the severe poses, creeping; the last ones are compared.
constexpr int held_ticks = 300, compared_ticks = 20;
constexpr size_t held_poses = 12;
constexpr double study_creep_mm = 1e-4, compared_probe_mm = 0.1;
constexpr int coarsest_compared_voxmap = 256;
constexpr ImplicitCap thesis_cap{16.0, 8.0, 8.0};  // shell::thesis_tool without nipple and back

struct StudiedShell {
  shell::PointShell points;
  MortonShell codes;
};

StudiedShell studied_shell(int resolution) {
  StudiedShell s;
  s.points = shell::make_point_shell(shell::make_tool(shell::thesis_tool), shell_spacing_mm(resolution));
  s.codes = morton_shell(s.points);
  return s;
}

struct Study {
  ResolutionStudy result{};
  gpu::Queue one_thread{gpu::choose_device("auto", gpu::Use::tick)};
  gpu::Queue all_cores{gpu::choose_device("auto", gpu::Use::bulk)};
  std::vector<StudiedShell> shells;
  std::vector<QuantisedPose> poses;
  /// The finest shell at the compared Voxmaps, kept to be measured in turns at the end.
  std::vector<std::unique_ptr<OurBone>> bones;
  std::vector<std::unique_ptr<OurContact>> finest;

  double mean_us(const std::function<int64_t(const QuantisedPose&)>& contact) const {
    const Contender contender{"", contact};
    return measure_in_turns({&contender, 1}, poses, baseline_rounds).front().mean_us();
  }

  void measure_flat(Voxmap& voxmap, const StudiedShell& s, double* us) {
    for (const auto& [queue, method] :
         {std::pair{&one_thread, Method::flat_one_thread}, std::pair{&all_cores, Method::flat_all_cores}}) {
      FlatKernel flat(*queue, voxmap, s.codes);
      us[static_cast<size_t>(method)] =
          mean_us([&](const QuantisedPose& p) { return int64_t{flat.contact(p).inside}; });
    }
  }

  void measure_zheng(const Voxmap& voxmap, const StudiedShell& s, double* us) {
    {
      Zheng zheng(one_thread, voxmap, s.codes);
      us[static_cast<size_t>(Method::zheng_one_thread)] =
          mean_us([&](const QuantisedPose& p) { return zheng.contact(p, true).inside; });
    }
    Zheng zheng(all_cores, voxmap, s.codes);
    us[static_cast<size_t>(Method::zheng_all_cores)] =
        mean_us([&](const QuantisedPose& p) { return zheng.contact(p, true).inside; });
    us[static_cast<size_t>(Method::zheng_flags_left)] =
        mean_us([&](const QuantisedPose& p) { return zheng.contact(p, false).inside; });
  }

  void measure_ours(const OurContact& ours, double* us) {
    const std::vector<Contender> contenders{ours.cpu(), ours.opencl(one_thread.device())};
    const std::vector<Samples> samples = measure_in_turns(contenders, poses, our_rounds);
    us[static_cast<size_t>(Method::ours_cpu)] = samples[0].mean_us();
    us[static_cast<size_t>(Method::ours_opencl)] = samples[1].mean_us();
  }

  void measure_voxmap(size_t v);
  void measure_finest();
};

void Study::measure_voxmap(size_t v) {
  const int resolution = voxmap_resolutions[v];
  std::fprintf(stderr, "ream-bench: Voxmap %d^3\n", resolution);
  auto bone = std::make_unique<OurBone>(glenoid_block(resolution));
  Voxmap voxmap = voxmap_of(bone->bone);
  prefer_huge_pages(voxmap.gray.data(), voxmap.gray.size());
  result.voxmap_bytes[v + 1] = static_cast<double>(memory_of(*bone));
  Yau yau_one(one_thread, voxmap, thesis_cap), yau_all(all_cores, voxmap, thesis_cap);
  result.yau_one_thread_us[v] = mean_us([&](const QuantisedPose& p) { return yau_one.contact(p).collided; });
  result.yau_all_cores_us[v] = mean_us([&](const QuantisedPose& p) { return yau_all.contact(p).collided; });
  for (size_t s = 0; s < shells.size(); ++s) {
    double* us = result.us[v][s];
    std::fill_n(us, method_count, not_measured);
    auto ours = std::make_unique<OurContact>(*bone, shells[s].points);
    result.shell_bytes[s] = static_cast<double>(ours->shell().bytes());
    measure_flat(voxmap, shells[s], us);
    if (resolution <= Zheng::largest_resolution) measure_zheng(voxmap, shells[s], us);
    measure_ours(*ours, us);
    // Probes of one length, so that the same points touch whatever the Voxmap.
    if (s + 1 == shells.size() && resolution >= coarsest_compared_voxmap)
      finest.push_back(std::make_unique<OurContact>(*bone, shells[s].points, compared_probe_mm));
  }
  if (resolution >= coarsest_compared_voxmap) bones.push_back(std::move(bone));
}

/// The severe poses as reaming meets them: the tool stays for a while and creeps along its axis.
std::vector<QuantisedPose> held(std::span<const QuantisedPose> poses) {
  std::vector<QuantisedPose> ticks;
  for (const QuantisedPose& pose : poses)
    for (int i = 0; i < held_ticks; ++i)
      ticks.push_back(
          quantised(dequantised(pose) * Pose{Mat3::Identity(), Vec3(0.0, 0.0, study_creep_mm * i)}));
  return ticks;
}

/// Only the last ticks at each pose.
Samples compared(const Samples& all) {
  Samples last{all.name, std::vector<std::vector<double>>(all.us.size()), {}};
  for (size_t i = 0; i < all.found.size(); ++i) {
    if (i % held_ticks < held_ticks - compared_ticks) continue;
    last.found.push_back(all.found[i]);
    for (size_t round = 0; round < all.us.size(); ++round) last.us[round].push_back(all.us[round][i]);
  }
  return last;
}

/// The Voxmaps take turns, so that the machine's noise does not pass for an influence of the resolution.
void Study::measure_finest() {
  std::vector<Contender> contenders;
  for (const auto& ours : finest) {
    contenders.push_back(ours->cpu());
    contenders.push_back(ours->opencl(one_thread.device()));
  }
  const std::vector<Samples> leaping = measure_in_turns(contenders, poses, finest_rounds);
  std::vector<Samples> samples =
      measure_in_turns(contenders, held(std::span(poses).first(held_poses)), held_rounds);
  std::transform(samples.begin(), samples.end(), samples.begin(), compared);
  double best_p99 = 1e300;
  for (size_t backend = 0; backend < 2; ++backend) {
    double least = 1e300, largest = 0.0;
    const std::string name = contenders[backend].name;
    for (size_t i = backend; i < samples.size(); i += 2) {
      const double mean = samples[i].mean_us();
      least = std::min(least, mean);
      largest = std::max(largest, mean);
      const std::string at =
          "PointShell 1024^3, Voxmap " +
          std::to_string(voxmap_resolutions[voxmap_resolutions.size() - finest.size() + i / 2]) +
          "^3, held at severe poses: " + name;
      result.rows.push_back({"collide", at + ", mean", mean, 0.0, "us", 0.0});
      result.rows.push_back(
          {"collide", at + ", points engaged", samples[i].mean_found(), 0.0, "points", 0.0});
    }
    for (const auto& [kind, of] :
         {std::pair{"leaping between severe poses", &leaping}, {"held there", &samples}}) {
      const double p99 = (*of)[of->size() - 2 + backend].percentile(0.99);
      if (of == &leaping) best_p99 = std::min(best_p99, p99);
      result.rows.push_back({"collide",
                             "PointShell 1024^3, Voxmap 1024^3, " + std::string(kind) + ": " + name + ", p99",
                             p99, 0.0, "us", 0.0});
    }
    result.rows.push_back({"collide", "Voxmap 256^3 to 1024^3 changes contact by: " + name,
                           100.0 * (largest - least) / least, 0.0, "%", 15.0});
  }
  result.rows.push_back({"collide", "PointShell 1024^3, Voxmap 1024^3, leaping: best backend, p99", best_p99,
                         0.0, "us", 1000.0});
}

}  // namespace

double shell_spacing_mm(int resolution) {
  constexpr double thesis_tool_length_mm = 43.4;
  return thesis_tool_length_mm / resolution;
}

double ResolutionStudy::best_of_ours_us(size_t voxmap, size_t shell) const {
  return std::min(time_us(voxmap, shell, Method::ours_cpu), time_us(voxmap, shell, Method::ours_opencl));
}

ResolutionStudy study_resolutions() {
  Study study;
  for (size_t s = 0; s < shell_resolutions.size(); ++s) {
    study.shells.push_back(studied_shell(shell_resolutions[s]));
    study.result.points[s] = static_cast<double>(study.shells.back().codes.codes.size());
  }
  const MortonShell search_shell = studied_shell(pose_search_shell).codes;
  study.poses = severe_poses(search_shell, pose_count, seed);
  Voxmap voxmap = voxmap_of(glenoid_block(coarsest_compared_voxmap));
  for (const QuantisedPose& pose : study.poses)
    study.result.mean_inside += flat_contact_cpu(voxmap, study.shells.back().codes, pose).inside /
                                study.result.points[4] / pose_count;
  study.result.voxmap_bytes[0] = static_cast<double>(memory_of(OurBone(glenoid_block(shell_resolutions[0]))));
  for (size_t v = 0; v < voxmap_resolutions.size(); ++v) study.measure_voxmap(v);
  study.measure_finest();
  return study.result;
}

}  // namespace ream::bench
