#include "case/case.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"

namespace ream::case_ {
namespace {

namespace fs = std::filesystem;

class CaseFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / ("ream-case-" + std::to_string(::getpid()) + "-" + info->name());
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static Case sample() {
    voxel::VoxelGrid grid;
    grid.dims = {16, 8, 24};
    grid.spacing_mm = {0.1, 0.2, 1.0 / 3.0};
    grid.world_from_grid.rotation = rotation_from_small_vector({0.1, -0.2, 0.3});
    grid.world_from_grid.translation_mm = {-10.1, 20.2, 1.0 / 7.0};
    Case c;
    c.id = "a-case-1";
    c.name = "A case";
    c.source = "test";
    c.side = Side::left;
    c.bone = voxel::make_bone(grid);
    for (size_t i = 0; i < c.bone.coverage.size(); ++i) {
      c.bone.coverage[i] = static_cast<uint8_t>(mix64(i));
      c.bone.density.writable()[i] = static_cast<uint8_t>(mix64(i + 1000000) % 251);
    }
    c.calibration = {1.5, 0.7, 180.0};
    c.glenoid = GlenoidFrame{{1, 2, 3}, Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
    c.plan = Plan{{1.25, -2.5, 1.0 / 3.0}, Vec3(1, 2, 2) / 3.0, 1.5, "sphere 20", PilotHole{5.0, 9.0}};
    c.cutting = force::CuttingCoefficients{};
    c.cutting->edge_reference_mm = 20.0;
    c.cutting->edge_threshold_share = 0.25;
    c.cutting->tangential_ratio = 1.2;
    c.warnings = {"odd"};
    return c;
  }

  std::string complaint_of_loading(const fs::path& folder) {
    try {
      load_case(folder);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

  /// A saved sample whose case.json was changed by `edit`.
  fs::path edited(const std::function<void(nlohmann::json&)>& edit) {
    const fs::path folder = root_ / "edited";
    save_case(sample(), folder, true);
    nlohmann::json value = read_json_file(folder / "case.json");
    edit(value);
    write_file_atomically(folder / "case.json", value.dump());
    return folder;
  }

  fs::path root_;
};

TEST_F(CaseFolder, RoundTripKeepsEveryBit) {
  const Case c = sample();
  save_case(c, root_ / "c");
  const Case r = load_case(root_ / "c");
  EXPECT_EQ(r.id, c.id);
  EXPECT_EQ(r.name, c.name);
  EXPECT_EQ(r.source, c.source);
  EXPECT_EQ(r.side, c.side);
  EXPECT_EQ(r.bone.grid.dims, c.bone.grid.dims);
  EXPECT_EQ(r.bone.grid.spacing_mm, c.bone.grid.spacing_mm);
  EXPECT_EQ(r.bone.grid.world_from_grid.rotation, c.bone.grid.world_from_grid.rotation);
  EXPECT_EQ(r.bone.grid.world_from_grid.translation_mm, c.bone.grid.world_from_grid.translation_mm);
  EXPECT_EQ(r.bone.coverage, c.bone.coverage);
  EXPECT_EQ(r.bone.density, c.bone.density);
  EXPECT_EQ(r.calibration.slope_mg_cc_per_hu, c.calibration.slope_mg_cc_per_hu);
  EXPECT_EQ(r.glenoid->centre_mm, c.glenoid->centre_mm);
  EXPECT_EQ(r.plan->entry_mm, c.plan->entry_mm);
  EXPECT_EQ(r.plan->axis_direction, c.plan->axis_direction);
  EXPECT_EQ(r.plan->reamer, c.plan->reamer);
  EXPECT_EQ(r.plan->pilot_hole->depth_mm, 9.0);
  ASSERT_TRUE(r.cutting.has_value());
  EXPECT_EQ(r.cutting->edge_reference_mm, 20.0);
  EXPECT_EQ(r.cutting->edge_threshold_share, 0.25);
  EXPECT_EQ(r.cutting->tangential_ratio, 1.2);
  EXPECT_EQ(r.warnings, c.warnings);
  const Case described = load_case_description(root_ / "c");
  EXPECT_EQ(described.id, c.id);
  EXPECT_EQ(described.bone.grid.dims, c.bone.grid.dims);
  EXPECT_TRUE(described.plan.has_value());
  EXPECT_TRUE(described.bone.coverage.empty());
}

TEST_F(CaseFolder, NamesWhatIsWrong) {
  const auto has = [&](const std::function<void(nlohmann::json&)>& edit, const std::string& words) {
    const std::string text = complaint_of_loading(edited(edit));
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  };
  has([](auto& v) { v["colour"] = 1; }, "key 'colour' is unknown");
  has([](auto& v) { v["world_from_grid"]["scale"] = 1; }, "key 'scale' is unknown");
  has([](auto& v) { v.erase("side"); }, "key 'side' is missing");
  has([](auto& v) { v["side"] = "up"; }, "key 'side' must be left or right");
  has([](auto& v) { v["dims"] = {0, 8, 8}; }, "key 'dims'");
  has([](auto& v) { v["dims"] = {12, 8, 8}; }, "multiples of 8");
  has([](auto& v) { v["dims"] = {16, 8, 16}; }, "case.json says 2048");
  has([](auto& v) { v["spacing_mm"] = {0.1, 0.0, 0.1}; }, "voxel size");
  has([](auto& v) { v["world_from_grid"]["rotation"][0][0] = 5.0; }, "key 'rotation'");
  has([](auto& v) { v["cutting"]["edge_reference_mm"] = 4.0; }, "key 'edge_reference_mm'");
  has([](auto& v) { v["cutting"]["friction"] = 1.0; }, "key 'friction' is unknown");
  has([](auto& v) { v["id"] = "Not An Id"; }, "key 'id'");
  EXPECT_NE(complaint_of_loading(root_ / "nowhere").find("is not a case"), std::string::npos);
}

TEST_F(CaseFolder, DamagedVoxelsAreNoticed) {
  save_case(sample(), root_ / "c");
  fs::resize_file(root_ / "c" / "coverage.zst", fs::file_size(root_ / "c" / "coverage.zst") / 2);
  EXPECT_NE(complaint_of_loading(root_ / "c").find("coverage.zst is damaged"), std::string::npos);
  std::ofstream(root_ / "c" / "coverage.zst") << "no zstd";
  EXPECT_NE(complaint_of_loading(root_ / "c").find("is not zstd data"), std::string::npos);
}

TEST_F(CaseFolder, AnExistingCaseIsReplacedOnlyOnRequest) {
  Case c = sample();
  save_case(c, root_ / "c");
  EXPECT_THROW(save_case(c, root_ / "c"), Error);
  c.name = "Another";
  save_case(c, root_ / "c", true);
  EXPECT_EQ(load_case(root_ / "c").name, "Another");
  size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(root_)) ++entries;
  EXPECT_EQ(entries, 1u) << "a temporary was left";
}

TEST_F(CaseFolder, PlanIsReplacedAlone) {
  save_case(sample(), root_ / "c");
  Plan plan;
  plan.entry_mm = {7, 8, 9};
  plan.pilot_hole.reset();
  save_plan(plan, root_ / "c");
  const Case r = load_case(root_ / "c");
  EXPECT_EQ(r.plan->entry_mm, plan.entry_mm);
  EXPECT_FALSE(r.plan->pilot_hole);
  EXPECT_THROW(save_plan(plan, root_ / "nowhere"), Error);
  plan.depth_mm = std::nan("");
  EXPECT_THROW(save_plan(plan, root_ / "c"), Error);
}

TEST(Plan, ReadsStrictly) {
  const nlohmann::json good = {
      {"entry_mm", {1, 2, 3}}, {"axis_direction", {0, 0, 2}}, {"depth_mm", 2}, {"reamer", "sphere 20"}};
  const Plan plan = plan_from_json(good, "p");
  EXPECT_EQ(plan.axis_direction, Vec3::UnitZ());
  EXPECT_FALSE(plan.pilot_hole);
  const auto bad = [&](const char* key, nlohmann::json value) {
    nlohmann::json v = good;
    v[key] = std::move(value);
    EXPECT_THROW(plan_from_json(v, "p"), Error) << key;
  };
  bad("axis_direction", {0, 0, 0});
  bad("entry_mm", {0, 0});
  bad("depth_mm", -1);
  bad("depth_mm", "2");
  bad("pilot_depth_mm", 3);
  bad("speed", 3);
  bad("reamer", "");
  bad("guide", "nipple");  // without a pilot hole
  bad("guide", "rail");
  bad("guide", 1);
}

TEST(Plan, KeepsItsGuide) {
  nlohmann::json value = {{"entry_mm", {1, 2, 3}}, {"axis_direction", {0, 0, 1}}, {"depth_mm", 2},
                          {"reamer", "sphere 20"}, {"pilot_diameter_mm", 6.2},    {"pilot_depth_mm", 12}};
  EXPECT_EQ(plan_from_json(value, "p").guide, GuideKind::none);
  for (const GuideKind kind : {GuideKind::none, GuideKind::nipple, GuideKind::pin}) {
    value["guide"] = to_text(kind);
    const Plan plan = plan_from_json(value, "p");
    EXPECT_EQ(plan.guide, kind);
    EXPECT_EQ(plan_from_json(to_json(plan), "p").guide, kind);
  }
}

}  // namespace
}  // namespace ream::case_
