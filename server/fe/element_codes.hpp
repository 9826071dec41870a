#pragma once
#include <memory>
#include <span>
#include <vector>

#include "fe/memory_budget.hpp"
#include "fe/spill_file.hpp"

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

}  // namespace ream::fe
