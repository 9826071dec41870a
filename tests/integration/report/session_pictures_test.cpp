#include "report/session_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "score/deviation.hpp"

namespace ream::report {
namespace {

/// A plate of 60 mm across the axis -x, whose anterior half deviates.
ReamedBone plate(case_::Side side) {
  const double right = side == case_::Side::right ? 1.0 : -1.0;
  ReamedBone bone;
  constexpr uint32_t steps = 40;
  for (uint32_t i = 0; i <= steps; ++i)
    for (uint32_t k = 0; k <= steps; ++k) {
      bone.after.vertices_mm.emplace_back(0.0f, -30.0f + 1.5f * static_cast<float>(i),
                                          -30.0f + 1.5f * static_cast<float>(k));
      bone.after.normals.emplace_back(static_cast<float>(-right), 0.0f, 0.0f);
      const bool anterior = i < steps / 2;
      bone.from_plan.push_back(anterior ? score::deviation_code(1.5) : score::deviation_code(-1.5));
      bone.removed.push_back(1.0f);
    }
  for (uint32_t i = 0; i < steps; ++i)
    for (uint32_t k = 0; k < steps; ++k) {
      const uint32_t a = i * (steps + 1) + k, b = a + steps + 1;
      bone.after.triangles.push_back({a, b, a + 1});
      bone.after.triangles.push_back({b, b + 1, a + 1});
    }
  bone.before = bone.after;
  bone.plan.axis_direction = Vec3(right, 0.0, 0.0);  // medial of a right shoulder is LPS +x
  bone.side = side;
  bone.achieved = WorldAxis{Vec3(0, 1, 2), bone.plan.axis_direction};
  return bone;
}

std::array<int, 3> pixel(const render::Image& image, double x, double y) {
  const auto column = static_cast<size_t>(x * image.width), row = static_cast<size_t>(y * image.height);
  const uint8_t* p = image.rgba.data() + 4 * (row * static_cast<size_t>(image.width) + column);
  return {p[0], p[1], p[2]};
}

const Picture& titled(const std::vector<Picture>& pictures, const std::string& title) {
  const auto found =
      std::find_if(pictures.begin(), pictures.end(), [&](const Picture& p) { return p.title == title; });
  if (found == pictures.end()) throw std::logic_error("no picture " + title);
  return *found;
}

PictureLabel label(const Picture& picture, const std::string& words) {
  for (const PictureLabel& each : picture.labels)
    if (each.words == words) return each;
  throw std::logic_error("no label " + words);
}

TEST(SessionPictures, MapsShowEachSideWhereItsLabelIs) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left}) {
    const auto pictures = session_pictures(plate(side));
    const Picture& map = titled(pictures, "Achieved against planned surface");
    EXPECT_TRUE(map.is_map);
    const PictureLabel anterior = label(map, "anterior"), posterior = label(map, "posterior");
    EXPECT_LT(label(map, "superior").y, 0.15);
    EXPECT_GT(label(map, "inferior").y, 0.85);
    // Seen from lateral, anterior of a right shoulder is to the right.
    EXPECT_EQ(anterior.x > 0.5, side == case_::Side::right);
    // Halfway to the labels: purple (too deep) in front, orange (proud) behind. Stripes take turns with
    // colour.
    int bluest = -255, reddest = -255;
    for (double off = 0.0; off < 0.05; off += 0.002) {
      const auto front = pixel(map.image, 0.5 * (0.5 + anterior.x) + off, 0.5);
      const auto back = pixel(map.image, 0.5 * (0.5 + posterior.x) + off, 0.5);
      bluest = std::max(bluest, front[2] - front[1]);
      reddest = std::max(reddest, back[0] - back[2]);
    }
    EXPECT_GT(bluest, 50);
    EXPECT_GT(reddest, 90);
  }
}

TEST(SessionPictures, TheWallHasAPictureWhereItIsKnown) {
  ReamedBone bone = plate(case_::Side::right);
  bone.wall.assign(bone.after.vertices_mm.size(), 30);  // 7.5 mm
  const Picture map = titled(session_pictures(bone), "Bone left behind the reamed face");
  EXPECT_FALSE(map.is_map) << "its classes stand in its caption";
  EXPECT_NE(map.caption.find("5 to 10 mm"), std::string::npos);
  const auto middle = pixel(map.image, 0.45, 0.45);
  EXPECT_GT(middle[2], middle[0] + 40) << "turquoise";
}

TEST(SessionPictures, LabelsStayInsideAndPicturesSayWhatTheyAre) {
  const auto pictures = session_pictures(plate(case_::Side::left));
  EXPECT_EQ(pictures.size(), 5u) << "no implant, no map of its gap";
  for (const Picture& picture : pictures) {
    EXPECT_FALSE(picture.title.empty() || picture.caption.empty());
    EXPECT_GT(picture.image.width, 0);
    for (const PictureLabel& each : picture.labels) {
      EXPECT_GT(each.x, 0.02);
      EXPECT_LT(each.x, 0.98);
      EXPECT_GT(each.y, 0.02);
      EXPECT_LT(each.y, 0.98);
    }
  }
}

TEST(SessionPictures, AxialViewsAreReadAsSlicesAre) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left}) {
    const auto pictures = session_pictures(plate(side));
    const Picture& below = titled(pictures, "Axis from below");
    EXPECT_LT(label(below, "anterior").y, 0.15);
    EXPECT_EQ(label(below, "lateral").x < 0.5, side == case_::Side::right)
        << "the patient's right is on the left";
    const Picture& front = titled(pictures, "Axis from the front");
    EXPECT_LT(label(front, "superior").y, 0.15);
    EXPECT_EQ(label(front, "lateral").x < 0.5, side == case_::Side::right);
  }
}

TEST(SessionPictures, WithoutCutOrPlanThereIsStillSomethingToSee) {
  ReamedBone bone = plate(case_::Side::right);
  bone.from_plan.clear();
  bone.achieved.reset();
  std::fill(bone.removed.begin(), bone.removed.end(), 0.0f);
  const auto pictures = session_pictures(bone);
  EXPECT_EQ(pictures.size(), 4u);
  EXPECT_EQ(titled(pictures, "After").caption, "Nothing was cut.");
}

}  // namespace
}  // namespace ream::report
