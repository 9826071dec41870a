#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/memory_budget.hpp"
#include "core/progress.hpp"
#include "fe/voxel_mask.hpp"
#include "geometry/pose.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::fe {

/// The gray code of every element, in the order of their numbers; on the disk where memory is short.
class ElementCodes {
 public:
  ElementCodes() = default;
  /// Room for `count`; takes what it keeps in memory from the budget.
  ElementCodes(uint64_t count, MemoryBudget& budget);

  uint64_t size() const { return size_; }
  bool in_memory() const { return !spill_; }
  /// All of them; only in memory.
  std::span<uint16_t> all() { return codes_; }

  /// From different threads only at different places.
  void write(uint64_t first, std::span<const uint16_t> codes);
  /// Valid until `scratch` changes. Thread-safe.
  std::span<const uint16_t> read(uint64_t first, size_t count, std::vector<uint16_t>& scratch) const;
  /// Forgets those from `size` on.
  void shrink(uint64_t size, MemoryBudget& budget);
  /// Of memory.
  uint64_t bytes() const { return codes_.size() * sizeof(uint16_t); }

 private:
  uint64_t size_ = 0;
  std::vector<uint16_t> codes_;
  std::unique_ptr<SpillFile> spill_;
};

/// What becomes a mesh: an element for every voxel of the mask, with its gray value. Elements are numbered in
/// the order of the mask's bits. The mesh frame has its axes along the grid's: voxel (u,v,w) fills
/// [(u,v,w), (u,v,w)+1] * spacing_mm + origin_mm.
struct ElementModel {
  VoxelMask mask;
  ElementCodes codes;
  voxel::GrayScale gray;
  Vec3 spacing_mm = Vec3::Ones(), origin_mm = Vec3::Zero();
  Pose world_from_mesh;               ///< to LPS mm; identity where the grid's axes are those of the world
  std::string source;                 ///< for people, without patient names
  std::vector<std::string> remarks;   ///< what was odd or left out
  bool gray_is_density_g_cc = false;  ///< apparent density; else nothing is known of the scale
};

/// After voxels were taken out of the model's mask, which was `before`: takes their gray codes out too.
void keep_elements(const VoxelMask& before, ElementModel& model, MemoryBudget& budget);

/// Which voxels of a layer become elements: their gray code, or `no_element`; x fastest, dims.x * dims.y of
/// them. Called twice for every layer, from two threads, in any order.
using LayerReader = std::function<void(int w, std::span<int32_t> codes)>;
inline constexpr int32_t no_element = -1;

/// Mask and codes of a model whose other fields are set already.
void fill_from_layers(ElementModel& model, const Vec3i& dims, const LayerReader& read, MemoryBudget& budget,
                      const Progress& progress = no_progress);

/// Splits every voxel into factor^3 (thesis section 2.2): the volume stays what it was. Gray values are
/// interpolated linearly between voxel centres (voxel::upsample_tap); where a neighbour is no element, the
/// voxel's own value stands for it, so that no value outside the bone matters. Exact in whole numbers,
/// rounded once, halves up. Takes from the budget; on two threads. Throws Error invalid_input for a factor
/// outside 1 to voxel::max_upsample_factor.
ElementModel refined(ElementModel model, int factor, MemoryBudget& budget,
                     const Progress& progress = no_progress);

/// What hung together by faces before all but the largest part was taken away.
struct ComponentCount {
  uint64_t components = 0;      ///< one more than islands
  uint64_t removed_voxels = 0;  ///< of the islands
};

/// Keeps the largest 6-connected component of the model (of equal ones the first) and its gray codes. On two
/// threads; memory is four bytes a run of voxels, taken from the budget. The mask must not be empty.
ComponentCount keep_largest_component(ElementModel& model, MemoryBudget& budget,
                                      const Progress& progress = no_progress);

}  // namespace ream::fe
