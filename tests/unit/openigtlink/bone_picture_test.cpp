#include "openigtlink/bone_picture.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/error.hpp"
#include "unit/openigtlink/watched_ball.hpp"

namespace ream::openigtlink {
namespace {

void take_all(stream::Mailbox& mailbox, BonePicture& picture) {
  for (stream::SharedBlock& block : mailbox.take().blocks) picture.take(std::move(block));
}

/// Every edge has its opposite: nothing is open, and nothing is there twice.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return back != edges.end() && back->second == edge.second;
  });
}

TEST(BonePicture, IsTheWholeSurfaceInRasBeforeAndAfterCuts) {
  WatchedBall ball;
  const auto mailbox = ball.fanout().subscribe([] {}, 1);
  BonePicture picture(ball.bone().grid);
  take_all(*mailbox, picture);
  const TriangleMesh whole = picture.in_ras();
  EXPECT_TRUE(corners_of(whole) == corners_of(ball.surface()));
  EXPECT_EQ(whole.vertices_mm.size(), ball.surface().vertices_mm.size()) << "vertices of borders are one";
  EXPECT_TRUE(is_closed(whole));
  EXPECT_GT(whole.volume_mm3(), 10'000.0) << "outside is outside";
  for (const int brick : {0, 1, 7, 20}) ball.cut(brick);
  take_all(*mailbox, picture);
  EXPECT_TRUE(corners_of(picture.in_ras()) == corners_of(ball.surface()));
  EXPECT_TRUE(is_closed(picture.in_ras()));
  EXPECT_LT(picture.in_ras().volume_mm3(), whole.volume_mm3());
}

TEST(BonePicture, BoneThatIsGoneLeavesNothing) {
  WatchedBall ball;
  const auto mailbox = ball.fanout().subscribe([] {}, 1);
  BonePicture picture(ball.bone().grid);
  take_all(*mailbox, picture);
  ball.cut_everything();
  take_all(*mailbox, picture);
  EXPECT_TRUE(picture.in_ras().triangles.empty());
}

TEST(BonePicture, ADamagedBlockIsRefused) {
  WatchedBall ball;
  const auto mailbox = ball.fanout().subscribe([] {}, 1);
  stream::EncodedBlock damaged = *mailbox->take().blocks.at(0);
  damaged.indices.resize(damaged.indices.size() / 2);
  BonePicture picture(ball.bone().grid);
  picture.take(std::make_shared<const stream::EncodedBlock>(damaged));
  EXPECT_THROW(picture.in_ras(), Error);
}

}  // namespace
}  // namespace ream::openigtlink
