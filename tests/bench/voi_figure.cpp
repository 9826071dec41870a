#include "bench/voi_figure.hpp"

#include "bench/baselines/yau.hpp"
#include "bench/glenoid_block.hpp"
#include "bench/our_contact.hpp"
#include "bench/resolution_study.hpp"
#include "bench/text_table.hpp"

namespace ream::bench {
namespace {

constexpr int resolution = 512, poses_a_depth = 8, rounds = 3;
constexpr double depths_mm[] = {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
constexpr double creep_mm = 1e-3;
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
      "depth (um)",
      {"mm3", "% inside", "flat, VOI", "flat, none", "none/VOI", "cpu, VOI", "cpu, none", "none/VOI",
       "OpenCL, VOI", "OpenCL, none", "none/VOI"},
      {}};
  std::vector<Row> rows;
  for (const double depth_mm : depths_mm) {
    std::vector<QuantisedPose> poses;
    for (int i = 0; i < poses_a_depth; ++i) poses.push_back(pose_at_face(depth_mm + creep_mm * i));
    const std::vector<Samples> s = measure_in_turns(contenders, poses, rounds);
    const double volume_mm3 =
        static_cast<double>(volume.contact(poses.front()).collided) * bone.bone.grid.voxel_volume_mm3();
    TextTable::Line line{std::to_string(static_cast<int>(1000.0 * depth_mm)),
                         {volume_mm3, 100.0 * s[0].mean_found() / static_cast<double>(codes.codes.size())}};
    for (size_t i = 0; i < s.size(); i += 2) {
      const double with = s[i].mean_us(), without = s[i + 1].mean_us();
      line.values.insert(line.values.end(), {with, without, without / with});
      const std::string who = i == 0 ? "flat kernel" : s[i].name;
      rows.push_back({"collide",
                      "figure 4.4, " + std::to_string(static_cast<int>(volume_mm3)) + " mm3: VOI on, " + who +
                          " (baseline: off)",
                      with, without, "us", 0.0});
    }
    table.lines.push_back(std::move(line));
  }
  table.print(options.tables, 2);
  return rows;
}

}  // namespace ream::bench
