#include "ct/segment/shoulder_steps.hpp"

#include <algorithm>
#include <cmath>

#include "ct/segment/bone_filters.hpp"
#include "ct/segment/mask.hpp"
#include "ct/segment/voxel_window.hpp"

namespace ream::ct {
namespace {

struct Pending {
  uint32_t voxel;
  uint8_t label;
};

/// Voxels that wait, by HU, the densest to be taken first and among equals the one that came first.
class WaitingByHu {
 public:
  WaitingByHu(int lowest_hu, int highest_hu)
      : lowest_hu_(lowest_hu), levels_(static_cast<size_t>(highest_hu - lowest_hu + 1)) {}

  void add(int hu, Pending pending) {
    levels_[std::min(current_, static_cast<size_t>(hu - lowest_hu_))].push_back(pending);
  }
  /// Takes every pending voxel; what take() adds waits its turn.
  template <typename Take>
  void take_all(Take&& take) {
    for (current_ = levels_.size(); current_-- > 0;) {
      auto& level = levels_[current_];
      for (size_t i = 0; i < level.size(); ++i) take(Pending(level[i]));
      std::vector<Pending>().swap(level);
      if (current_ == 0) break;
    }
  }

 private:
  int lowest_hu_;
  std::vector<std::vector<Pending>> levels_;
  size_t current_ = SIZE_MAX;
};

/// Pieces larger than this part of the bone are bones of their own.
constexpr double max_piece_share = 0.25;

/// Sets free pieces of dense voxels that come within `reach_mm` of the bone.
void add_pieces(Mask& bone, const Mask& free_dense, const Vec3i& dims, const Vec3& spacing_mm,
                double reach_mm) {
  const std::vector<float> distance = distance_to_set_mm(bone, dims, spacing_mm);
  const Steps steps(dims);
  const auto largest = static_cast<size_t>(max_piece_share * static_cast<double>(count_set(bone)));
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

}  // namespace

void flood_by_hu(const HuVolume& volume, double lowest_hu, std::vector<uint8_t>& labels) {
  const Steps steps(volume.dims);
  const int lowest = static_cast<int>(std::ceil(lowest_hu));
  const int highest = volume.hu.empty() ? lowest : *std::max_element(volume.hu.begin(), volume.hu.end());
  if (highest < lowest) return;
  WaitingByHu waiting(lowest, highest);
  const auto spread = [&](size_t from, uint8_t label) {
    each_face_neighbour(steps, from, [&](size_t n) {
      if (labels[n] == 0 && volume.hu[n] >= lowest)
        waiting.add(volume.hu[n], {static_cast<uint32_t>(n), label});
    });
  };
  for (size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != 0) spread(i, labels[i]);
  waiting.take_all([&](const Pending& pending) {
    if (labels[pending.voxel] != 0) return;
    labels[pending.voxel] = pending.label;
    spread(pending.voxel, pending.label);
  });
}

void make_whole(std::vector<uint8_t>& labels, const HuVolume& volume, BoneLabel label,
                const WholeBoneSettings& settings) {
  const auto own = static_cast<uint8_t>(label);
  const VoxelWindow box = window_of_set(mask_of(labels, label), volume.dims);
  if (box.dims.isZero()) return;
  const VoxelWindow window = widened(box, volume.dims, volume.spacing_mm, 2.0 * settings.closing_mm);
  const std::vector<uint8_t> around = cut_out(labels, volume.dims, window);
  const std::vector<int16_t> hu = cut_out(volume.hu, volume.dims, window);
  Mask bone = mask_of(around, label), free_dense(around.size());
  for (size_t i = 0; i < around.size(); ++i) free_dense[i] = around[i] == 0 && hu[i] >= settings.threshold_hu;
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
