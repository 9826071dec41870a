#include "voxel/brick_distance.hpp"

#include <algorithm>

#include "voxel/solid_cells.hpp"

namespace ream::voxel {
namespace {

bool brick_has_bone(const BoneModel& bone, uint32_t brick) {
  return (SolidCells::word_of(bone.coverage.data() + bone.grid.brick_base(brick)) & 0xff) != 0;
}

/// One separable pass of the Chebyshev distance transform along one axis: d[k] = min over j of max(d[j], |k -
/// j|).
void sweep_axis(std::vector<uint8_t>& field, const Vec3i& dims, int axis) {
  const size_t stride[3] = {1, static_cast<size_t>(dims.x()),
                            static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y())};
  const int n = dims[axis], a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<uint8_t> line(static_cast<size_t>(n)), result(static_cast<size_t>(n));
  for (int i = 0; i < dims[a]; ++i)
    for (int j = 0; j < dims[b]; ++j) {
      uint8_t* start = field.data() + static_cast<size_t>(i) * stride[a] + static_cast<size_t>(j) * stride[b];
      for (int k = 0; k < n; ++k) line[static_cast<size_t>(k)] = start[static_cast<size_t>(k) * stride[axis]];
      for (int k = 0; k < n; ++k) {
        int best = line[static_cast<size_t>(k)];
        for (int offset = 1; offset < best; ++offset) {
          if (k - offset >= 0)
            best = std::min(best, std::max<int>(offset, line[static_cast<size_t>(k - offset)]));
          if (k + offset < n)
            best = std::min(best, std::max<int>(offset, line[static_cast<size_t>(k + offset)]));
        }
        result[static_cast<size_t>(k)] = static_cast<uint8_t>(best);
      }
      for (int k = 0; k < n; ++k)
        start[static_cast<size_t>(k) * stride[axis]] = result[static_cast<size_t>(k)];
    }
}

}  // namespace

float BrickDistance::lower_bound_voxels(float x, float y, float z) const noexcept {
  const float edge = brick_edge;
  const float p[3] = {x, y, z};
  int brick[3];
  float outside = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float limit = static_cast<float>(brick_dims[i]) * edge;
    float c = p[i];
    if (c < 0.0f) {
      outside = std::max(outside, -c);
      c = 0.0f;
    }
    if (c >= limit) {
      outside = std::max(outside, c - limit);
      c = limit - 0.5f;
    }
    brick[i] = std::min(static_cast<int>(c * (1.0f / edge)), brick_dims[i] - 1);
  }
  const uint8_t distance =
      bricks[static_cast<size_t>(brick[0] + brick_dims.x() * (brick[1] + brick_dims.y() * brick[2]))];
  const float inside = distance > 0 ? static_cast<float>(distance - 1) * edge : 0.0f;
  return std::max(outside, inside);
}

bool BrickDistance::nothing() const noexcept {
  return std::none_of(bricks.begin(), bricks.end(), [](uint8_t d) { return d == 0; });
}

BrickDistance brick_distance(const BoneModel& bone) {
  BrickDistance field{bone.grid.brick_dims(),
                      std::vector<uint8_t>((bone.grid.brick_count() + 3) / 4 * 4, 255)};
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b)
    if (brick_has_bone(bone, b)) field.bricks[b] = 0;
  for (int axis = 0; axis < 3; ++axis) sweep_axis(field.bricks, field.brick_dims, axis);
  return field;
}

}  // namespace ream::voxel
