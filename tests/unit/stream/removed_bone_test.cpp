#include "stream/removed_bone.hpp"

#include <cmath>
#include <random>

#include "stream/mesh_publisher.hpp"
#include "support/seed.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

/// Full bone below a height in voxels that may differ between the halves of x; one voxel of ramp.
voxel::BoneModel slab(double left_height, double right_height) {
  voxel::VoxelGrid grid;
  grid.dims = {64, 32, 32};
  grid.spacing_mm = {0.5, 0.4, 0.3};
  voxel::BoneModel bone = voxel::make_bone(grid);
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u) {
        const double above = w + 0.5 - (u < 32 ? left_height : right_height);
        bone.coverage[grid.index(u, v, w)] =
            static_cast<uint8_t>(std::lround(255.0 * std::clamp(0.5 - above, 0.0, 1.0)));
      }
  return bone;
}

/// What is known of `now` when it was `before`.
struct Followed {
  Followed(const voxel::BoneModel& before, const voxel::BoneModel& now) : replica(now), removed(replica) {
    for (uint32_t brick = 0; brick < before.grid.brick_count(); ++brick) {
      const uint8_t* image = before.coverage.data() + size_t{brick} * voxel::brick_voxels;
      if (!std::equal(image, image + voxel::brick_voxels, replica.brick(brick))) removed.keep(brick, image);
    }
  }
  voxel::Replica replica;
  RemovedBone removed;
};

/// In voxels of the grid.
Vec3 place_of(const surface::BlockVertex& vertex, int block_x) {
  return Vec3(vertex.x, vertex.y, vertex.z) / 1024.0 + Vec3(32.0 * block_x - 1.0, -1.0, -1.0);
}

/// Coverage between voxel centres.
double trilinear(const voxel::BoneModel& bone, const Vec3& voxels) {
  double sum = 0.0;
  for (int w = 0; w < bone.grid.dims.z(); ++w) {
    const double in_w = 1.0 - std::abs(w + 0.5 - voxels.z());
    if (in_w <= 0.0) continue;
    for (int v = 0; v < bone.grid.dims.y(); ++v) {
      const double in_v = 1.0 - std::abs(v + 0.5 - voxels.y());
      if (in_v <= 0.0) continue;
      for (int u = 0; u < bone.grid.dims.x(); ++u) {
        const double in_u = 1.0 - std::abs(u + 0.5 - voxels.x());
        if (in_u > 0.0) sum += in_u * in_v * in_w * bone.coverage[bone.grid.index(u, v, w)];
      }
    }
  }
  return sum;
}

TEST(RemovedBone, IsNoneWhereTheBoneIsAsItWasAndMostWhereAVoxelIsGone) {
  const voxel::BoneModel before = slab(20.3, 20.3), now = slab(20.3, 18.9);
  for (const int stride : {1, 2, 4}) {
    const Followed followed(before, now);
    size_t cut = 0, intact = 0;
    for (const uint32_t block : {0u, 1u}) {
      const surface::BlockMesh mesh =
          surface::BlockExtractor(now.grid, stride).extract(now.coverage.data(), block);
      const std::vector<uint8_t> levels = followed.removed.levels(mesh.vertices, block);
      ASSERT_EQ(levels.size(), block == 0 && levels.empty() ? 0 : mesh.vertices.size());
      for (size_t i = 0; i < levels.size(); ++i) {
        const Vec3 at = place_of(mesh.vertices[i], static_cast<int>(block));
        const bool inside = at.x() > 1 && at.x() < 63 && at.y() > 1 && at.y() < 31;
        if (!inside || std::abs(at.z() - 19.6) > 1.5) continue;
        if (at.x() < 32.0 - stride) {
          EXPECT_EQ(levels[i], 0) << at.transpose();
          ++intact;
        }
        if (at.x() > 32.0 + stride) {
          EXPECT_GE(levels[i], stride == 1 ? 15 : 8) << at.transpose() << ", stride " << stride;
          ++cut;
        }
      }
    }
    EXPECT_GT(cut, 20u);
    EXPECT_GT(intact, 20u);
  }
}

TEST(RemovedBone, IsTheDepthUnderTheFirstSurfaceAndNoMoreThanIsGone) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  const voxel::BoneModel before = slab(20.3, 20.3);
  voxel::BoneModel now = before;
  for (int i = 0; i < 4000; ++i) {
    uint8_t& left =
        now.coverage[now.grid.index(static_cast<int>(random() % 64), static_cast<int>(random() % 32),
                                    static_cast<int>(17 + random() % 4))];
    left = static_cast<uint8_t>(random() % (left + 1u));
  }
  const Followed followed(before, now);
  std::vector<surface::BlockVertex> vertices;
  vertices.reserve(3000);
  for (int i = 0; i < 3000; ++i)
    vertices.push_back({static_cast<uint16_t>(random() % 33792), static_cast<uint16_t>(random() % 33792),
                        static_cast<uint16_t>(17408 + random() % 6144), 0, 127});
  const std::vector<uint8_t> levels = followed.removed.levels(vertices, 1);
  ASSERT_EQ(levels.size(), vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 at = place_of(vertices[i], 1);
    const double was = trilinear(before, at), lost = std::min(was - trilinear(now, at), was - 127.5) / 127.0;
    EXPECT_EQ(levels[i], static_cast<int>(std::clamp(std::floor(15.0 * lost + 1e-9), 0.0, 15.0)))
        << at.transpose() << ", seed " << seed;
  }
}

/// What is gone goes with its vertex when the codec puts them in another order.
TEST(RemovedBone, FollowsTheVerticesThroughTheCodec) {
  const voxel::BoneModel now = slab(20.3, 18.9);
  const Followed followed(slab(20.3, 20.3), now);
  const surface::BlockMesh mesh = surface::BlockExtractor(now.grid).extract(now.coverage.data(), 1);
  const std::vector<uint8_t> levels = followed.removed.levels(mesh.vertices, 1);
  const EncodedBlock block = encode(mesh, 1, 1, 1, nullptr, levels);
  const surface::BlockMesh sent = decode(block);
  ASSERT_EQ(block.removed.size(), (sent.vertices.size() + 1) / 2);
  EXPECT_EQ(block.removed, RemovedBone::packed(followed.removed.levels(sent.vertices, 1)));
  EXPECT_NE(sent.vertices, mesh.vertices);
  EXPECT_EQ(RemovedBone::packed(std::vector<uint8_t>{1, 2, 3}), (std::vector<uint8_t>{0x21, 0x03}));
}

/// Blocks that the mailbox holds, by whether they tell of anything that is gone.
struct Told {
  size_t with = 0, without = 0;
};

Told told(Mailbox& mailbox) {
  Told result;
  while (const Message message = mailbox.next()) {
    const wire::MeshDelta* delta = wire::GetServerMessage(message->data())->body_as_MeshDelta();
    if (delta == nullptr) continue;
    for (const wire::MeshBlock* block : *delta->blocks()) {
      const bool any = block->removed() != nullptr;
      if (any) {
        EXPECT_EQ(block->removed()->size(), (block->vertex_count() + 1) / 2);
      }
      ++(any ? result.with : result.without);
    }
  }
  return result;
}

void take_all(MeshPublisher& publisher, const voxel::BoneModel& bone, uint32_t tick) {
  for (uint32_t brick = 0; brick < bone.grid.brick_count(); ++brick) {
    voxel::BrickImage image{brick, tick, {}};
    voxel::read_brick(bone.grid, bone.coverage.data(), brick, image.coverage);
    publisher.take(image, 0);
  }
  publisher.flush(0);
}

TEST(RemovedBone, ReachesViewersAndGoesWhenTheBoneIsPutBack) {
  const voxel::BoneModel before = slab(20.3, 20.3), now = slab(20.3, 18.9);
  Fanout fanout;
  MeshPublisher publisher(before, fanout);
  publisher.publish_all();
  const auto mailbox = fanout.subscribe({}, 1);
  EXPECT_EQ(told(*mailbox).with, 0u);
  take_all(publisher, now, 1);
  EXPECT_GT(told(*mailbox).with, 0u);
  take_all(publisher, before, 2);
  const Told back = told(*mailbox);
  EXPECT_EQ(back.with, 0u);
  EXPECT_GT(back.without, 0u);
}

TEST(RemovedBone, OfASessionThatGoesOnIsToldFromTheFirstPictureOn) {
  const voxel::BoneModel before = slab(20.3, 20.3), now = slab(20.3, 18.9);
  Fanout fanout;
  MeshPublisher publisher(now, fanout, {}, &before.coverage);
  publisher.publish_all();
  EXPECT_GT(told(*fanout.subscribe({}, 1)).with, 0u);
}

}  // namespace
}  // namespace ream::stream
