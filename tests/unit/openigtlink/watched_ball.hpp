#pragma once
#include <algorithm>

#include "core/clock.hpp"
#include "openigtlink/active_session.hpp"
#include "stream/fanout.hpp"
#include "stream/mesh_publisher.hpp"
#include "support/igtl_reading.hpp"
#include "surface/block_mesh.hpp"

namespace ream::openigtlink {

/// A ball of bone over several blocks, askew in the world, published as a session does.
class WatchedBall {
 public:
  explicit WatchedBall(std::string id = "s1") : bone_(ball()), publisher_(bone_, *fanout_) {
    publisher_.publish_all();
    session_ =
        std::make_shared<SessionView>(SessionView{std::move(id), "a ball", bone_.grid, tool(), fanout_});
  }

  std::shared_ptr<const SessionView> session() const { return session_; }
  stream::Fanout& fanout() { return *fanout_; }
  const voxel::BoneModel& bone() const { return bone_; }

  /// Bricks that hold bone, whether or not it has been cut.
  static constexpr int bricks = 4 * 3 * 3;
  /// Takes one of them away and shows that.
  void cut(int which) {
    voxel::BrickImage image{};
    image.brick = bone_.grid.brick_index(Vec3i(4 + which % 4, 3 + which / 4 % 3, 3 + which / 12));
    image.tick = ++tick_;
    voxel::write_brick(bone_.grid, bone_.coverage.data(), image.brick, image.coverage);
    publisher_.take(image, steady_ns());
    publisher_.flush(steady_ns());
  }

  void cut_everything() {
    for (uint32_t brick = 0; brick < bone_.grid.voxel_count() / voxel::brick_voxels; ++brick) {
      voxel::BrickImage image{};
      image.brick = brick;
      voxel::write_brick(bone_.grid, bone_.coverage.data(), brick, image.coverage);
      publisher_.take(image, steady_ns());
    }
    publisher_.flush(steady_ns());
  }

  /// Tells of a tick in which the tool stands at x.
  void tell(double x_mm, SessionState state = SessionState::running) {
    stream::TelemetrySample sample;
    sample.tick = ++tick_;
    sample.thrust_n = 52.0f;
    sample.hand_force_n = 2.0f;
    sample.torque_n_mm = 250.0f;
    sample.world_from_tool.translation_mm = {x_mm, 2.0, 3.0};
    sample.state = state;
    stream::TelemetryBatch batch;
    batch.stamp_us = steady_ns() / 1000;
    batch.samples.push_back(sample);
    fanout_->publish_telemetry(std::make_shared<const stream::TelemetryBatch>(std::move(batch)));
  }

  /// Its surface as it is now, in RAS, made without any of the blocks.
  TriangleMesh surface() const {
    TriangleMesh whole =
        surface::whole_surface(bone_.grid, bone_.coverage.data()).transformed(bone_.grid.world_from_grid);
    for (std::vector<Vec3f>* vectors : {&whole.vertices_mm, &whole.normals})
      for (Vec3f& v : *vectors) v = Vec3f(-v.x(), -v.y(), v.z());
    return whole;
  }

 private:
  static voxel::BoneModel ball() {
    voxel::VoxelGrid grid;
    grid.dims = {96, 64, 64};
    grid.spacing_mm = {0.5, 0.6, 0.7};
    grid.world_from_grid = {rotation_from_small_vector({0.1, 0.2, 0.3}), {-40.0, 30.0, 20.0}};
    voxel::BoneModel bone = voxel::make_bone(grid);
    const Vec3 middle = grid.bounds_mm().centre();
    for (size_t i = 0; i < bone.coverage.size(); ++i) {
      const double inside_mm = 14.0 - (grid.centre_mm(grid.coordinates(i)) - middle).norm();
      bone.coverage[i] = static_cast<uint8_t>(std::clamp(127.5 + 255.0 * inside_mm, 0.0, 255.0));
    }
    return bone;
  }
  static TriangleMesh tool() {
    TriangleMesh mesh;
    mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
  }

  voxel::BoneModel bone_;
  std::shared_ptr<stream::Fanout> fanout_ = std::make_shared<stream::Fanout>();
  stream::MeshPublisher publisher_;
  std::shared_ptr<const SessionView> session_;
  uint32_t tick_ = 0;
};

using Corners = std::array<std::array<float, 6>, 3>;

/// Triangles by the places and normals of their corners, however they are numbered.
template <typename Points, typename Normals, typename Triangles>
std::vector<Corners> corners_of(const Points& points, const Normals& normals, const Triangles& triangles) {
  std::vector<Corners> all;
  for (const auto& triangle : triangles) {
    Corners corners;
    for (size_t k = 0; k < 3; ++k)
      for (size_t axis = 0; axis < 3; ++axis) {
        corners[k][axis] = points.at(triangle[k])[static_cast<Eigen::Index>(axis)];
        corners[k][3 + axis] = normals.at(triangle[k])[static_cast<Eigen::Index>(axis)];
      }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

inline std::vector<Corners> corners_of(const TriangleMesh& mesh) {
  return corners_of(mesh.vertices_mm, mesh.normals, mesh.triangles);
}
inline std::vector<Corners> corners_of(const test::IgtlReading& reading) {
  return corners_of(reading.points, reading.normals, reading.triangles);
}

}  // namespace ream::openigtlink
