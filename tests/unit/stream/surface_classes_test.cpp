#include "stream/codec.hpp"

#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

using voxel::BoneClass;

/// Whole bone from z = 8 to z = 24: cancellous, but cortical where x is 32 and more, and cartilage in the
/// uppermost two voxels there.
voxel::BoneModel half_cortical() {
  voxel::VoxelGrid grid;
  grid.dims = {64, 32, 32};
  grid.spacing_mm = {0.5, 0.4, 0.3};
  voxel::BoneModel bone = voxel::make_bone(grid);
  std::vector<uint8_t>& density = bone.density.writable();
  for (int w = 8; w < 24; ++w)
    for (int v = 0; v < 32; ++v)
      for (int u = 0; u < 64; ++u) {
        bone.coverage[grid.index(u, v, w)] = 255;
        density[grid.index(u, v, w)] = u < 32    ? voxel::density_code(0.4)
                                       : w >= 22 ? voxel::cartilage_code
                                                 : voxel::density_code(1.8);
      }
  return bone;
}

unsigned class_at(const std::vector<uint8_t>& packed, size_t vertex) {
  return packed.at(vertex / 4) >> (2 * (vertex % 4)) & 3u;
}

TEST(SurfaceClasses, TellWhatLiesUnderTheSurface) {
  const voxel::BoneModel bone = half_cortical();
  const SurfaceClasses classes(bone);
  for (const uint32_t block : {0u, 1u}) {
    const surface::BlockMesh mesh = surface::BlockExtractor(bone.grid).extract(bone.coverage.data(), block);
    ASSERT_FALSE(mesh.vertices.empty());
    const std::vector<uint8_t> packed = classes.packed_classes(classes.codes(mesh.vertices, block, 1));
    ASSERT_EQ(packed.size(), (mesh.vertices.size() + 3) / 4);
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vec3f at =
          surface::position_mm(mesh.vertices[i], Vec3i(static_cast<int>(block), 0, 0), bone.grid.spacing_mm);
      if (std::abs(at.x() - 16.0f) < 0.6f) continue;  // beside the border either is right
      const bool top = at.z() > 22 * 0.3f;
      const BoneClass expected = at.x() < 16.0f ? BoneClass::cancellous
                                 : top          ? BoneClass::cartilage
                                                : BoneClass::cortical;
      // The walls at the grid's sides pass all layers; only faces above and below are of one kind.
      if (std::abs(at.z() - 24 * 0.3f) > 0.05f && std::abs(at.z() - 8 * 0.3f) > 0.05f) continue;
      EXPECT_EQ(class_at(packed, i), static_cast<unsigned>(expected)) << at.transpose();
    }
  }
}

TEST(SurfaceClasses, FollowTheVerticesThroughTheCodec) {
  const voxel::BoneModel bone = half_cortical();
  const SurfaceClasses classes(bone);
  for (const int stride : {1, 2, 4}) {
    const surface::BlockMesh mesh =
        surface::BlockExtractor(bone.grid, stride).extract(bone.coverage.data(), 1);
    const EncodedBlock encoded = encode(mesh, 1, 1, stride, &classes);
    std::vector<surface::BlockVertex> vertices(encoded.vertex_count);
    ASSERT_EQ(meshopt_decodeVertexBuffer(vertices.data(), vertices.size(), 8,
                                         reinterpret_cast<const unsigned char*>(encoded.vertices.data()),
                                         encoded.vertices.size()),
              0);
    const std::vector<uint8_t> codes = classes.codes(vertices, 1, stride);
    EXPECT_EQ(encoded.classes, classes.packed_classes(codes));
    for (size_t i = 0; i < vertices.size(); ++i)
      EXPECT_EQ(class_at(encoded.classes, i), static_cast<unsigned>(classes.class_of(codes[i])));
  }
}

TEST(SurfaceClasses, TellDensityWhereBoneIsGone) {
  voxel::BoneModel bone = half_cortical();
  // A cyst, and enamel-like bone: both ends of what is told.
  for (int v = 0; v < 32; ++v)
    for (int w = 8; w < 24; ++w)
      for (int u = 0; u < 16; ++u)
        bone.density.writable()[bone.grid.index(u, v, w)] = voxel::density_code(u < 8 ? 0.02 : 2.4);
  const SurfaceClasses classes(bone);
  std::array<size_t, 16> counts{};
  for (const int stride : {1, 2, 4})
    for (const uint32_t number : {0u, 1u}) {
      const surface::BlockMesh mesh =
          surface::BlockExtractor(bone.grid, stride).extract(bone.coverage.data(), number);
      const std::vector<uint8_t> gone(mesh.vertices.size(), 15);
      const EncodedBlock encoded = encode(mesh, 1, 1, stride, &classes, gone);
      const std::vector<surface::BlockVertex> vertices = decode(encoded).vertices;
      ASSERT_EQ(encoded.densities.size(), (vertices.size() + 1) / 2);
      const std::vector<uint8_t> codes = classes.codes(vertices, number, stride);
      for (size_t i = 0; i < vertices.size(); ++i) {
        const unsigned level = encoded.densities[i / 2] >> (4 * (i % 2)) & 15u;
        ++counts[level];
        // Steps of 0.125 g/cc: 0.4 is nearest to 3, 1.8 to 14, 2.4 more than can be told, 0.02 the least.
        const std::map<int, unsigned> expected = {{2, 1}, {40, 3}, {180, 14}, {240, 15}, {255, 0}};
        EXPECT_EQ(level, expected.at(codes[i]));
      }
    }
  for (const size_t level : {0, 1, 3, 14, 15}) EXPECT_GT(counts[level], 0u) << level;
}

TEST(SurfaceClasses, DensityReachesViewers) {
  const voxel::BoneModel bone = half_cortical();
  const SurfaceClasses classes(bone);
  const surface::BlockMesh mesh = surface::BlockExtractor(bone.grid).extract(bone.coverage.data(), 1);
  const std::vector<uint8_t> gone(mesh.vertices.size(), 15);
  const auto block = std::make_shared<const EncodedBlock>(encode(mesh, 1, 1, 1, &classes, gone));
  const Message message = mesh_message(std::vector<SharedBlock>{block}, true);
  ASSERT_TRUE(verified(message->data(), message->size()));
  const auto* sent =
      wire::GetServerMessage(message->data())->body_as_MeshDelta()->blocks()->Get(0)->densities();
  ASSERT_NE(sent, nullptr);
  EXPECT_EQ(std::vector<uint8_t>(sent->begin(), sent->end()), block->densities);
}

TEST(SurfaceClasses, DensityIsLeftOutWhereNothingIsGoneOrKindsAreHidden) {
  const voxel::BoneModel bone = half_cortical();
  const SurfaceClasses classes(bone);
  const surface::BlockMesh mesh = surface::BlockExtractor(bone.grid).extract(bone.coverage.data(), 1);
  const std::vector<uint8_t> gone(mesh.vertices.size(), 15);
  EXPECT_TRUE(encode(mesh, 1, 1, 1, &classes).densities.empty());
  const EncodedBlock hidden = encode(mesh, 1, 1, 1, nullptr, gone);
  EXPECT_FALSE(hidden.removed.empty());
  EXPECT_TRUE(hidden.densities.empty()) << "plates of a study of feel must not say what they are made of";
  voxel::BoneModel without = bone;
  without.density = {};
  const SurfaceClasses none(without);
  EXPECT_TRUE(encode(mesh, 1, 1, 1, &none, gone).densities.empty());
}

TEST(SurfaceClasses, AreLeftOutWhereNobodyKnowsTheBone) {
  const voxel::BoneModel bone = half_cortical();
  const surface::BlockMesh mesh = surface::BlockExtractor(bone.grid).extract(bone.coverage.data(), 0);
  EXPECT_TRUE(encode(mesh, 1, 1).classes.empty());
  voxel::BoneModel without = bone;
  without.density = {};
  const SurfaceClasses none(without);
  EXPECT_TRUE(encode(mesh, 1, 1, 1, &none).classes.empty());
  EXPECT_TRUE(encode(surface::BlockMesh{9, {}, {}}, 2, 3).classes.empty());
}

TEST(SurfaceClasses, ReachViewersAndKeepWithTheBone) {
  const voxel::BoneModel bone = half_cortical();
  const SurfaceClasses classes(bone);
  const surface::BlockMesh mesh = surface::BlockExtractor(bone.grid).extract(bone.coverage.data(), 1);
  const auto block = std::make_shared<const EncodedBlock>(encode(mesh, 1, 1, 1, &classes));
  const Message message = mesh_message(std::vector<SharedBlock>{block}, true);
  ASSERT_TRUE(verified(message->data(), message->size()));
  const wire::MeshBlock* sent =
      wire::GetServerMessage(message->data())->body_as_MeshDelta()->blocks()->Get(0);
  ASSERT_NE(sent->classes(), nullptr);
  EXPECT_EQ(std::vector<uint8_t>(sent->classes()->begin(), sent->classes()->end()), block->classes);
}

}  // namespace
}  // namespace ream::stream
