#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "ct/build/import.hpp"
#include "device/simulated/scripted_device.hpp"
#include "sim/step.hpp"
#include "support/shared_data.hpp"
#include "support/swept_voxels.hpp"

namespace ream::test {
namespace {

constexpr double rim_backing_mm = 0.5;
constexpr double nipple_radius_mm = 3.1;  // the nipple guides and removes nothing
constexpr double envelope_tolerance_mm = 0.02;

case_::Case right_shoulder() {
  ct::ImportOptions options;
  options.build.roi_mm = Aabb{Vec3(-152, -26, 202), Vec3(-106, 20, 251)};
  options.side = case_::Side::right;
  options.label = shared_data("ct/shoulder_right_label.nii.gz");
  options.build.upsample = 8;
  case_::Case c = ct::import_ct(shared_data("ct/shoulder_dicom"), "right-shoulder", options).made;
  case_::Plan plan;
  plan.axis_direction = Vec3(0.706, 0.708, 0.0).normalized();
  const auto entry = case_::surface_along(c.bone, Vec3(-133.5, -6.4, 225.6), plan.axis_direction);
  EXPECT_TRUE(entry.has_value()) << "the axis misses the glenoid";
  plan.entry_mm = entry.value_or(Vec3::Zero());
  plan.reamer = shared_data("mesh/reamer_4006.stl");
  c.plan = plan;
  return c;
}

/// Approach, press, hold, withdraw.
device::Script hand_script() {
  device::Script script;
  script.duration_s = 16.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = Vec3(0, 0, -12);
  script.hand.force_profile = {{0.0, 0.0}, {0.2, 8.0}, {2.0, 8.0}, {4.0, 120.0}, {15.0, 120.0}, {15.2, -8.0}};
  return script;
}

/// One reaming on one backend, and its bone.
struct Reaming {
  Reaming(const case_::Case& c, const std::string& backend)
      : bone(c.bone),
        model(sim::make_model(*c.plan, bone, shell::make_tool(c.plan->reamer), settings(backend))),
        before(bone.coverage),
        state(model, bone) {
    const auto device = device::make_scripted_device(hand_script(), model.world_from_plan);
    device->open();
    device::DeviceInput input;
    record::TickReport report;
    while (device->read(input) == device::DeviceStatus::ok &&
           sim::step(model, state, input, report) == sim::StepStatus::ok) {
      device->write(sim::output_of(report));
      reports.push_back(report);
    }
  }

  static sim::Settings settings(const std::string& backend) {
    sim::Settings s;
    s.backend = backend;
    s.tool_spacing_mm = 0.1;
    s.stiffness_n_mm = hand_script().stiffness_n_mm;
    s.angular_stiffness_n_mm_rad = 1000.0 * s.stiffness_n_mm;
    s.energy_guarded = false;
    s.vibration.source = force::VibrationSource::off;
    s.feed.kind = force::FeedKind::edge;
    return s;
  }

  voxel::BoneModel bone;
  sim::Model model;
  std::vector<uint8_t> before;
  sim::State state;
  std::vector<record::TickReport> reports;
};

/// The library's word for where the tool's axis is in the mesh is needed to read its poses; that it is the
/// mesh's axis of revolution is seen from the rim, which must be a circle about it.
void expect_axis_of_the_mesh(const shell::Tool& tool) {
  EXPECT_GT(std::abs(tool.tool_from_mesh.rotation(2, 0)), 0.9999)
      << "the reamer's axis is along its file's x";
  double farthest[24] = {};
  for (const Vec3f& v : tool.mesh.vertices_mm) {
    const double turn = (std::atan2(v.y(), v.x()) / 6.283185307179586 + 0.5) * 24.0;
    double& in_sector = farthest[std::min(23, static_cast<int>(turn))];
    in_sector = std::max(in_sector, static_cast<double>(std::hypot(v.x(), v.y())));
  }
  const auto [low, high] = std::minmax_element(std::begin(farthest), std::end(farthest));
  EXPECT_LT(*high - *low, 0.1) << "rim about the tool's axis, mm";
}

TEST(RealShoulder, BoneIsGoneWhereTheReamerSweptAndNowhereElse) {
  REAM_SKIP_WITHOUT(shared_data("ct/shoulder_dicom"));
  REAM_SKIP_WITHOUT(shared_data("ct/shoulder_right_label.nii.gz"));
  REAM_SKIP_WITHOUT(shared_data("mesh/reamer_4006.stl"));
  const case_::Case c = right_shoulder();
  ASSERT_GE(c.bone.grid.dims.minCoeff(), 300);

  const Reaming reaming(c, "cpu");
  ASSERT_EQ(reaming.reports.size(), 16000u);
  EXPECT_EQ(reaming.bone.density, c.bone.density) << "density never changes";
  expect_axis_of_the_mesh(reaming.model.tool);

  const CuttingBody body(stl_meridian(c.plan->reamer, reaming.model.tool.tool_from_mesh, nipple_radius_mm),
                         rim_backing_mm);
  const SweptTally tally =
      compare_with_sweep(reaming.bone, reaming.before, body, reaming.reports, envelope_tolerance_mm);
  std::cout << "right shoulder: " << tally.text() << '\n';
  EXPECT_EQ(tally.levels_removed, reported_levels(reaming.reports));
  EXPECT_EQ(tally.not_gone, 0u);
  EXPECT_EQ(tally.not_kept, 0u);
  EXPECT_EQ(tally.off_at_surface, 0u);
  EXPECT_EQ(tally.grown, 0u);
  EXPECT_GT(tally.removed_mm3, 50.0);

  const Reaming again(c, "opencl");
  EXPECT_EQ(again.state.session_hash, reaming.state.session_hash);
  EXPECT_TRUE(again.bone.coverage == reaming.bone.coverage) << "the OpenCL form leaves the same bone";
}

}  // namespace
}  // namespace ream::test
