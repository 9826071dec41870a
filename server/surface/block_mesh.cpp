#include "surface/block_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "surface/marching_cubes.hpp"
#include "surface/octahedral.hpp"

namespace ream::surface {
namespace {


// The copy holds voxels -2..33 of the block: cells reach voxel 32, gradients one further.
constexpr int margin = 2;
constexpr int edge = block_edge + 2 * margin;
constexpr int row_bytes = 40;
constexpr int slice_bytes = row_bytes * edge;
constexpr int last_corner = margin + block_edge;
constexpr int half = units_per_voxel / 2;

/// Bits first..last.
constexpr uint64_t bits(int first, int last) {
  return (~uint64_t{0} << first) & (~uint64_t{0} >> (63 - last));
}

/// Bit i is the top bit of byte i: set where coverage is 128 or more.
uint64_t filled_bits(const uint8_t* row) {
  uint64_t result = 0;
  for (int i = 0; i < row_bytes / 8; ++i) {
    uint64_t word;
    std::memcpy(&word, row + 8 * i, 8);
    result |= (((word >> 7) & 0x0101010101010101ull) * 0x0102040810204080ull >> 56) << (8 * i);
  }
  return result;
}

template <typename Visit>
void for_each_bit(uint64_t word, Visit visit) {
  for (; word != 0; word &= word - 1) visit(std::countr_zero(word));
}

/// Where coverage crosses 127.5 between two voxel centres, from the first, rounded to 1/1024 voxel: 4..1020.
int crossing(int first, int second) {
  const int numerator = half * std::abs(255 - 2 * first), denominator = std::abs(second - first);
  return (2 * numerator + denominator) / (2 * denominator);
}

/// Minus the gradient of coverage at a voxel of the copy, times 32: central differences, averaged across with
/// weights 1 2 1 because a coverage that falls within one voxel is too steep for bare ones (they show rings
/// on round surfaces).
Vec3i fall_at(const uint8_t* voxel) {
  Vec3i fall = Vec3i::Zero();
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y) {
      const uint8_t* row = voxel + z * slice_bytes + y * row_bytes;
      const int sum = row[-1] + 2 * row[0] + row[1], weight_y = 2 - y * y, weight_z = 2 - z * z;
      fall += Vec3i((row[-1] - row[1]) * weight_y * weight_z, -y * sum * weight_z, -z * sum * weight_y);
    }
  return fall;
}

int slot(int axis, int x, int y, int z) { return (((z & 1) * edge + y) * row_bytes + x) * 3 + axis; }

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

}  // namespace

Vec3f position_mm(const BlockVertex& vertex, const Vec3i& block, const Vec3& spacing_mm) {
  const Vec3 voxels = ((block * block_edge).array() - 1).cast<double>().matrix() +
                      Vec3(vertex.x, vertex.y, vertex.z) / units_per_voxel;
  return (voxels.array() * spacing_mm.array()).cast<float>();
}

BlockExtractor::BlockExtractor(const voxel::VoxelGrid& grid)
    : grid_(grid),
      block_dims_((grid.dims.array() + (block_edge - 1)).matrix() / block_edge),
      voxels_per_mm_((1.0 / grid.spacing_mm.array()).cast<float>()),
      copy_(static_cast<size_t>(slice_bytes) * edge),
      filled_(static_cast<size_t>(edge) * edge),
      vertex_of_edge_(2 * static_cast<size_t>(slice_bytes) * 3) {}

Vec3i BlockExtractor::block_coordinates(uint32_t block) const {
  const int i = static_cast<int>(block);
  return {i % block_dims_.x(), (i / block_dims_.x()) % block_dims_.y(),
          i / (block_dims_.x() * block_dims_.y())};
}

BlockMesh BlockExtractor::extract(const uint8_t* coverage, uint32_t block) {
  BlockMesh mesh;
  mesh.block = block;
  if (!load(coverage, block_coordinates(block))) return mesh;
  for (int z = low_.z(); z <= last_corner; ++z) {
    add_vertices(z, mesh);
    if (z > low_.z()) add_triangles(z - 1, mesh);
  }
  return mesh;
}

bool BlockExtractor::load(const uint8_t* coverage, const Vec3i& block) {
  const Vec3i origin = (block * block_edge).array() - margin;
  low_ = (block.array() == 0).select(Vec3i::Constant(margin - 1), Vec3i::Constant(margin));
  const int first = std::max(0, -origin.x()), last = std::min(edge, grid_.dims.x() - origin.x());
  const uint64_t corners = bits(low_.x(), last_corner);
  uint64_t any = 0, all = corners;
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y) {
      uint8_t* row = copy_.data() + z * slice_bytes + y * row_bytes;
      const int v = origin.y() + y, w = origin.z() + z;
      if (v < 0 || w < 0 || v >= grid_.dims.y() || w >= grid_.dims.z()) {
        std::memset(row, 0, row_bytes);
      } else {
        if (first > 0 || last < edge) std::memset(row, 0, row_bytes);
        copy_row(coverage, {origin.x() + first, v, w}, last - first, row + first);
      }
      const uint64_t filled = filled_bits(row);
      filled_[static_cast<size_t>(z * edge + y)] = filled;
      if (y >= low_.y() && y <= last_corner && z >= low_.z() && z <= last_corner) {
        any |= filled & corners;
        all &= filled;
      }
    }
  return any != 0 && all != corners;
}

void BlockExtractor::copy_row(const uint8_t* coverage, const Vec3i& from, int count, uint8_t* to) const {
  for (int u = from.x(), end = from.x() + count; u < end;) {
    const int run = std::min(voxel::brick_edge - u % voxel::brick_edge, end - u);
    std::memcpy(to, coverage + grid_.index(u, from.y(), from.z()), static_cast<size_t>(run));
    to += run;
    u += run;
  }
}

void BlockExtractor::add_vertices(int z, BlockMesh& mesh) {
  const uint64_t corners = bits(low_.x(), last_corner), x_edges = bits(low_.x(), last_corner - 1);
  for (int y = low_.y(); y <= last_corner; ++y) {
    const uint64_t* row = filled_.data() + z * edge + y;
    for_each_bit((row[0] ^ (row[0] >> 1)) & x_edges, [&](int x) { add_vertex(0, x, y, z, mesh); });
    if (y < last_corner)
      for_each_bit((row[0] ^ row[1]) & corners, [&](int x) { add_vertex(1, x, y, z, mesh); });
    if (z < last_corner)
      for_each_bit((row[0] ^ row[edge]) & corners, [&](int x) { add_vertex(2, x, y, z, mesh); });
  }
}

void BlockExtractor::add_vertex(int axis, int x, int y, int z, BlockMesh& mesh) {
  constexpr std::array<int, 3> stride = {1, row_bytes, slice_bytes};
  const uint8_t* first = copy_.data() + z * slice_bytes + y * row_bytes + x;
  const uint8_t* second = first + stride[static_cast<size_t>(axis)];
  const int offset = crossing(*first, *second);

  // Whole numbers, so the same in every block that has this vertex.
  const Vec3i fall = fall_at(first) * (units_per_voxel - offset) + fall_at(second) * offset;
  Vec3f outward = fall.cast<float>().cwiseProduct(voxels_per_mm_);
  if (fall.isZero()) outward[axis] = *first > *second ? 1.0f : -1.0f;
  const std::array<int8_t, 2> normal = octahedral_from_direction(outward);

  std::array<int, 3> p = {units_per_voxel * x - half, units_per_voxel * y - half, units_per_voxel * z - half};
  p[static_cast<size_t>(axis)] += offset;
  vertex_of_edge_[static_cast<size_t>(slot(axis, x, y, z))] = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({static_cast<uint16_t>(p[0]), static_cast<uint16_t>(p[1]),
                           static_cast<uint16_t>(p[2]), normal[0], normal[1]});
}

void BlockExtractor::add_triangles(int z, BlockMesh& mesh) const {
  static const std::array<std::array<int, 12>, 2> slots = edge_slots();
  const std::array<int, 12>& slot_of_edge = slots[static_cast<size_t>(z & 1)];
  const auto& cases = cell_cases();
  for (int y = low_.y(); y < last_corner; ++y) {
    const uint64_t* row = filled_.data() + z * edge + y;
    const uint64_t a = row[0], b = row[1], c = row[edge], d = row[edge + 1];
    const uint64_t any = a | b | c | d, all = a & b & c & d;
    const uint64_t mixed = (any | (any >> 1)) & ~(all & (all >> 1)) & bits(low_.x(), last_corner - 1);
    for_each_bit(mixed, [&](int x) {
      const auto pair = [x](uint64_t filled) { return (filled >> x) & 3; };
      const CellCase& cell = cases[pair(a) | pair(b) << 2 | pair(c) << 4 | pair(d) << 6];
      const uint32_t* vertex = vertex_of_edge_.data() + (y * row_bytes + x) * 3;
      for (size_t t = 0; t < cell.triangle_count; ++t)
        for (const uint8_t e : cell.triangles[t]) mesh.indices.push_back(vertex[slot_of_edge[e]]);
    });
  }
}

}  // namespace ream::surface
