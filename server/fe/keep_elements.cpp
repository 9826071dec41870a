#include "fe/keep_elements.hpp"

namespace ream::fe {

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

}  // namespace ream::fe
