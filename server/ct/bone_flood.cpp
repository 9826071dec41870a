#include "ct/bone_flood.hpp"

#include <algorithm>
#include <cmath>

#include "ct/face_neighbours.hpp"

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

}  // namespace ream::ct
