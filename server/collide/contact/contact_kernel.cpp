#include "collide/contact/contact_kernel.hpp"

#include "collide/contact/surface_judge.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

constexpr int32_t some_bit = 0x1, all_bit = 0x100, any_cell = 0xff;

/// Per point of a chunk: the voxel that decides, its least coverage that engages, what its cell says (all_bit
/// and some_bit in full bone, some_bit where the voxel decides, 0 in the air and outside the grid), and
/// whether its brick has bone.
struct Probed {
  alignas(64) int32_t voxel[chunk_points];
  alignas(64) int32_t needed[chunk_points];
  alignas(64) int32_t state[chunk_points];
  alignas(64) int32_t in_brick[chunk_points];
};

/// Normals of points that look at the voxel that they lie in, whatever its level.
constexpr uint32_t no_normals[chunk_points] = {};

constexpr int32_t signed_byte(uint32_t word, int index) {
  return static_cast<int32_t>(static_cast<int8_t>(word >> (8 * index)));
}

/// Straight-line arithmetic, so that it vectorizes. Reads whole chunks: places and normals are padded.
REAM_VECTOR_CLONES void probe(const ContactView& view, const DueChunk& chunk,
                              const uint32_t* __restrict normals, Probed& shared_probed) {
  const uint32_t* __restrict places = view.places + chunk.first;
  const auto m = view.per_unit;
  const auto rotation = view.normal_rotation;
  const auto base = chunk.base;
  const auto count = static_cast<int>(chunk.count);
  const int bits = view.bits, fraction_shift = bits - judge_fraction_bits;
  constexpr int32_t fraction_mask = (1 << judge_fraction_bits) - 1;
  const auto dx = static_cast<uint32_t>(view.dims[0]), dy = static_cast<uint32_t>(view.dims[1]),
             dz = static_cast<uint32_t>(view.dims[2]);
  const int brick_row = view.brick_row, brick_slice = view.brick_slice;
  const uint16_t* __restrict cells = view.cells;
  int32_t* __restrict voxel = shared_probed.voxel;
  int32_t* __restrict needed = shared_probed.needed;
  int32_t* __restrict state = shared_probed.state;
  int32_t* __restrict in_brick = shared_probed.in_brick;
  for (int i = 0; i < chunk_points; ++i) {
    const auto x = static_cast<int32_t>(places[i] & place_mask),
               y = static_cast<int32_t>(places[i] >> place_bits & place_mask),
               z = static_cast<int32_t>(places[i] >> (2 * place_bits) & place_mask);
    const int32_t at_u = m[0] * x + m[1] * y + m[2] * z + base[0];
    const int32_t at_v = m[3] * x + m[4] * y + m[5] * z + base[1];
    const int32_t at_w = m[6] * x + m[7] * y + m[8] * z + base[2];
    ColumnLevel column = column_level(
        rotation, {signed_byte(normals[i], 0), signed_byte(normals[i], 1), signed_byte(normals[i], 2)},
        {(at_u >> fraction_shift) & fraction_mask, (at_v >> fraction_shift) & fraction_mask,
         (at_w >> fraction_shift) & fraction_mask});
    const int32_t moves = moves_to_ramp(column);
    needed[i] = needed_coverage(column.level);
    const int32_t u = (at_u >> bits) + (column.axis == 0 ? moves : 0);
    const int32_t v = (at_v >> bits) + (column.axis == 1 ? moves : 0);
    const int32_t w = (at_w >> bits) + (column.axis == 2 ? moves : 0);
    // Outside points look at voxel 0 and are dropped by the mask.
    const int32_t inside = (static_cast<uint32_t>(u) < dx ? -1 : 0) &
                           (static_cast<uint32_t>(v) < dy ? -1 : 0) &
                           (static_cast<uint32_t>(w) < dz ? -1 : 0) & (i < count ? -1 : 0);
    const int32_t brick = ((u >> 3) + (v >> 3) * brick_row + (w >> 3) * brick_slice) & inside;
    const int32_t cell = ((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4);
    const int32_t word = cells[brick] & inside;
    voxel[i] = (brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6;
    state[i] = (word >> cell) & (some_bit | all_bit);
    in_brick[i] = word & any_cell;
  }
}

/// Bit i: point i is engaged.
uint32_t engaged_points(const ContactView& view, const Probed& probed) {
  uint32_t engaged = 0;
  for (uint32_t i = 0; i < chunk_points; ++i) {
    const int32_t state = probed.state[i];
    if (state == 0) continue;
    const bool meets = state != some_bit || view.coverage[probed.voxel[i]] >= probed.needed[i];
    engaged |= static_cast<uint32_t>(meets) << i;
  }
  return engaged;
}

void add_densities(const ContactView& view, const Probed& probed, uint32_t first, uint32_t engaged,
                   ContactSums& sums) {
  for (uint32_t i = 0; i < chunk_points; ++i) {
    if (!(engaged >> i & 1)) continue;
    const int32_t code = view.density[probed.voxel[i]];
    const auto weight = static_cast<int32_t>(view.normals[first + i] >> 24);
    const auto bone_class =
        static_cast<size_t>(code == voxel::cartilage_code      ? voxel::BoneClass::cartilage
                            : code >= view.first_cortical_code ? voxel::BoneClass::cortical
                                                               : voxel::BoneClass::cancellous);
    sums.class_weight[bone_class] += weight;
    sums.class_density[bone_class] += weight * code;
    sums.resistance += weight * static_cast<int32_t>(view.resistances[code]);
  }
}

void find_deepest(const ContactView& view, const DueChunk& chunk, uint32_t engaged, ContactSums& sums) {
  const int32_t origin = view.blocks[chunk.block].origin_units.z();
  for (uint32_t i = 0; i < chunk_points; ++i) {
    if (!(engaged >> i & 1)) continue;
    const uint32_t point = chunk.first + i;
    const int32_t height = origin + static_cast<int32_t>(view.places[point] >> (2 * place_bits) & place_mask);
    const int64_t key = ContactSums::depth_key(height, point);
    sums.deepest = key > sums.deepest ? key : sums.deepest;
  }
}

void add_chunk_products(const ContactView& view, const DueChunk& chunk, uint32_t engaged,
                        ContactProducts& products) {
  for (uint32_t i = 0; i < chunk_points; ++i) {
    if (!(engaged >> i & 1)) continue;
    const size_t point = chunk.first + i;
    add_products(view.table->vector(view.directions[point] | (view.places[point] >> 27) << 16), products);
  }
}

/// The due chunks of one block.
void look_at_block(const ContactView& view, std::span<const DueChunk> chunks, uint8_t* touched,
                   ContactSums& sums) {
  const ContactBlock& block = view.blocks[chunks[0].block];
  uint32_t engaged[max_block_chunks];
  uint32_t total = 0;
  for (size_t i = 0; i < chunks.size(); ++i) {
    Probed probed;
    probe(view, chunks[i], view.normals + chunks[i].first, probed);
    engaged[i] = engaged_points(view, probed);
    touched[i] = engaged[i] != 0;
    total += static_cast<uint32_t>(__builtin_popcount(engaged[i]));
    if (engaged[i] == 0 || block.guiding) continue;
    add_densities(view, probed, chunks[i].first, engaged[i], sums);
    find_deepest(view, chunks[i], engaged[i], sums);
  }
  if (total == 0) return;
  ContactSums::Part& part = block.guiding ? sums.guiding : sums.cutting;
  if (total == block.count) return add_products_to(part, block.whole, total);
  ContactProducts products{};
  for (size_t i = 0; i < chunks.size(); ++i)
    if (engaged[i] != 0) add_chunk_products(view, chunks[i], engaged[i], products);
  add_products_to(part, products, total);
}

void look(const ContactView& view, std::span<const DueChunk> chunks, uint8_t* touched,
          ContactSums& sums) noexcept {
  for (size_t first = 0, end = 0; first < chunks.size(); first = end) {
    while (end < chunks.size() && chunks[end].block == chunks[first].block) ++end;
    look_at_block(view, chunks.subspan(first, end - first), touched + first, sums);
  }
}

bool meets(const Probed& probed, Clearance clearance) {
  int32_t any = 0;
  for (size_t i = 0; i < chunk_points; ++i)
    any |= clearance == Clearance::brick ? probed.in_brick[i] : probed.state[i];
  return any != 0;
}

bool is_clear(const ContactView& view, const DueChunk& chunk, Clearance clearance) noexcept {
  for (int corner = 0; corner < 8; ++corner) {
    Probed probed;
    probe(view, shifted(view, chunk, clearance, corner), no_normals, probed);
    if (meets(probed, clearance)) return false;
  }
  return true;
}

}  // namespace

ContactKernels portable_contact_kernels() noexcept { return {look, is_clear}; }

ContactView contact_view(const NarrowPhaseInput& input) noexcept {
  const Vec3i dims = input.bone.grid.dims, bricks = input.bone.grid.brick_dims();
  return {input.shell.places.data(),
          input.shell.directions.data(),
          input.shell.normals.data(),
          input.shell.blocks.data(),
          &input.shell.table,
          input.cells.words().data(),
          input.bone.coverage.data(),
          input.bone.density.data(),
          input.resistances.data(),
          {dims.x(), dims.y(), dims.z()},
          bricks.x(),
          bricks.x() * bricks.y(),
          voxel::first_cortical_code(input.bone.cortical_threshold_g_cc),
          {},
          {},
          0};
}

DueChunk shifted(const ContactView& view, const DueChunk& chunk, Clearance clearance, int corner) noexcept {
  const auto reach = static_cast<int32_t>(cube_reach_voxels(clearance) * static_cast<float>(1 << view.bits));
  DueChunk moved = chunk;
  for (size_t i = 0; i < 3; ++i) moved.base[i] += corner >> i & 1 ? reach : -reach;
  return moved;
}

ContactKernels best_contact_kernels() noexcept {
  const ContactKernels best = avx512_contact_kernels();
  return best.look != nullptr ? best : portable_contact_kernels();
}

}  // namespace ream::collide
