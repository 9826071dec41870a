#include "bench/voi_figure.hpp"

#include <cstdio>

#include "bench/baselines/yau.hpp"
#include "bench/depth_of_share.hpp"
#include "bench/glenoid_block.hpp"
#include "bench/our_contact.hpp"
#include "bench/resolution_study.hpp"
#include "bench/text_table.hpp"

namespace ream::bench {
namespace {

constexpr int resolution = 512, poses_a_depth = 8, rounds = 6;
constexpr double shares_inside[] = {0.0025, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4};
/// So that contact starts at the edge of the face and grows from nothing.
const Vec3 tilt_rad(0.15, 0.1, 0.0);
constexpr double figure_creep_mm = 1e-3, least_depth_mm = -10.0, largest_depth_mm = 20.0;
/// The cap alone: a nipple would be in the bone before the cap is.
constexpr const char* tool_text = "ellipse 16,8 back 1.25";
constexpr ImplicitCap cap{16.0, 8.0, 8.0};

}  // namespace

std::vector<Row> voi_figure(const Options& options) {
  OurBone bone(glenoid_block(resolution));
  Voxmap voxmap = voxmap_of(bone.bone);
  const shell::PointShell shell =
      shell::make_point_shell(shell::make_tool(tool_text), shell_spacing_mm(resolution));
  const MortonShell codes = morton_shell(shell);
  const OurContact ours(bone, shell);
  const gpu::Queue queue(gpu::choose_device("auto", gpu::Use::tick));
  FlatKernel flat(queue, voxmap, codes);
  Yau volume(queue, voxmap, cap);
  const auto flat_with = [&](bool use_voi) {
    return [&flat, use_voi](const QuantisedPose& p) {
      return int64_t{flat.contact(p, {.use_voi = use_voi}).inside};
    };
  };
  const std::vector<Contender> contenders{{"flat kernel, VOI", flat_with(true)},
                                          {"flat kernel, none", flat_with(false)},
                                          ours.cpu(true),
                                          ours.cpu(false),
                                          ours.opencl(queue.device(), true),
                                          ours.opencl(queue.device(), false)};
  TextTable table{
      "Figure 4.4: contact (us) with the VOI and without, against intersection volume; 512^3 both",
      "% of points inside",
      {"depth mm", "mm3", "flat, VOI", "flat, none", "none/VOI", "cpu, VOI", "cpu, none", "none/VOI",
       "OpenCL, VOI", "OpenCL, none", "none/VOI"},
      {}};
  std::vector<Row> rows;
  const auto pose_at = [](double depth_mm) { return pose_at_face(depth_mm, Vec3::Zero(), tilt_rad); };
  for (const double share : shares_inside) {
    const double depth_mm = depth_of_share(voxmap, codes, share, least_depth_mm, largest_depth_mm, pose_at);
    std::vector<QuantisedPose> poses;
    for (int i = 0; i < poses_a_depth; ++i) poses.push_back(pose_at(depth_mm + figure_creep_mm * i));
    const std::vector<Samples> s = measure_in_turns(contenders, poses, rounds);
    const double volume_mm3 =
        static_cast<double>(volume.contact(poses.front()).collided) * bone.bone.grid.voxel_volume_mm3();
    char label[32];
    std::snprintf(label, sizeof label, "%.2f",
                  100.0 * s[0].mean_found() / static_cast<double>(codes.codes.size()));
    TextTable::Line line{label, {depth_mm, volume_mm3}};
    for (size_t i = 0; i < s.size(); i += 2) {
      const double with = s[i].mean_us(), without = s[i + 1].mean_us();
      line.values.insert(line.values.end(), {with, without, without / with});
      const std::string who = i == 0 ? "flat kernel" : s[i].name;
      rows.push_back({"collide",
                      std::string("figure 4.4, ") + label + " % inside: VOI on, " + who + " (baseline: off)",
                      with, without, "us", 0.0});
    }
    table.lines.push_back(std::move(line));
  }
  table.print(options.tables, 2);
  return rows;
}

}  // namespace ream::bench
