#include "fe/element_codes.hpp"

#include <algorithm>

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

}  // namespace ream::fe
