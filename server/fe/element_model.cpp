#include "fe/element_model.hpp"

#include <algorithm>
#include <numeric>

#include "core/thread_pool.hpp"

namespace ream::fe {

ElementCodes::ElementCodes(uint64_t count, MemoryBudget& budget) : size_(count) {
  // What comes later (sets, the next grid) wants memory too.
  const uint64_t bytes = count * sizeof(uint16_t);
  if (budget.left() == UINT64_MAX || budget.fits(2 * bytes)) {
    budget.take(bytes, "the gray values of the elements");
    codes_.resize(count);
  } else {
    spill_ = std::make_unique<SpillFile>(budget.folder());
  }
}

void ElementCodes::write(uint64_t first, std::span<const uint16_t> codes) {
  if (spill_)
    spill_->write_at(first * sizeof(uint16_t), std::as_bytes(codes));
  else
    std::copy(codes.begin(), codes.end(), codes_.begin() + static_cast<std::ptrdiff_t>(first));
}

std::span<const uint16_t> ElementCodes::read(uint64_t first, size_t count,
                                             std::vector<uint16_t>& scratch) const {
  if (!spill_) return std::span(codes_).subspan(first, count);
  scratch.resize(count);
  spill_->read_at(first * sizeof(uint16_t), std::as_writable_bytes(std::span(scratch)));
  return scratch;
}

void ElementCodes::shrink(uint64_t size, MemoryBudget& budget) {
  size_ = size;
  if (spill_) return;
  budget.give_back((codes_.size() - size) * sizeof(uint16_t));
  codes_.resize(size);
  codes_.shrink_to_fit();
}

void keep_elements(const VoxelMask& before, ElementModel& model, MemoryBudget& budget) {
  const VoxelMask& after = model.mask;
  ElementCodes& codes = model.codes;
  const int rows = before.dims().y();
  uint64_t from = 0, to = 0;
  std::vector<uint16_t> scratch, left;
  for (int w = 0; w < before.dims().z(); ++w) {
    const size_t words = before.words_per_row() * static_cast<size_t>(rows);
    const size_t count = set_bits(before.row(0, w), words);
    const auto layer = codes.read(from, count, scratch);
    left.clear();
    size_t element = 0;
    for (size_t i = 0; i < words; ++i)
      for (uint64_t was = before.row(0, w)[i]; was != 0; was &= was - 1, ++element)
        if ((after.row(0, w)[i] >> std::countr_zero(was) & 1u) != 0) left.push_back(layer[element]);
    codes.write(to, left);
    from += count;
    to += left.size();
  }
  codes.shrink(to, budget);
}

void fill_from_layers(ElementModel& model, const Vec3i& dims, const LayerReader& read, MemoryBudget& budget,
                      const Progress& progress) {
  budget.take(VoxelMask::bytes_of(dims), "the grid");
  model.mask = VoxelMask(dims);
  VoxelMask& mask = model.mask;
  const auto layers = static_cast<size_t>(dims.z());
  const size_t layer_voxels = static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y());
  std::vector<uint64_t> before(layers + 1);
  parallel_for(
      2, layers,
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
  parallel_for(
      2, layers,
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

}  // namespace ream::fe
