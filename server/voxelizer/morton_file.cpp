#include "voxelizer/voxel_files.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <sstream>

#include "geometry/morton.hpp"

namespace ream::voxelizer {
namespace {

/// Edge of the cubes whose codes are sorted at once: 16 MB of them at most.
constexpr int cube_edge = 128;

/// Cubes of the grid in the order of their codes.
void for_each_cube(const Vec3i& dims, const Vec3i& corner, int edge,
                   const std::function<void(const Vec3i& corner)>& visit) {
  if ((corner.array() >= dims.array()).any()) return;
  if (edge == cube_edge) {
    visit(corner);
    return;
  }
  const int half = edge / 2;
  for (int child = 0; child < 8; ++child)
    for_each_cube(dims, corner + half * Vec3i(child & 1, child >> 1 & 1, child >> 2), half, visit);
}

void add_codes(const VoxelSet& set, const Vec3i& corner, std::vector<uint32_t>& row,
               std::vector<uint64_t>& codes) {
  const Vec3i end = (corner.array() + cube_edge).min(set.grid().dims.array());
  const auto first_word = static_cast<size_t>(corner.x() / 32),
             end_word = static_cast<size_t>((end.x() + 31) / 32);
  for (int w = corner.z(); w < end.z(); ++w)
    for (int v = corner.y(); v < end.y(); ++v) {
      if (!set.read_row(v, w, row)) continue;
      for (size_t i = first_word; i < end_word; ++i)
        for (uint32_t bits = row[i]; bits != 0; bits &= bits - 1)
          codes.push_back(
              morton_code(static_cast<uint32_t>(32 * i) + static_cast<uint32_t>(std::countr_zero(bits)),
                          static_cast<uint32_t>(v), static_cast<uint32_t>(w)));
    }
}

}  // namespace

void write_morton_codes(const VoxelSet& set, AtomicFile& file, const Progress& progress) {
  const RasterGrid& grid = set.grid();
  std::ostringstream header;
  header.precision(17);
  header << "NRRD0004\n# Morton codes of the voxels of a triangle mesh\ntype: uint64\ndimension: 1\nsizes: "
         << set.filled() << "\nendian: little\nencoding: raw\nream_dims:=" << grid.dims.transpose()
         << "\nream_origin_mm:=" << grid.origin_mm.transpose()
         << "\nream_size_mm:=" << grid.size_mm.transpose() << "\n\n";
  file.write(header.str());
  const int longest = grid.dims.maxCoeff();
  int edge = cube_edge;
  while (edge < longest) edge *= 2;
  std::vector<uint32_t> row(grid.words_per_row());
  std::vector<uint64_t> codes;
  uint64_t written = 0;
  for_each_cube(grid.dims, Vec3i::Zero(), edge, [&](const Vec3i& corner) {
    progress(static_cast<double>(written) / static_cast<double>(std::max<uint64_t>(set.filled(), 1)),
             "writing Morton codes");
    codes.clear();
    add_codes(set, corner, row, codes);
    std::sort(codes.begin(), codes.end());
    file.write(std::as_bytes(std::span(codes)));
    written += codes.size();
  });
}

}  // namespace ream::voxelizer
