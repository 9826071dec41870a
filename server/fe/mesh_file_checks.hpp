#pragma once
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "fe/mesh_check.hpp"

namespace ream::fe {

/// Adds up elements one by one.
class HexSum {
 public:
  explicit HexSum(ElementVisitor visit) : visit_(std::move(visit)) {}

  /// False when its Jacobian is not positive at every corner.
  bool add(const HexCorners& corners);
  double volume_mm3() const { return volume_mm3_; }
  double min_jacobian_mm3() const { return min_mm3_; }

 private:
  ElementVisitor visit_;
  double volume_mm3_ = 0.0, min_mm3_ = std::numeric_limits<double>::infinity();
};

/// A set of ids, a bit each.
class IdSet {
 public:
  /// False when it was in already.
  bool insert(uint64_t id) {
    if (id / 64 >= words_.size()) words_.resize(id / 64 + id / 128 + 1024);
    const uint64_t bit = uint64_t{1} << (id % 64);
    const bool is_new = (words_[id / 64] & bit) == 0;
    words_[id / 64] |= bit;
    size_ += is_new ? 1 : 0;
    return is_new;
  }
  bool contains(uint64_t id) const {
    return id / 64 < words_.size() && (words_[id / 64] >> (id % 64) & 1u) != 0;
  }
  uint64_t size() const { return size_; }
  /// The least id that is here and not there; 0 when there is none.
  uint64_t first_not_in(const IdSet& there) const {
    for (size_t i = 0; i < words_.size(); ++i) {
      const uint64_t left = words_[i] & ~(i < there.words_.size() ? there.words_[i] : 0);
      if (left != 0) return 64 * i + static_cast<uint64_t>(std::countr_zero(left));
    }
    return 0;
  }

 private:
  std::vector<uint64_t> words_;
  uint64_t size_ = 0;
};

// check_mesh_file() by format.
MeshFacts check_inp(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit);
MeshFacts check_vtu(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit);

/// How many nodes' coordinates may be at hand at once.
inline uint64_t max_nodes_at_hand(const MemoryBudget& budget) {
  return std::min<uint64_t>(budget.left() / (2 * sizeof(Vec3)), uint64_t{1} << 31);
}

}  // namespace ream::fe
