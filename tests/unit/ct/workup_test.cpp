#include "ct/build/ct_workspace.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/hu_volume.hpp"
#include "ct/phantom/phantom.hpp"
#include "support/json_schema.hpp"
#include "support/temporary_folder.hpp"

namespace ream::ct {
namespace {

namespace fs = std::filesystem;

const Phantom& coarse_phantom() {
  static const Phantom phantom = [] {
    PhantomParams params;
    params.spacing_mm = Vec3::Constant(1.5);
    return make_phantom(params);
  }();
  return phantom;
}

class WorkupTest : public testing::Test {
 protected:
  Workup made() { return create_workup(at, "anna", "Anna", case_::Side::right, coarse_phantom().volume); }
  void segment(Workup& workup, double threshold_hu) {
    SegmentationSettings settings;
    settings.threshold_hu = threshold_hu;
    add_segmentation(at, workup, settings, segment_shoulder(coarse_phantom().volume, settings, no_progress));
  }

  test::TemporaryFolder folder;
  const fs::path at = folder.path() / "anna";
};

TEST_F(WorkupTest, ComesBackAsItWasSaved) {
  Workup workup = made();
  segment(workup, 210.5);
  const Workup read = load_workup(at);
  EXPECT_EQ(to_json(read), to_json(workup));
  EXPECT_EQ(load_hu(at, read), coarse_phantom().volume.hu);
  ASSERT_NE(read.segmentation(), nullptr);
  EXPECT_EQ(read.segmentation()->threshold_hu, 210.5);
  EXPECT_EQ(load_labels(at, read, 1).size(), read.volume.voxel_count());
  EXPECT_EQ(read.volume.world_from_volume.translation_mm,
            coarse_phantom().volume.world_from_volume.translation_mm);
}

TEST_F(WorkupTest, IsAsItsSchemaSays) {
  Workup workup = made();
  segment(workup, 220.0);
  const auto hu = load_hu(at, workup);
  build_from(workup, hu, load_labels(at, workup, 1), coarse_phantom().truth.landmarks, {}, no_progress);
  const nlohmann::json schema = read_json_file(test::source_folder() + "/proto/ct.schema.json");
  EXPECT_EQ(test::schema_faults(schema, to_json(workup)), std::vector<std::string>{});
}

TEST_F(WorkupTest, UndoGoesBackStepByStepAndRevisionsAreNeverUsedTwice) {
  Workup workup = made();
  for (const double threshold : {200.0, 250.0, 300.0}) segment(workup, threshold);
  undo_segmentation(at, workup);
  EXPECT_EQ(workup.segmentation()->threshold_hu, 250.0);
  EXPECT_FALSE(fs::exists(at / "ct" / "labels-3.zst"));
  segment(workup, 350.0);
  EXPECT_EQ(workup.segmentation()->revision, 4);
  undo_segmentation(at, workup);
  undo_segmentation(at, workup);
  EXPECT_EQ(workup.segmentation()->revision, 1);
  EXPECT_THROW(undo_segmentation(at, workup), Error);
  EXPECT_EQ(to_json(load_workup(at)), to_json(workup));
}

TEST_F(WorkupTest, OnlySoManySegmentationsAreKept) {
  Workup workup = made();
  Segmentation none;
  none.labels.assign(workup.volume.voxel_count(), 0);
  for (size_t i = 0; i < kept_segmentations + 3; ++i) add_segmentation(at, workup, {}, none);
  EXPECT_EQ(workup.segmentations.size(), kept_segmentations);
  EXPECT_EQ(workup.segmentations.front().revision, 4);
  EXPECT_FALSE(fs::exists(at / "ct" / "labels-3.zst"));
  EXPECT_TRUE(fs::exists(at / "ct" / "labels-4.zst"));
}

TEST_F(WorkupTest, BuildsACaseAroundTheGlenoidAndKeepsTheRest) {
  Workup workup = made();
  segment(workup, 200.0);
  const auto hu = load_hu(at, workup);
  const auto labels = load_labels(at, workup, 1);
  const case_::Landmarks& landmarks = coarse_phantom().truth.landmarks;
  EXPECT_THROW(build_from(workup, hu, labels, case_::Landmarks{}, {}, no_progress), Error)
      << "no glenoid centre";
  BuildSettings settings;
  settings.upsample = 2;
  const case_::Case built = build_from(workup, hu, labels, landmarks, settings, no_progress);
  case_::save_landmarks(landmarks, at);
  case_::save_bone(built, at);
  save_workup(at, workup);
  const case_::Case read = case_::load_case(at);
  EXPECT_EQ(read.bone.coverage, built.bone.coverage);
  EXPECT_TRUE(case_::load_landmarks(at).has_value());
  EXPECT_EQ(load_hu(at, load_workup(at)), hu);
  ASSERT_TRUE(read.glenoid.has_value());
  EXPECT_GT(read.glenoid->lateral.dot(coarse_phantom().truth.glenoid.lateral), 0.999);
  const auto entry = case_::surface_along(read.bone, read.glenoid->centre_mm, -read.glenoid->lateral);
  ASSERT_TRUE(entry.has_value());
  EXPECT_LT((*entry - coarse_phantom().truth.glenoid.centre_mm).norm(), 1.5) << "within a CT voxel";
}

TEST_F(WorkupTest, ACaseWithoutABoneSaysSo) {
  made();
  try {
    case_::load_case(at);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::conflict);
    EXPECT_STREQ(error.what(), "case 'anna' holds only a CT so far; build its bone first, on its page");
  }
}

TEST_F(WorkupTest, DamagedFilesAreNamed) {
  const Workup workup = made();
  write_file_atomically(at / "ct" / "hu.zst", std::string_view("no zstd"));
  try {
    load_hu(at, workup);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              (at / "ct" / "hu.zst").string() + " is not zstd data; import the case again");
  }
  nlohmann::json value = to_json(workup);
  value["volume"]["dims"] = {0, 3, 3};
  EXPECT_THROW(workup_from_json(value, "ct.json"), Error);
  value = to_json(workup);
  value["colour"] = "red";
  EXPECT_THROW(workup_from_json(value, "ct.json"), Error);
}

TEST(Slice, IsThePlaneItSaysInTheOrderItSays) {
  const Vec3i dims(2, 3, 4);
  std::vector<int> voxels(24);
  for (size_t i = 0; i < voxels.size(); ++i) voxels[i] = static_cast<int>(i);
  const std::span<const int> all(voxels);
  EXPECT_EQ(slice_of(all, dims, 2, 1), (std::vector<int>{6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(slice_of(all, dims, 1, 2), (std::vector<int>{4, 5, 10, 11, 16, 17, 22, 23}));
  EXPECT_EQ(slice_of(all, dims, 0, 1), (std::vector<int>{1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23}));
}

}  // namespace
}  // namespace ream::ct
