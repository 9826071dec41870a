// Bone that came through a CT, noise and all, against the phantom's formulas: it is felt where it is, and a
// robot that is sent to a depth reams that depth.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "score/depth_gauge.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/step.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

constexpr double planned_mm = 1.0;

/// A CT of the demo's shoulder, segmented and made bone as an import makes it, with a plan straight down.
case_::Case scanned_case(double ct_voxel_mm, int upsample) {
  ct::PhantomParams params = ct::phantom_preset("demo").params;
  params.spacing_mm = Vec3::Constant(ct_voxel_mm);
  const ct::Phantom phantom = ct::make_phantom(params);
  const case_::GlenoidFrame& glenoid = phantom.truth.glenoid;
  ct::Mask mask = ct::above_threshold(phantom.volume, params.calibration.threshold_hu);
  const auto seed = ct::nearest_set(mask, phantom.volume, glenoid.centre_mm - 5.0 * glenoid.lateral, 2.0);
  mask = ct::grown_from(mask, phantom.volume.dims, seed.value());
  ct::BoneSettings settings;
  settings.roi_mm = ct::glenoid_roi_mm(glenoid.centre_mm, glenoid.lateral);
  settings.upsample = upsample;
  case_::Case result;
  result.id = result.name = "scanned";
  result.bone = ct::bone_from_mask(phantom.volume, mask, settings, no_progress);
  result.glenoid = glenoid;
  case_::Plan plan;
  plan.entry_mm = glenoid.centre_mm;
  plan.axis_direction = -glenoid.lateral;
  plan.depth_mm = planned_mm;
  plan.reamer = "sphere 30,11";  // sharper than the face, so that it touches with its apex first
  plan.pilot_hole.reset();
  result.plan = plan;
  return result;
}

session::SimulationSetup robot_on(const case_::Case& scanned, const TemporaryFolder& folder) {
  case_::save_case(scanned, folder.path() / "data/cases/scanned");
  const nlohmann::json script = {{"device", "robot"},
                                 {"duration_s", 120.0},
                                 {"buttons", {{{"t_s", 0}, {"irrigate", true}}}},
                                 {"robot",
                                  {{"start_mm", {0, 0, -6}},
                                   {"approach_mm_s", 2},
                                   {"force_n", 52},
                                   {"ramp_s", 2},
                                   {"depth_mm", planned_mm},
                                   {"line_stiffness_n_mm", 1000}}}};
  write_file_atomically(folder.path() / "script.json", script.dump());
  session::RunRequest request;
  request.case_name = "scanned";
  request.script_name = (folder.path() / "script.json").string();
  request.backend = "cpu";
  request.tool_spacing_mm = 0.4;
  return session::build_setup(request, folder.path() / "data");
}

struct Scan {
  double ct_voxel_mm;
  int upsample;
};

class ScannedBone : public testing::TestWithParam<Scan> {};

TEST_P(ScannedBone, IsFeltWhereItIsAndReamedAsDeepAsPlanned) {
  const auto [ct_voxel_mm, upsample] = GetParam();
  const double tolerance_mm = std::max(0.1, 0.25 * ct_voxel_mm);
  const case_::Case scanned = scanned_case(ct_voxel_mm, upsample);
  const TemporaryFolder folder;
  session::Simulation simulation(robot_on(scanned, folder));
  const voxel::BoneModel& bone = simulation.bone_case.bone;
  score::DepthGauge gauge(simulation.native);
  std::optional<double> first_contact_mm;
  double apex_depth_mm = 0.0, deepest_mm = 0.0;
  simulation.device->open();
  device::DeviceInput input;
  while (simulation.device->read(input) == device::DeviceStatus::ok) {
    record::TickReport report;
    ASSERT_EQ(sim::step(simulation.model, simulation.state, input, report), sim::StepStatus::ok);
    simulation.device->write(sim::output_of(report));
    apex_depth_mm =
        (report.world_from_tool.translation_mm - scanned.plan->entry_mm).dot(scanned.plan->axis_direction);
    if (report.engaged && !first_contact_mm) first_contact_mm = apex_depth_mm;
    deepest_mm = std::max(deepest_mm, apex_depth_mm);
  }
  simulation.device->close();
  ASSERT_TRUE(first_contact_mm);
  EXPECT_NEAR(*first_contact_mm, 0.0, tolerance_mm) << "depth of the apex below the true face";
  EXPECT_NEAR(gauge.measure({bone.grid, bone.coverage.data()}), planned_mm, tolerance_mm);
  EXPECT_NEAR(deepest_mm, planned_mm, 2.0 * tolerance_mm) << "below the true face";
}

INSTANTIATE_TEST_SUITE_P(Scans, ScannedBone,
                         testing::Values(Scan{0.6, 1}, Scan{0.6, 3}, Scan{0.4, 2}, Scan{0.3, 1}),
                         [](const testing::TestParamInfo<Scan>& scan) {
                           return "CtVoxelsOf" + std::to_string(std::lround(scan.param.ct_voxel_mm * 1000)) +
                                  "UmUpsampledBy" + std::to_string(scan.param.upsample);
                         });

}  // namespace
}  // namespace ream::test
