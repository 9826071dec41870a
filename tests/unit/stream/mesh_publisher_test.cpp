#include "stream/mesh_publisher.hpp"

#include "stream/fanout.hpp"
#include "support/seed.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

constexpr int64_t ms = 1'000'000;

/// A ball of bone over several blocks, and the haptic thread's side of the ring.
struct Session {
  voxel::BoneModel bone;
  voxel::BrickRing ring{256};
  voxel::BrickSender sender;
  Fanout fanout;
  uint32_t tick = 0;

  Session() : bone(ball()), sender(bone.grid, ring) {}

  static voxel::BoneModel ball() {
    voxel::VoxelGrid grid;
    grid.dims = {96, 64, 64};
    voxel::BoneModel bone = voxel::make_bone(grid);
    for (size_t i = 0; i < bone.coverage.size(); ++i) {
      const double c = 127.5 + 255 * (27.0 - (grid.centre_mm(grid.coordinates(i)) - Vec3(40, 32, 32)).norm());
      bone.coverage[i] = static_cast<uint8_t>(std::clamp(c, 0.0, 255.0));
    }
    return bone;
  }

  void set(const Vec3i& voxel, uint8_t coverage) {
    bone.coverage[bone.grid.index(voxel)] = coverage;
    sender.mark(bone.grid.brick_index(voxel / voxel::brick_edge));
  }
  void drain(MeshPublisher& publisher, int64_t now) {
    voxel::BrickImage image;
    while (ring.try_pop(image)) publisher.take(image, now);
  }
  size_t poll(MeshPublisher& publisher, int64_t now) {
    drain(publisher, now);
    return publisher.poll(now);
  }
  size_t flush(MeshPublisher& publisher, int64_t now) {
    drain(publisher, now);
    return publisher.flush(now);
  }
  void end_tick(int budget = 100) { sender.send(bone.coverage.data(), ++tick, budget); }
};

/// What a viewer should hold, extracted from scratch.
std::map<uint32_t, Surface> expected(const voxel::VoxelGrid& grid, const std::vector<uint8_t>& coverage,
                                     int stride = 1) {
  surface::BlockExtractor extractor(grid, stride);
  std::map<uint32_t, Surface> result;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const surface::BlockMesh mesh = extractor.extract(coverage.data(), block);
    if (!mesh.indices.empty()) result[block] = surface_of(mesh.vertices, mesh.indices);
  }
  return result;
}

std::map<uint32_t, Surface> held(const Viewer& viewer) {
  std::map<uint32_t, Surface> result;
  for (const auto& [block, h] : viewer.blocks) result[block] = h.surface;
  return result;
}

TEST(MeshPublisher, FirstPictureIsTheWholeSurface) {
  Session s;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  const auto mailbox = s.fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.key_completes, 1);
  EXPECT_TRUE(held(viewer) == expected(s.bone.grid, s.bone.coverage));
}

TEST(MeshPublisher, RandomRemovalEndsWithTheSurfaceOfTheBone) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  Session s;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  const auto mailbox = s.fanout.subscribe({}, 1);
  Viewer viewer;
  int64_t now = 0;
  for (int step = 0; step < 400; ++step, now += ms) {
    for (int i = 0; i < 20; ++i) {
      const Vec3i voxel(static_cast<int>(random() % 96), static_cast<int>(random() % 64),
                        static_cast<int>(random() % 64));
      const uint8_t left = s.bone.coverage[s.bone.grid.index(voxel)];
      if (left > 0) s.set(voxel, static_cast<uint8_t>(random() % left));
    }
    s.end_tick(15);
    if (random() % 10 == 0) s.poll(publisher, now);
    if (random() % 50 == 0) viewer.pull(*mailbox, 1);
  }
  while (s.sender.pending() > 0) {
    s.end_tick();
    s.poll(publisher, now);
  }
  s.flush(publisher, now);
  viewer.pull(*mailbox);
  EXPECT_TRUE(held(viewer) == expected(s.bone.grid, s.bone.coverage)) << "seed " << seed;
  EXPECT_TRUE(publisher.replica().coverage() == s.bone.coverage);
}

TEST(MeshPublisher, ViewersAlwaysHoldTheSurfaceOfOneCoverage) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  Session s;
  MeshPublisherOptions options;
  options.max_surfaces = 2;  // so that updates take several polls while removal goes on
  MeshPublisher publisher(s.bone, s.fanout, options);
  publisher.publish_all();
  const auto mailbox = s.fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  std::map<uint32_t, Surface> shown = held(viewer);
  int64_t now = 0;
  int pictures = 0, polls_between = 0;
  for (int step = 0; step < 300; ++step, now += 31 * ms) {
    for (int i = 0; i < 5; ++i) {
      const Vec3i voxel(static_cast<int>(random() % 96), static_cast<int>(random() % 64),
                        static_cast<int>(random() % 64));
      const uint8_t left = s.bone.coverage[s.bone.grid.index(voxel)];
      if (left > 0) s.set(voxel, static_cast<uint8_t>(random() % left));
    }
    s.end_tick();
    const size_t published = s.poll(publisher, now);
    viewer.pull(*mailbox);
    if (published > 0) {
      // The update is complete: the replica is the coverage that it showed.
      shown = expected(s.bone.grid, publisher.replica().coverage());
      ++pictures;
    } else {
      ++polls_between;
    }
    ASSERT_TRUE(held(viewer) == shown) << "seed " << seed << ", step " << step;
  }
  EXPECT_GT(pictures, 10);
  EXPECT_GT(polls_between, pictures);
}

TEST(MeshPublisher, BoneMayGrowBack) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  const Session s;
  Fanout fanout;
  MeshPublisher publisher(s.bone, fanout);
  publisher.publish_all();
  const auto mailbox = fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  std::vector<uint8_t> coverage = s.bone.coverage;
  for (int step = 0; step < 60; ++step) {
    for (int i = 0; i < 5; ++i) {
      voxel::BrickImage image;
      image.brick = static_cast<uint32_t>(random() % s.bone.grid.brick_count());
      image.tick = static_cast<uint32_t>(random() % 1000);
      for (uint8_t& level : image.coverage) level = static_cast<uint8_t>(random() % 2 * 255);
      if (step >= 40) voxel::read_brick(s.bone.grid, s.bone.coverage.data(), image.brick, image.coverage);
      voxel::write_brick(s.bone.grid, coverage.data(), image.brick, image.coverage);
      publisher.take(image, step * ms);
    }
    publisher.flush(step * ms);
    viewer.pull(*mailbox);
    ASSERT_TRUE(held(viewer) == expected(s.bone.grid, coverage)) << "seed " << seed << ", step " << step;
  }
}

TEST(MeshPublisher, LargeChangesShowAtOnceSmallOnesLater) {
  Session s;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  const Vec3i at_surface(66, 32, 32);
  const uint8_t left = s.bone.coverage[s.bone.grid.index(at_surface)];
  ASSERT_GT(left, 70);
  int64_t now = 1000 * ms;
  s.set(at_surface, static_cast<uint8_t>(left - 5));
  s.end_tick();
  EXPECT_EQ(s.poll(publisher, now), 0u);
  EXPECT_EQ(s.poll(publisher, now + 249 * ms), 0u);
  now += 250 * ms;
  EXPECT_GT(s.poll(publisher, now), 0u);
  s.set(at_surface, static_cast<uint8_t>(left - 5 - 64));
  s.end_tick();
  EXPECT_EQ(s.poll(publisher, now + 29 * ms), 0u) << "min_interval_ns";
  EXPECT_GT(s.poll(publisher, now + 30 * ms), 0u);
}

TEST(MeshPublisher, CoarseViewersGetTheirOwnPictureFromTheirArrivalOn) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  Session s;
  MeshPublisherOptions options;
  options.max_surfaces = 2;
  MeshPublisher publisher(s.bone, s.fanout, options);
  publisher.publish_all();
  std::map<int, std::shared_ptr<Mailbox>> mailboxes;
  std::map<int, Viewer> viewers;
  int64_t now = 0;
  for (int step = 0; step < 200; ++step, now += 31 * ms) {
    if (step == 20) mailboxes[4] = s.fanout.subscribe({}, 4);
    if (step == 40) mailboxes[1] = s.fanout.subscribe({}, 1);
    if (step == 60) mailboxes[2] = s.fanout.subscribe({}, 2);
    const Vec3i voxel(static_cast<int>(random() % 96), static_cast<int>(random() % 64),
                      static_cast<int>(random() % 64));
    s.set(voxel, 0);
    s.end_tick();
    const bool shown = s.poll(publisher, now) > 0;
    for (auto& [stride, mailbox] : mailboxes) {
      viewers[stride].pull(*mailbox);
      if (shown && viewers[stride].key_completes == 1) {
        ASSERT_TRUE(held(viewers[stride]) == expected(s.bone.grid, publisher.replica().coverage(), stride))
            << "seed " << seed << ", step " << step << ", stride " << stride;
      }
    }
  }
  s.flush(publisher, now);
  for (auto& [stride, mailbox] : mailboxes) {
    viewers[stride].pull(*mailbox);
    EXPECT_EQ(viewers[stride].key_completes, 1) << stride;
    EXPECT_TRUE(held(viewers[stride]) == expected(s.bone.grid, s.bone.coverage, stride)) << stride;
  }
}

TEST(MeshPublisher, BlocksWhoseSurfaceStaysAreNotSent) {
  Session s;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  s.set({40, 32, 32}, 200);  // deep inside, in a corner of eight blocks
  s.end_tick();
  EXPECT_EQ(s.flush(publisher, 0), 0u);
  EXPECT_EQ(publisher.replica().coverage(), s.bone.coverage);
}

TEST(MeshPublisher, CreepAddsUpAndUnchangedBricksAreNotSent) {
  Session s;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  const auto mailbox = s.fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  const Vec3i at_surface(66, 32, 32);
  int64_t now = 1000 * ms;
  uint8_t left = s.bone.coverage[s.bone.grid.index(at_surface)];
  size_t published = 0;
  int polls = 0;
  for (; published == 0 && polls < 100; ++polls, now += ms) {
    s.set(at_surface, --left);
    s.end_tick();
    published = s.poll(publisher, now);
  }
  EXPECT_EQ(polls, MeshPublisherOptions{}.noticeable_coverage);
  s.sender.mark(0);
  s.end_tick();
  EXPECT_EQ(s.flush(publisher, now), 0u);
  viewer.pull(*mailbox);
  EXPECT_TRUE(held(viewer) == expected(s.bone.grid, s.bone.coverage));
}

TEST(MeshPublisher, ABlockThatLosesItsLastSurfaceIsToldEmptyOnce) {
  Session s;
  std::fill(s.bone.coverage.begin(), s.bone.coverage.end(), uint8_t{0});
  const Vec3i lonely(80, 48, 48);
  s.bone.coverage[s.bone.grid.index(lonely)] = 255;
  MeshPublisher publisher(s.bone, s.fanout);
  publisher.publish_all();
  const auto mailbox = s.fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.blocks.size(), 1u);
  s.set(lonely, 0);
  s.end_tick();
  EXPECT_EQ(s.flush(publisher, 0), 1u);
  viewer.pull(*mailbox);
  EXPECT_TRUE(viewer.blocks.empty());
  s.sender.mark(0);
  s.end_tick();
  EXPECT_EQ(s.flush(publisher, 1), 0u);
}

}  // namespace
}  // namespace ream::stream
