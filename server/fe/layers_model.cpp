#include "fe/layers_model.hpp"

#include <numeric>

#include "fe/keep_elements.hpp"
#include "fe/two_threads.hpp"

namespace ream::fe {

void fill_from_layers(ElementModel& model, const Vec3i& dims, const LayerReader& read, MemoryBudget& budget,
                      const Progress& progress) {
  budget.take(VoxelMask::bytes_of(dims), "the grid");
  model.mask = VoxelMask(dims);
  VoxelMask& mask = model.mask;
  const auto layers = static_cast<size_t>(dims.z());
  const size_t layer_voxels = static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y());
  std::vector<uint64_t> before(layers + 1);
  on_two_threads(
      layers,
      [&](size_t w) {
        std::vector<int32_t> codes(layer_voxels);
        read(static_cast<int>(w), codes);
        const int32_t* code = codes.data();
        for (int v = 0; v < dims.y(); ++v) {
          uint64_t* row = mask.row(v, static_cast<int>(w));
          for (int u = 0; u < dims.x(); ++u, ++code) row[u / 64] |= uint64_t{*code != no_element} << (u % 64);
        }
        before[w] =
            set_bits(mask.row(0, static_cast<int>(w)), mask.words_per_row() * static_cast<size_t>(dims.y()));
      },
      part_of(progress, 0.0, 0.5), "finding bone");
  std::exclusive_scan(before.begin(), before.end(), before.begin(), uint64_t{0});
  model.codes = ElementCodes(before.back(), budget);
  on_two_threads(
      layers,
      [&](size_t w) {
        if (before[w + 1] == before[w]) return;
        std::vector<int32_t> codes(layer_voxels);
        read(static_cast<int>(w), codes);
        std::vector<uint16_t> elements;
        elements.reserve(before[w + 1] - before[w]);
        for (const int32_t code : codes)
          if (code != no_element) elements.push_back(static_cast<uint16_t>(code));
        model.codes.write(before[w], elements);
      },
      part_of(progress, 0.5, 1.0), "reading gray values");
}

void remove_below(ElementModel& model, double threshold, MemoryBudget& budget) {
  const VoxelMask before = model.mask;
  uint64_t element = 0;
  std::vector<uint16_t> scratch;
  for (int w = 0; w < before.dims().z(); ++w)
    for (int v = 0; v < before.dims().y(); ++v) {
      const size_t count = set_bits(before.row(v, w), before.words_per_row());
      if (count == 0) continue;
      const auto codes = model.codes.read(element, count, scratch);
      element += count;
      const uint16_t* code = codes.data();
      uint64_t* row = model.mask.row(v, w);
      for_each_run(before.row(v, w), before.words_per_row(), [&](int begin, int end) {
        for (int u = begin; u < end; ++u)
          if (model.gray.value(*code++) < threshold) row[u / 64] &= ~(uint64_t{1} << (u % 64));
      });
    }
  keep_elements(before, model, budget);
}

}  // namespace ream::fe
