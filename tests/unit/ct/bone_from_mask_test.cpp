#include <gtest/gtest.h>

#include <random>

#include "ct/build/bone_from_mask.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "surface/block_mesh.hpp"
#include "unit/ct/shoulder_phantom.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::ct {
namespace {

struct Labelled {
  HuVolume volume;
  Mask scapula;
  GroundTruth truth;
};

const Labelled& shoulder() {
  static const Labelled made = [] {
    Phantom phantom = make_phantom(shoulder_params(case_::Side::right));
    const Segmentation labels = segment_shoulder(phantom.volume, {});
    return Labelled{std::move(phantom.volume), mask_of(labels.labels, BoneLabel::scapula), phantom.truth};
  }();
  return made;
}

void expect_closed(const voxel::BoneModel& bone, const std::string& what) {
  const TriangleMesh mesh = surface::whole_surface(bone.grid, bone.coverage.data());
  ASSERT_FALSE(mesh.triangles.empty()) << what;
  const surface::Topology t = surface::topology(mesh.vertices_mm.size(), mesh.triangles);
  EXPECT_TRUE(t.closed) << what << ": an edge is not in exactly two triangles";
  EXPECT_TRUE(t.one_fan_per_vertex) << what;
  EXPECT_EQ(t.euler % 2, 0) << what;
  EXPECT_GT(mesh.volume_mm3(), 0.0) << what;
  // Nothing is cut off by the grid's own border.
  const Aabb inner = bone.grid.bounds_mm().grown(-0.25 * bone.grid.min_spacing_mm());
  for (const Vec3f& p : mesh.vertices_mm) ASSERT_TRUE(inner.contains(p.cast<double>())) << what;
}

TEST(BoneFromMask, SurfaceIsClosedWhereverTheRegionCuts) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-12.0, 12.0), half(6.0, 16.0);
  for (int i = 0; i < 6; ++i) {
    BoneSettings settings;
    const Vec3 middle =
        shoulder().truth.glenoid.centre_mm + Vec3(8.0 + off(random), off(random), off(random));
    const Vec3 reach(half(random), half(random), half(random));
    settings.roi_mm = Aabb{middle - reach, middle + reach};
    settings.upsample = 1 + i % 3;
    expect_closed(bone_from_mask(shoulder().volume, shoulder().scapula, settings, no_progress),
                  "seed " + std::to_string(seed) + " region " + std::to_string(i));
  }
  expect_closed(bone_from_mask(shoulder().volume, shoulder().scapula, {}, no_progress), "whole bone");
}

TEST(BoneFromMask, ABoneThatFillsTheVolumeIsClosedToo) {
  HuVolume volume;
  volume.dims = {6, 7, 5};
  volume.spacing_mm = {1.0, 0.8, 1.5};
  volume.hu.assign(volume.voxel_count(), 700);
  const Mask all(volume.voxel_count(), 1);
  BoneSettings settings;
  settings.upsample = 4;
  const voxel::BoneModel bone = bone_from_mask(volume, all, settings, no_progress);
  expect_closed(bone, "full volume");
  const TriangleMesh mesh = surface::whole_surface(bone.grid, bone.coverage.data());
  EXPECT_NEAR(mesh.volume_mm3(), 6.0 * 5.6 * 7.5, 0.08 * 6.0 * 5.6 * 7.5);
}

TEST(BoneFromMask, TheRegionKeepsItsPlaceInTheWorld) {
  const case_::GlenoidFrame& glenoid = shoulder().truth.glenoid;
  case_::Case whole, part;
  BoneSettings settings;
  whole.bone = bone_from_mask(shoulder().volume, shoulder().scapula, settings, no_progress);
  settings.roi_mm = glenoid_roi_mm(glenoid.centre_mm, glenoid.lateral);
  settings.upsample = 2;
  part.bone = bone_from_mask(shoulder().volume, shoulder().scapula, settings, no_progress);
  EXPECT_LT(part.bone.grid.voxel_count(), 8 * whole.bone.grid.voxel_count());
  for (const case_::Case* c : {&whole, &part}) {
    const auto hit = case_::surface_along(c->bone, glenoid.centre_mm, -glenoid.lateral);
    ASSERT_TRUE(hit);
    EXPECT_LT((*hit - glenoid.centre_mm).norm(), 0.5);
  }
}

TEST(BoneFromMask, GlenoidRegionIsOfTheSizeSaidAndReachesMedially) {
  const Vec3 centre(-130, -5, 225), lateral(-0.8, -0.6, 0);
  const Aabb roi = glenoid_roi_mm(centre, 3.0 * lateral);
  EXPECT_LT((roi.max - roi.min - Vec3(60, 60, 70)).norm(), 1e-9);
  EXPECT_LT((roi.centre() - (centre - 15.0 * lateral)).norm(), 1e-9);
}

TEST(BoneFromMask, StatesItsDensityRange) {
  BoneSettings settings;
  const voxel::BoneModel bone = bone_from_mask(shoulder().volume, shoulder().scapula, settings, no_progress);
  const auto range = density_range_g_cc(bone);
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    if (bone.coverage[i] < 128) continue;
    ASSERT_GE(voxel::density_g_cc(bone.density[i]), range[0]);
    ASSERT_LE(voxel::density_g_cc(bone.density[i]), range[1]);
  }
  EXPECT_LT(range[0], range[1]);
  EXPECT_EQ(density_range_g_cc(voxel::BoneModel{}), (std::array<double, 2>{0.0, 0.0}));
}

TEST(BoneFromMask, RefusesWhatCannotBe) {
  const HuVolume& volume = shoulder().volume;
  BoneSettings settings;
  test::expect_error(ErrorKind::invalid_input, "holds no bone",
                     [&] { bone_from_mask(volume, Mask(volume.voxel_count()), settings, no_progress); });
  settings.upsample = 17;
  test::expect_error(ErrorKind::invalid_input, "factor 17",
                     [&] { bone_from_mask(volume, shoulder().scapula, settings, no_progress); });
  settings.upsample = 16;
  test::expect_error(ErrorKind::invalid_input, "1.5e9",
                     [&] { bone_from_mask(volume, shoulder().scapula, settings, no_progress); });
  settings.upsample = 1;
  settings.roi_mm = Aabb{Vec3(500, 500, 500), Vec3(510, 510, 510)};
  test::expect_error(ErrorKind::invalid_input, "region of interest holds no bone",
                     [&] { bone_from_mask(volume, shoulder().scapula, settings, no_progress); });
}

}  // namespace
}  // namespace ream::ct
