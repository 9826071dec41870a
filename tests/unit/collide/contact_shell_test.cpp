#include "collide/contact/contact_shell.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "shell/tool.hpp"

namespace ream::collide {
namespace {

struct Made {
  explicit Made(const char* tool_text, double spacing_mm, double probe_length_mm)
      : shell(shell::make_point_shell(shell::make_tool(tool_text), spacing_mm)),
        contact(make_contact_shell(shell, probe_length_mm)) {}
  shell::PointShell shell;
  ContactShell contact;
};

const Made& thesis() {
  static const Made made("thesis", 0.1, 0.0835);
  return made;
}

TEST(ContactShell, BlocksAndChunksHoldEveryPointOnce) {
  const ContactShell& contact = thesis().contact;
  EXPECT_GE(contact.size(), thesis().shell.points.size());
  uint32_t next = 0;
  ASSERT_EQ(contact.first_chunks.size(), contact.blocks.size() + 1);
  for (size_t b = 0; b < contact.blocks.size(); ++b) {
    const ContactBlock& block = contact.blocks[b];
    ASSERT_EQ(block.first, next);
    ASSERT_GT(block.count, 0);
    ASSERT_LE(block.count, max_block_points);
    ASSERT_EQ(contact.first_chunks[b + 1] - contact.first_chunks[b], (block.count + 15u) / 16u);
    next += block.count;
  }
  EXPECT_EQ(next, contact.size());
}

TEST(ContactShell, TakesNoMoreThanTwelveBytesAPoint) {
  EXPECT_LT(static_cast<double>(thesis().contact.bytes()) / static_cast<double>(thesis().contact.size()),
            12.0);
}

TEST(ContactShell, SpheresHoldTheirProbesAndSumsAreThoseOfTheirPoints) {
  const ContactShell& contact = thesis().contact;
  for (size_t b = 0; b < contact.blocks.size(); ++b) {
    const ContactBlock& block = contact.blocks[b];
    const Vec3 centre(contact.centre_x_mm[b], contact.centre_y_mm[b], contact.centre_z_mm[b]);
    ContactProducts products{};
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      ASSERT_LE((contact.probe_mm(block, i) - centre).norm(), contact.radius_mm[b]);
      add_products(contact.table.vector(contact.direction(i)), products);
    }
    ASSERT_EQ(products, block.whole);
  }
}

/// Points change places inside a block, so both are sorted into the same order first.
TEST(ContactShell, CuttingProbesStandOnTheSurfaceWithItsNormal) {
  const Made made("sphere 20", 0.2, 0.3);
  const Vec3 centre(0, 0, -20.0);  // the apex is the tool's origin
  size_t cutting = 0;
  for (const ContactBlock& block : made.contact.blocks) {
    if (block.guiding) continue;
    for (uint32_t i = block.first; i < block.first + block.count; ++i, ++cutting) {
      const Vec3 probe = made.contact.probe_mm(block, i);
      const Vec3 normal = (probe - centre).normalized();
      ASSERT_NEAR((probe - centre).norm(), 20.0, 0.02);
      const uint32_t packed = made.contact.normals[i];
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(static_cast<int8_t>(packed >> (8 * k)) / 127.0, normal[k], 0.04);
      const ContactVector v = made.contact.table.vector(made.contact.direction(i));
      const Vec3 coded = Vec3(v.g[0], v.g[1], v.g[2]) / 127.0;
      // Within three quarters of a voxel of its rim the probe is moved.
      ASSERT_LT((coded - normal).norm(), 0.04);
      const Vec3 arm = Vec3(v.g[3], v.g[4], 0.0) / 127.0 * made.contact.moment_length_mm;
      ASSERT_LT((arm - probe.cross(normal)).norm(), 0.02 * made.contact.moment_length_mm);
      const double radius_mm = std::max(0.1, std::hypot(probe.x(), probe.y()));
      const double area = 16.0 / normal.cwiseAbs().maxCoeff(), edge = area * edge_radius_mm / radius_mm;
      const bool has_edge = radius_mm > 2.0 && radius_mm < 19.0;
      ASSERT_NEAR(v.weight, has_edge ? edge : v.weight, 1.0 + 0.05 * v.weight);
      ASSERT_NEAR(v.area, v.area > 0 ? area : 0.0, 1.0);
    }
  }
  EXPECT_GT(cutting, 10000u);
}

/// Bone beside the rim is not under it.
TEST(ContactShell, CuttingProbesKeepClearOfTheRimOnTheSurface) {
  const Made made("sphere 20,12", 0.2, 0.4);
  size_t at_rim = 0;
  for (const ContactBlock& block : made.contact.blocks) {
    if (block.guiding) continue;
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      const Vec3 probe = made.contact.probe_mm(block, i);
      const double radius_mm = std::hypot(probe.x(), probe.y());
      // What faces sideways on the very edge feels the wall beside it.
      if (made.contact.table.vector(made.contact.direction(i)).g[2] < 20) continue;
      ASSERT_LT(radius_mm, 12.0 - 0.75 * 0.4 + 0.02);
      ASSERT_NEAR((probe - Vec3(0, 0, -20.0)).norm(), 20.0, 0.02);
      at_rim += radius_mm > 12.0 - 0.75 * 0.4 - 0.02;
    }
  }
  EXPECT_GT(at_rim, 100u);
}

TEST(ContactShell, ByDecayCuttingProbesStandOneLengthOff) {
  const shell::PointShell shell = shell::make_point_shell(shell::make_tool("sphere 20"), 0.2);
  const ContactShell contact = make_contact_shell(shell, 0.3, ContactRule::one_voxel_out);
  for (const ContactBlock& block : contact.blocks) {
    if (block.guiding) continue;
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      ASSERT_NEAR((contact.probe_mm(block, i) - Vec3(0, 0, -20.0)).norm(), 20.3, 0.02);
      ASSERT_EQ(contact.normals[i] & 0xffffff, 0u);
    }
  }
}

/// Edge counts where it is: of a flat disc as much in every ring of one width, down to the axis.
TEST(ContactShell, EveryRingOfADiscHasTheSameEdge) {
  const Made made("ellipse 12,0.5", 0.2, 0.3);
  std::array<double, 6> edge_mm{};
  for (const ContactBlock& block : made.contact.blocks) {
    if (block.guiding) continue;
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      const Vec3 probe = made.contact.probe_mm(block, i);
      const double radius_mm = std::hypot(probe.x(), probe.y());
      const ContactVector v = made.contact.table.vector(made.contact.direction(i));
      if (radius_mm < 9.0)
        edge_mm[static_cast<size_t>(radius_mm / 1.5)] +=
            v.weight / 16.0 * made.contact.cell_area_mm2 / edge_radius_mm;
    }
  }
  for (const double edge : edge_mm) EXPECT_NEAR(edge, 2.0 * 3.14159265 * 1.5, 0.05 * 2.0 * 3.14159265 * 1.5);
}

TEST(ContactShell, ProbesOfARoundToolBalance) {
  const Made made("sphere 20", 0.2, 0.3);
  int64_t x = 0, y = 0, weight = 0;
  for (const ContactBlock& block : made.contact.blocks) {
    if (block.guiding) continue;
    x += block.whole[15], y += block.whole[16], weight += block.whole[22];
  }
  EXPECT_LT(std::abs(static_cast<double>(x)), 0.002 * 127.0 * static_cast<double>(weight));
  EXPECT_LT(std::abs(static_cast<double>(y)), 0.002 * 127.0 * static_cast<double>(weight));
}

}  // namespace
}  // namespace ream::collide
