#include "ct/whole_bone.hpp"

#include <algorithm>

#include "ct/bone_filters.hpp"
#include "ct/face_neighbours.hpp"
#include "ct/voxel_window.hpp"

namespace ream::ct {
namespace {

/// Pieces larger than this part of the bone are bones of their own.
constexpr double largest_piece_share = 0.25;

/// The box of a label and `margin_mm` around it, as far as the volume goes; empty without such voxels.
VoxelWindow window_of(const std::vector<uint8_t>& labels, const HuVolume& volume, BoneLabel label,
                      double margin_mm) {
  Vec3i low = volume.dims, high = -Vec3i::Ones();
  size_t i = 0;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u, ++i) {
        if (labels[i] != static_cast<uint8_t>(label)) continue;
        low = low.cwiseMin(Vec3i(u, v, w));
        high = high.cwiseMax(Vec3i(u, v, w));
      }
  if ((high.array() < low.array()).any()) return {};
  const Vec3i margin = (margin_mm / volume.spacing_mm.array()).ceil().cast<int>().matrix();
  low = (low - margin).cwiseMax(0);
  high = (high + margin).cwiseMin((volume.dims.array() - 1).matrix());
  return {low, high - low + Vec3i::Ones()};
}

/// Sets free pieces of dense voxels that come within `reach_mm` of the bone.
void add_pieces(Mask& bone, const Mask& free_dense, const Vec3i& dims, const Vec3& spacing_mm,
                double reach_mm) {
  const std::vector<float> distance = distance_to_set_mm(bone, dims, spacing_mm);
  const Steps steps(dims);
  const auto largest = static_cast<size_t>(largest_piece_share * static_cast<double>(count_set(bone)));
  Mask pending = free_dense;
  std::vector<size_t> piece;
  for (size_t start = 0; start < pending.size(); ++start) {
    if (!pending[start]) continue;
    piece.assign(1, start);
    pending[start] = 0;
    float nearest = distance[start];
    for (size_t k = 0; k < piece.size(); ++k)
      each_face_neighbour(steps, piece[k], [&](size_t n) {
        if (!pending[n]) return;
        pending[n] = 0;
        nearest = std::min(nearest, distance[n]);
        piece.push_back(n);
      });
    if (static_cast<double>(nearest) > reach_mm || piece.size() > largest) continue;
    for (const size_t i : piece) bone[i] = 1;
  }
}

/// Fills what is enclosed within slices across at least two of the three voxel axes: marrow whose wall has a
/// pore somewhere, which is no closed void in space.
void fill_marrow(Mask& bone, const Vec3i& dims) {
  Mask closed_across(bone.size());
  for (int axis = 0; axis < 3; ++axis)
    for (int slice = 0; slice < dims[axis]; ++slice) {
      VoxelWindow window{Vec3i::Zero(), dims};
      window.low[axis] = slice;
      window.dims[axis] = 1;
      Mask plane = cut_out(bone, dims, window);
      const Mask before = plane;
      fill_voids(plane, window.dims);
      Mask sums = cut_out(closed_across, dims, window);
      for (size_t i = 0; i < plane.size(); ++i) sums[i] = static_cast<uint8_t>(sums[i] + (plane[i] && !before[i]));
      put_back(closed_across, dims, window, sums);
    }
  for (size_t i = 0; i < bone.size(); ++i)
    if (closed_across[i] >= 2) bone[i] = 1;
}

}  // namespace

void make_whole(std::vector<uint8_t>& labels, const HuVolume& volume, BoneLabel label,
                const WholeBoneSettings& settings) {
  const auto own = static_cast<uint8_t>(label);
  const VoxelWindow window = window_of(labels, volume, label, 2.0 * settings.closing_mm);
  if (window.dims.isZero()) return;
  const std::vector<uint8_t> around = cut_out(labels, volume.dims, window);
  const std::vector<int16_t> hu = cut_out(volume.hu, volume.dims, window);
  Mask bone = mask_of(around, label), free_dense(around.size());
  for (size_t i = 0; i < around.size(); ++i)
    free_dense[i] = around[i] == 0 && hu[i] >= settings.threshold_hu;
  add_pieces(bone, free_dense, window.dims, volume.spacing_mm, settings.closing_mm);
  const Mask closed = closed_by_ball(bone, window.dims, volume.spacing_mm, settings.closing_mm);
  for (size_t i = 0; i < bone.size(); ++i)
    if (closed[i] && around[i] == 0 && hu[i] >= settings.thin_bone_hu) bone[i] = 1;
  bone = largest_part(bone, window.dims);
  fill_voids(bone, window.dims);
  fill_marrow(bone, window.dims);
  std::vector<uint8_t> whole = around;
  for (size_t i = 0; i < whole.size(); ++i) {
    if (around[i] == own && !bone[i]) whole[i] = 0;
    if (around[i] == 0 && bone[i]) whole[i] = own;
  }
  put_back(labels, volume.dims, window, whole);
}

}  // namespace ream::ct
