#include "stream/codec.hpp"

#include "support/seed.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

surface::BlockMesh noise_block(unsigned seed) {
  std::mt19937 random(seed);
  voxel::VoxelGrid grid;
  grid.dims = {64, 32, 32};
  std::vector<uint8_t> coverage(grid.voxel_count());
  for (uint8_t& c : coverage) c = static_cast<uint8_t>(random() % 256);
  return surface::BlockExtractor(grid).extract(coverage.data(), 1);
}

TEST(Codec, DecodesToTheSameSurface) {
  const surface::BlockMesh mesh = noise_block(test::seed());
  const EncodedBlock encoded = encode(mesh, 7, 42);
  EXPECT_EQ(encoded.block, 1u);
  EXPECT_EQ(encoded.revision, 7u);
  EXPECT_EQ(encoded.tick, 42u);
  EXPECT_EQ(encoded.vertex_count, mesh.vertices.size());
  EXPECT_EQ(encoded.index_count, mesh.indices.size());
  EXPECT_TRUE(decoded(encoded) == surface_of(mesh.vertices, mesh.indices));
}

TEST(Codec, WritesTheFormatsThatWereAgreed) {
  const SharedBlock block = small_block(3, 1);
  EXPECT_EQ(static_cast<uint8_t>(block->vertices.at(0)), 0xa0);  // vertex codec, version 0
  EXPECT_EQ(static_cast<uint8_t>(block->indices.at(0)), 0xe1);   // index codec, version 1
}

TEST(Codec, NoTrianglesGiveAnEmptyBlock) {
  const EncodedBlock encoded = encode(surface::BlockMesh{9, {}, {}}, 2, 3);
  EXPECT_TRUE(encoded.empty());
  EXPECT_EQ(encoded.bytes(), 0u);
  EXPECT_EQ(encoded.vertex_count, 0u);
}

TEST(Codec, EveryTruncationIsRefused) {
  const EncodedBlock full = encode(noise_block(5), 1, 1);
  const SharedBlock block = small_block(3, 1);
  for (size_t cut = 1; cut <= block->vertices.size(); ++cut) {
    EncodedBlock shorter = *block;
    shorter.vertices.resize(shorter.vertices.size() - cut);
    EXPECT_THROW(decoded(shorter), std::runtime_error);
  }
  for (size_t cut = 1; cut <= full.indices.size(); cut += 997) {
    EncodedBlock shorter = full;
    shorter.indices.resize(shorter.indices.size() - cut);
    EXPECT_THROW(decoded(shorter), std::runtime_error);
  }
}

}  // namespace
}  // namespace ream::stream
