#include "surface/block_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "surface/marching_cubes.hpp"

namespace ream::surface {
namespace {

/// Folds between the two halves; its own inverse.
void fold(float& x, float& y) {
  const float unfolded_x = x;
  x = std::copysign(1.0f - std::fabs(y), x);
  y = std::copysign(1.0f - std::fabs(unfolded_x), y);
}

int8_t signed_byte(float v) { return static_cast<int8_t>(std::floor(v * 127.0f + 0.5f)); }

constexpr int half = units_per_voxel / 2;
constexpr int row_bytes = BlockVolume::row_bytes, slice_bytes = BlockVolume::slice_bytes;
constexpr size_t max_triangles = 5;

/// Eight samples of a row of x, or sums of them.
using Lanes = int16_t __attribute__((vector_size(16)));

Lanes load_lanes(const uint8_t* samples) {
  using Bytes = uint8_t __attribute__((vector_size(8)));
  Bytes bytes;
  std::memcpy(&bytes, samples, sizeof bytes);
  return __builtin_convertvector(bytes, Lanes);
}

/// Minus the gradient at a sample, times 32: central differences, averaged across with weights 1 2 1 because
/// a coverage that falls within one voxel is too steep for bare ones (they show rings on round surfaces).
/// `sample` has neighbours one row and one slice around it, and seven samples may be read from the one before
/// it on.
std::array<int, 3> fall_at(const uint8_t* sample) {
  std::array<Lanes, 3> sum, fall_y;  // of the slices before, at and after the sample, weighted along y
  for (int z = 0; z < 3; ++z) {
    const uint8_t* row = sample - 1 + (z - 1) * slice_bytes;
    const Lanes before = load_lanes(row - row_bytes), at = load_lanes(row),
                after = load_lanes(row + row_bytes);
    sum[static_cast<size_t>(z)] = before + at + at + after;
    fall_y[static_cast<size_t>(z)] = before - after;
  }
  const Lanes along_x = sum[0] + sum[1] + sum[1] + sum[2];
  const Lanes along_y = fall_y[0] + fall_y[1] + fall_y[1] + fall_y[2];
  const Lanes along_z = sum[0] - sum[2];
  return {along_x[0] - along_x[2], along_y[0] + 2 * along_y[1] + along_y[2],
          along_z[0] + 2 * along_z[1] + along_z[2]};
}

template <typename Visit>
void for_each_bit(uint64_t word, Visit visit) {
  for (; word != 0; word &= word - 1) visit(std::countr_zero(word));
}

/// Where coverage crosses 127.5 between two samples, from the first, rounded to 1/1024 of their distance:
/// 4..1020.
int crossing(int first, int second) {
  const int numerator = half * std::abs(255 - 2 * first), denominator = std::abs(second - first);
  return (2 * numerator + denominator) / (2 * denominator);
}

int slot(int axis, int x, int y, int z) {
  return (((z & 1) * BlockVolume::edge + y) * row_bytes + x) * 3 + axis;
}

/// Slot of each cell edge relative to the cell's, for even and odd z.
std::array<std::array<int, 12>, 2> edge_slots() {
  std::array<std::array<int, 12>, 2> result{};
  for (int parity = 0; parity < 2; ++parity)
    for (int e = 0; e < 12; ++e) {
      const CellEdge ce = cell_edge(e);
      result[static_cast<size_t>(parity)][static_cast<size_t>(e)] =
          slot(ce.axis, ce.lower_corner[0], ce.lower_corner[1], parity + ce.lower_corner[2]);
    }
  return result;
}

int checked(int stride) {
  if (stride != 1 && stride != 2 && stride != 4)
    throw Error(ErrorKind::invalid_input,
                "surface stride " + std::to_string(stride) + " is not possible; use 1, 2 or 4");
  return stride;
}

}  // namespace

std::array<int8_t, 2> octahedral_from_direction(const Vec3f& direction) {
  const float sum = std::fabs(direction.x()) + std::fabs(direction.y()) + std::fabs(direction.z());
  float x = direction.x() / sum, y = direction.y() / sum;
  if (direction.z() < 0.0f) fold(x, y);
  return {signed_byte(x), signed_byte(y)};
}

Vec3f direction_from_octahedral(int8_t ox, int8_t oy) {
  float x = static_cast<float>(ox) / 127.0f, y = static_cast<float>(oy) / 127.0f;
  const float z = 1.0f - std::fabs(x) - std::fabs(y);
  if (z < 0.0f) fold(x, y);
  return Vec3f(x, y, z).normalized();
}

Vec3f position_mm(const BlockVertex& vertex, const Vec3i& block, const Vec3& spacing_mm) {
  const Vec3 voxels = ((block * block_edge).array() - 1).cast<double>().matrix() +
                      Vec3(vertex.x, vertex.y, vertex.z) / units_per_voxel;
  return (voxels.array() * spacing_mm.array()).cast<float>();
}

BlockExtractor::BlockExtractor(const voxel::VoxelGrid& grid, int stride)
    : layout_(grid),
      voxels_per_mm_((1.0 / grid.spacing_mm.array()).cast<float>()),
      volume_(grid, checked(stride)),
      vertex_of_edge_(2 * static_cast<size_t>(slice_bytes) * 3) {}

BlockMesh BlockExtractor::extract(const uint8_t* coverage, uint32_t block) {
  BlockMesh mesh;
  mesh.block = block;
  if (!volume_.load(coverage, layout_.coordinates(block))) return mesh;
  index_count_ = 0;
  for (int z = volume_.low().z(); z <= volume_.last().z(); ++z) {
    add_vertices(z, mesh);
    if (z > volume_.low().z()) add_triangles(z - 1);
  }
  mesh.indices.assign(indices_.begin(), indices_.begin() + static_cast<ptrdiff_t>(index_count_));
  return mesh;
}

void BlockExtractor::add_vertices(int z, BlockMesh& mesh) {
  const Vec3i &low = volume_.low(), &last = volume_.last();
  const uint64_t corners = bits(low.x(), last.x()), x_edges = bits(low.x(), last.x() - 1);
  const auto add = [&](uint64_t crossed, int axis, int y) {
    for_each_bit(crossed, [&](int x) {
      vertex_of_edge_[static_cast<size_t>(slot(axis, x, y, z))] = static_cast<uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(make_vertex(axis, x, y, z));
    });
  };
  for (int y = low.y(); y <= last.y(); ++y) {
    const uint64_t filled = volume_.filled(y, z);
    add((filled ^ (filled >> 1)) & x_edges, 0, y);
    if (y < last.y()) add((filled ^ volume_.filled(y + 1, z)) & corners, 1, y);
    if (z < last.z()) add((filled ^ volume_.filled(y, z + 1)) & corners, 2, y);
  }
}

BlockVertex BlockExtractor::make_vertex(int axis, int x, int y, int z) const {
  constexpr std::array<int, 3> step = {1, row_bytes, slice_bytes};
  const uint8_t* first = volume_.row(y, z) + x;
  const uint8_t* second = first + step[static_cast<size_t>(axis)];
  const int offset = crossing(*first, *second);

  // Whole numbers, so the same in every block that has this vertex.
  const std::array<int, 3> fall_first = fall_at(first), fall_second = fall_at(second);
  Vec3i fall;
  for (size_t i = 0; i < 3; ++i)
    fall[static_cast<int>(i)] = fall_first[i] * (units_per_voxel - offset) + fall_second[i] * offset;
  Vec3f outward = fall.cast<float>().cwiseProduct(voxels_per_mm_);
  if (fall.isZero()) outward[axis] = *first > *second ? 1.0f : -1.0f;
  const std::array<int8_t, 2> normal = octahedral_from_direction(outward);

  const int stride = volume_.stride(), centre = stride * half + units_per_voxel;
  std::array<int, 3> p = {units_per_voxel * stride * (x - BlockVolume::margin_x) + centre,
                          units_per_voxel * stride * (y - BlockVolume::margin) + centre,
                          units_per_voxel * stride * (z - BlockVolume::margin) + centre};
  p[static_cast<size_t>(axis)] += stride * offset;
  return {static_cast<uint16_t>(p[0]), static_cast<uint16_t>(p[1]), static_cast<uint16_t>(p[2]), normal[0],
          normal[1]};
}

void BlockExtractor::add_triangles(int z) {
  static const std::array<std::array<int, 12>, 2> slots = edge_slots();
  const std::array<int, 12>& slot_of_edge = slots[static_cast<size_t>(z & 1)];
  const auto& cases = cell_cases();
  const Vec3i &low = volume_.low(), &last = volume_.last();
  for (int y = low.y(); y < last.y(); ++y) {
    const uint64_t a = volume_.filled(y, z), b = volume_.filled(y + 1, z);
    const uint64_t c = volume_.filled(y, z + 1), d = volume_.filled(y + 1, z + 1);
    const uint64_t any = a | b | c | d, all = a & b & c & d;
    const uint64_t mixed = (any | (any >> 1)) & ~(all & (all >> 1)) & bits(low.x(), last.x() - 1);
    const size_t most = index_count_ + 3 * max_triangles * static_cast<size_t>(std::popcount(mixed));
    if (indices_.size() < most) indices_.resize(2 * most);
    uint32_t* next = indices_.data() + index_count_;
    for_each_bit(mixed, [&](int x) {
      const auto pair = [x](uint64_t filled) { return (filled >> x) & 3; };
      const CellCase& cell = cases[pair(a) | pair(b) << 2 | pair(c) << 4 | pair(d) << 6];
      const uint32_t* vertex = vertex_of_edge_.data() + (y * row_bytes + x) * 3;
      for (size_t t = 0; t < cell.triangle_count; ++t)
        for (const uint8_t e : cell.triangles[t]) *next++ = vertex[slot_of_edge[e]];
    });
    index_count_ = static_cast<size_t>(next - indices_.data());
  }
}

}  // namespace ream::surface
