#pragma once
#include <functional>
#include <span>
#include <vector>

#include "fe/materials.hpp"

namespace ream::fe {

/// Ids of the elements of some materials, rising for each.
struct SetsPart {
  size_t first_material = 0, end_material = 0;
  std::vector<uint32_t> ids;
  std::vector<uint64_t> begins;  ///< in ids, of each material, and the end

  std::span<const uint32_t> ids_of(size_t material) const {
    const size_t i = material - first_material;
    return std::span(ids).subspan(begins[i], begins[i + 1] - begins[i]);
  }
};

/// Groups the elements by material, counting, for as many materials at a time as the budget has room for.
/// Calls use for each part, by rising material.
void for_each_part_of_sets(const ElementCodes& codes, const Materials& materials, MemoryBudget& budget,
                           const std::function<void(const SetsPart&)>& use);

}  // namespace ream::fe
