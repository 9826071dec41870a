#include "collide/contact_blocks.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

constexpr uint32_t some_bit = 0x1, all_bit = 0x100;

/// Per point of a block: the voxel its probe lies in, and what its cell says: all_bit and some_bit in solid
/// bone, some_bit where the voxel decides, 0 in the air and outside the grid.
struct Probed {
  int32_t voxel[most_block_points];
  int32_t state[most_block_points];
};

/// Straight-line arithmetic, so that it vectorizes.
REAM_VECTOR_CLONES void probe(const ContactView& view, const uint32_t* __restrict places, int n,
                              const std::array<int32_t, 3>& base, Probed& shared_probed) {
  const auto m = view.per_unit;
  const int bits = view.bits;
  const auto dx = static_cast<uint32_t>(view.dims[0]), dy = static_cast<uint32_t>(view.dims[1]),
             dz = static_cast<uint32_t>(view.dims[2]);
  const int brick_row = view.brick_row, brick_slice = view.brick_slice;
  const uint16_t* __restrict cells = view.cells;
  int32_t* __restrict voxel = shared_probed.voxel;
  int32_t* __restrict state = shared_probed.state;
  for (int i = 0; i < n; ++i) {
    const auto x = static_cast<int32_t>(places[i] & place_mask),
               y = static_cast<int32_t>(places[i] >> place_bits & place_mask),
               z = static_cast<int32_t>(places[i] >> (2 * place_bits) & place_mask);
    const int32_t u = (m[0] * x + m[1] * y + m[2] * z + base[0]) >> bits;
    const int32_t v = (m[3] * x + m[4] * y + m[5] * z + base[1]) >> bits;
    const int32_t w = (m[6] * x + m[7] * y + m[8] * z + base[2]) >> bits;
    // Outside points look at voxel 0 and are dropped by the mask.
    const int32_t inside = (static_cast<uint32_t>(u) < dx ? -1 : 0) &
                           (static_cast<uint32_t>(v) < dy ? -1 : 0) &
                           (static_cast<uint32_t>(w) < dz ? -1 : 0);
    const int32_t brick = ((u >> 3) + (v >> 3) * brick_row + (w >> 3) * brick_slice) & inside;
    const int32_t cell = ((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4);
    voxel[i] = (brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6;
    state[i] = (cells[brick] >> cell) & inside & static_cast<int32_t>(some_bit | all_bit);
  }
}

/// Numbers of the engaged points within the block.
size_t find_engaged(const ContactView& view, const Probed& probed, size_t n, uint16_t* engaged) {
  size_t count = 0;
  for (size_t i = 0; i < n; ++i) {
    const int32_t state = probed.state[i];
    if (state == 0) continue;
    if (state == static_cast<int32_t>(some_bit) && view.coverage[probed.voxel[i]] < voxel::solid_coverage)
      continue;
    engaged[count++] = static_cast<uint16_t>(i);
  }
  return count;
}

void add_densities(const ContactView& view, const Probed& probed, const uint16_t* engaged, size_t count,
                   ContactSums& sums) {
  for (size_t i = 0; i < count; ++i) {
    const int32_t code = view.density[probed.voxel[engaged[i]]];
    const auto bone_class =
        static_cast<size_t>(code == voxel::cartilage_code      ? voxel::BoneClass::cartilage
                            : code >= view.first_cortical_code ? voxel::BoneClass::cortical
                                                               : voxel::BoneClass::cancellous);
    ++sums.class_points[bone_class];
    sums.class_density[bone_class] += code;
  }
}

void find_deepest(const ContactView& view, const ContactBlock& block, const uint16_t* engaged, size_t count,
                  ContactSums& sums) {
  for (size_t i = 0; i < count; ++i) {
    const uint32_t point = block.first + engaged[i];
    const int32_t height =
        block.origin_units.z() + static_cast<int32_t>(view.places[point] >> (2 * place_bits) & place_mask);
    const int64_t key = ContactSums::depth_key(height, point);
    sums.deepest = key > sums.deepest ? key : sums.deepest;
  }
}

}  // namespace

void add_block_portable(const ContactView& view, const SurvivingBlock& at, ContactSums& sums) noexcept {
  const ContactBlock& block = view.blocks[at.block];
  const size_t n = block.count;
  Probed probed;
  probe(view, view.places + block.first, static_cast<int>(n), at.base, probed);
  uint16_t engaged[most_block_points];
  const size_t count = find_engaged(view, probed, n, engaged);
  if (count == 0) return;

  ContactSums::Part& part = block.guiding ? sums.guiding : sums.cutting;
  if (count == n) {
    add_products_to(part, block.whole, static_cast<int64_t>(n));
  } else {
    ContactProducts products{};
    for (size_t i = 0; i < count; ++i) {
      const size_t point = block.first + engaged[i];
      add_products(view.table->vector(view.directions[point] | (view.places[point] >> 27) << 16), products);
    }
    add_products_to(part, products, static_cast<int64_t>(count));
  }
  if (block.guiding) return;
  add_densities(view, probed, engaged, count, sums);
  find_deepest(view, block, engaged, count, sums);
}

}  // namespace ream::collide
