#include "voxelizer/voxel_files.hpp"

#include <array>
#include <bit>

#include "core/error.hpp"

namespace ream::voxelizer {
namespace {

constexpr uint64_t max_faces = (uint64_t{1} << 31) / 4 - 1;

/// Corners of the faces towards -x, +x, -y, +y, -z, +z, in voxels.
constexpr int face_corners[6][4][3] = {
    {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}},
    {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// Visits the exposed faces of a set row by row.
class Faces {
 public:
  explicit Faces(const VoxelSet& set) : set_(set) {
    for (auto& row : rows_) row.resize(set.grid().words_per_row());
  }

  /// Calls visit(side, word number, bits) for the voxels of a row that show that side.
  template <class Visit>
  void for_each(int v, int w, Visit visit) {
    if (!set_.read_row(v, w, rows_[0])) return;
    read(1, v - 1, w);
    read(2, v + 1, w);
    read(3, v, w - 1);
    read(4, v, w + 1);
    const auto& row = rows_[0];
    for (size_t i = 0; i < row.size(); ++i) {
      if (row[i] == 0) continue;
      const uint32_t before = i > 0 ? row[i - 1] >> 31 : 0,
                     behind = i + 1 < row.size() ? row[i + 1] << 31 : 0;
      visit(0, i, row[i] & ~(row[i] << 1 | before));
      visit(1, i, row[i] & ~(row[i] >> 1 | behind));
      for (size_t side = 2; side < 6; ++side) visit(static_cast<int>(side), i, row[i] & ~rows_[side - 1][i]);
    }
  }

 private:
  void read(size_t place, int v, int w) {
    const Vec3i& dims = set_.grid().dims;
    if (v >= 0 && v < dims.y() && w >= 0 && w < dims.z())
      set_.read_row(v, w, rows_[place]);
    else
      std::fill(rows_[place].begin(), rows_[place].end(), 0u);
  }

  const VoxelSet& set_;
  std::array<std::vector<uint32_t>, 5> rows_;
};

uint64_t count_faces(const VoxelSet& set, const Progress& progress) {
  Faces faces(set);
  uint64_t count = 0;
  for (int w = 0; w < set.grid().dims.z(); ++w) {
    progress(w / static_cast<double>(set.grid().dims.z()), "counting faces");
    for (int v = 0; v < set.grid().dims.y(); ++v)
      faces.for_each(
          v, w, [&](int, size_t, uint32_t bits) { count += static_cast<uint64_t>(std::popcount(bits)); });
  }
  return count;
}

void write_face(const RasterGrid& grid, const Vec3i& voxel, int side, AtomicFile& file) {
  for (const auto& corner : face_corners[side]) {
    std::array<float, 3> at{};
    for (int k = 0; k < 3; ++k)
      at[static_cast<size_t>(k)] =
          static_cast<float>(grid.origin_mm[k] + grid.size_mm[k] * static_cast<double>(voxel[k] + corner[k]));
    file.write_value(at);
  }
}

}  // namespace

void write_boxes(const VoxelSet& set, AtomicFile& file, const Progress& progress) {
  const uint64_t count = count_faces(set, part_of(progress, 0.0, 0.3));
  if (count > max_faces)
    throw Error(ErrorKind::invalid_input,
                std::to_string(count) + " faces are too many for a file of boxes; use larger voxels");
  file.write("ply\nformat binary_little_endian 1.0\ncomment voxels, millimetres\nelement vertex " +
             std::to_string(4 * count) +
             "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(count) +
             "\nproperty list uchar int vertex_indices\nend_header\n");
  Faces faces(set);
  for (int w = 0; w < set.grid().dims.z(); ++w) {
    progress(0.3 + 0.7 * w / static_cast<double>(set.grid().dims.z()), "writing boxes");
    for (int v = 0; v < set.grid().dims.y(); ++v)
      faces.for_each(v, w, [&](int side, size_t word, uint32_t bits) {
        for (; bits != 0; bits &= bits - 1)
          write_face(set.grid(), {static_cast<int>(32 * word) + std::countr_zero(bits), v, w}, side, file);
      });
  }
  for (uint32_t face = 0; face < count; ++face) {
    file.write_value(uint8_t{4});
    file.write_value(std::array<uint32_t, 4>{4 * face, 4 * face + 1, 4 * face + 2, 4 * face + 3});
  }
}

}  // namespace ream::voxelizer
