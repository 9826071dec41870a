#include "fe/element_sets.hpp"

#include <algorithm>
#include <array>

#include "fe/two_threads.hpp"

namespace ream::fe {
namespace {

constexpr size_t block = size_t{1} << 20;

/// Calls use(id, material) for the elements of one half of the mesh.
template <typename Use>
void for_each_of_half(const ElementCodes& codes, const Materials& materials, size_t half, Use&& use) {
  const uint64_t middle = codes.size() / 2;
  const uint64_t begin = half == 0 ? 0 : middle, end = half == 0 ? middle : codes.size();
  std::vector<uint16_t> scratch;
  for (uint64_t first = begin; first < end; first += block) {
    uint64_t id = first + 1;
    for (const uint16_t code : codes.read(first, std::min<uint64_t>(block, end - first), scratch))
      use(id++, materials.of_code[code]);
  }
}

/// A material of more than the limit is a part of its own.
size_t end_of_part(const Materials& materials, size_t first, uint64_t most_ids) {
  uint64_t ids = 0;
  size_t end = first;
  while (end < materials.list.size() && (end == first || ids + materials.list[end].elements <= most_ids))
    ids += materials.list[end++].elements;
  return end;
}

}  // namespace

void for_each_part_of_sets(const ElementCodes& codes, const Materials& materials, MemoryBudget& budget,
                           const std::function<void(const SetsPart&)>& use) {
  const size_t count = materials.list.size();
  std::array<std::vector<uint64_t>, 2> places{std::vector<uint64_t>(count), std::vector<uint64_t>(count)};
  on_two_threads(2, [&](size_t half) {
    for_each_of_half(codes, materials, half, [&](uint64_t, uint32_t m) { ++places[half][m]; });
  });
  const std::vector<uint64_t> in_first_half = places[0];
  for (size_t first = 0; first < count;) {
    SetsPart part{first, end_of_part(materials, first, budget.left() / (2 * sizeof(uint32_t))), {}, {0}};
    for (size_t m = first; m < part.end_material; ++m) {
      places[0][m] = part.begins.back();
      places[1][m] = part.begins.back() + in_first_half[m];
      part.begins.push_back(part.begins.back() + materials.list[m].elements);
    }
    part.ids.resize(part.begins.back());
    const auto in_part = [&](size_t m) { return m >= first && m < part.end_material; };
    on_two_threads(2, [&](size_t half) {
      for_each_of_half(codes, materials, half, [&](uint64_t id, uint32_t m) {
        if (in_part(m)) part.ids[places[half][m]++] = static_cast<uint32_t>(id);
      });
    });
    use(part);
    first = part.end_material;
  }
}

}  // namespace ream::fe
