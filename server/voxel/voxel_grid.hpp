#pragma once
#include <cstddef>

#include "geometry/box.hpp"
#include "geometry/pose.hpp"

namespace ream::voxel {

/// Edge of a brick, the unit of change and of storage, in voxels; grid dimensions are whole bricks.
inline constexpr int brick_edge = 8;
inline constexpr int brick_voxels = brick_edge * brick_edge * brick_edge;

/// Uniform grid of thesis section 2.2: voxel (u,v,w) fills the box from p = (u,v,w)*spacing to p + spacing in
/// the grid frame, whose origin is the minimum corner. `dims` are multiples of brick_edge.
struct VoxelGrid {
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones();
  /// World is the CT's LPS frame. State, never a constant: the scapula may move.
  Pose world_from_grid;

  size_t voxel_count() const {
    return static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y()) * static_cast<size_t>(dims.z());
  }
  /// Place of a voxel in memory: brick after brick, x fastest among bricks and inside each. What the tool
  /// touches then lies in few cache lines whatever way it faces. Needs 0 <= (u,v,w) < dims.
  size_t index(int u, int v, int w) const {
    const size_t brick = brick_index({u / brick_edge, v / brick_edge, w / brick_edge});
    return brick * brick_voxels +
           static_cast<size_t>(u % brick_edge +
                               brick_edge * (v % brick_edge + brick_edge * (w % brick_edge)));
  }
  size_t index(const Vec3i& o) const { return index(o.x(), o.y(), o.z()); }
  /// Inverse of index.
  Vec3i coordinates(size_t index) const;
  /// Place of a voxel in files, eq. 2.1 (and 4.1): row after row, x fastest. Needs 0 <= (u,v,w) < dims.
  size_t row_index(int u, int v, int w) const {
    return static_cast<size_t>(u) +
           static_cast<size_t>(dims.x()) *
               (static_cast<size_t>(v) + static_cast<size_t>(dims.y()) * static_cast<size_t>(w));
  }
  bool contains(const Vec3i& o) const { return (o.array() >= 0).all() && (o.array() < dims.array()).all(); }
  /// Eq. 2.3: voxel centre, mm, grid frame.
  Vec3 centre_mm(const Vec3i& o) const {
    return ((o.cast<double>().array() + 0.5) * spacing_mm.array()).matrix();
  }
  /// The voxel that holds a point of the grid frame; may lie outside the grid.
  Vec3i voxel_at(const Vec3& point_mm) const;

  Aabb bounds_mm() const {
    return {Vec3::Zero(), (dims.cast<double>().array() * spacing_mm.array()).matrix()};
  }
  double voxel_volume_mm3() const { return spacing_mm.x() * spacing_mm.y() * spacing_mm.z(); }
  double min_spacing_mm() const { return spacing_mm.minCoeff(); }

  Vec3i brick_dims() const { return dims / brick_edge; }
  size_t brick_count() const {
    const Vec3i b = brick_dims();
    return static_cast<size_t>(b.x()) * static_cast<size_t>(b.y()) * static_cast<size_t>(b.z());
  }
  /// Bricks are numbered like voxels, x fastest.
  uint32_t brick_index(const Vec3i& brick) const {
    const Vec3i b = brick_dims();
    return static_cast<uint32_t>(brick.x() + b.x() * (brick.y() + b.y() * brick.z()));
  }
  Vec3i brick_coordinates(uint32_t brick) const;
  /// Index of the brick's minimum voxel; its other voxels follow.
  size_t brick_base(uint32_t brick) const { return static_cast<size_t>(brick) * brick_voxels; }
};

/// dims rounded up to whole bricks.
Vec3i whole_bricks(const Vec3i& dims);

/// Throws Error invalid_input unless dims are positive multiples of brick_edge and spacing is positive and
/// finite.
void validate(const VoxelGrid& grid);

}  // namespace ream::voxel
