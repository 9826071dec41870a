#include "collide/contact/contact_kernel.hpp"

#if defined(__x86_64__) && !defined(REAM_NO_AVX512)
#include <immintrin.h>

#include <bit>
#include <cstring>

#include "collide/contact/surface_judge.hpp"

#define REAM_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vnni,bmi2")))

namespace ream::collide {
namespace {

constexpr int lanes = chunk_points;
static_assert(lanes == 16);

/// Multiplies the low 16 bits, signed, of `a` (whose high 16 bits are the second factor pair's) pairwise with
/// those of `b` and adds: exactly what 32-bit products of such numbers give, in one instruction.
REAM_AVX512 inline __m512i pair_products(__m512i a, __m512i b) { return _mm512_madd_epi16(a, b); }

/// Two signed 16-bit factors side by side.
inline int pair(int32_t low, int32_t high) {
  return static_cast<int>((static_cast<uint32_t>(low) & 0xffff) | static_cast<uint32_t>(high) << 16);
}

/// What a look needs of the view in registers.
struct Lens {
  __m512i xy[3], z[3], dims[3], brick_row, brick_slice, brick_steps, bits, fraction_shift;
  __m512i normal_xz[3], normal_y[3];
  bool small_grid;  ///< a layer's bricks can be counted in 15 bits, so brick_steps serves
};

REAM_AVX512 inline Lens lens_of(const ContactView& view) {
  Lens l;
  for (size_t i = 0; i < 3; ++i) {
    l.xy[i] = _mm512_set1_epi32(pair(view.per_unit[3 * i], view.per_unit[3 * i + 1]));
    l.z[i] = _mm512_set1_epi32(pair(view.per_unit[3 * i + 2], 0));
    const int32_t* rotation = view.normal_rotation.data() + 3 * i;
    l.normal_xz[i] = _mm512_set1_epi32(pair(rotation[0], rotation[2]));
    l.normal_y[i] = _mm512_set1_epi32(pair(rotation[1], 0));
    l.dims[i] = _mm512_set1_epi32(view.dims[i]);
  }
  l.brick_row = _mm512_set1_epi32(view.brick_row);
  l.brick_slice = _mm512_set1_epi32(view.brick_slice);
  l.brick_steps = _mm512_set1_epi32(pair(view.brick_row, view.brick_slice));
  l.small_grid = view.brick_slice <= INT16_MAX;
  l.bits = _mm512_set1_epi32(view.bits);
  l.fraction_shift = _mm512_set1_epi32(view.bits - judge_fraction_bits);
  return l;
}

/// In 2^-bits voxel.
REAM_AVX512 inline __m512i coordinate(const Lens& l, size_t i, __m512i xy, __m512i z, int32_t base) {
  return _mm512_add_epi32(_mm512_add_epi32(pair_products(xy, l.xy[i]), pair_products(z, l.z[i])),
                          _mm512_set1_epi32(base));
}

REAM_AVX512 inline __m512i low_bits(__m512i value, int mask) {
  return _mm512_and_si512(value, _mm512_set1_epi32(mask));
}

/// a | (b & mask), in one instruction.
REAM_AVX512 inline __m512i or_bits(__m512i a, __m512i b, int mask) {
  return _mm512_ternarylogic_epi32(a, b, _mm512_set1_epi32(mask), 0xf8);
}

/// Bytes at `index` for the lanes of `mask`, 0 elsewhere; reads whole words, so never past an array whose
/// size is a multiple of four.
REAM_AVX512 inline __m512i gather_bytes(__mmask16 mask, __m512i index, const uint8_t* bytes) {
  const __m512i words =
      _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), mask, _mm512_srli_epi32(index, 2), bytes, 4);
  const __m512i shift = _mm512_slli_epi32(low_bits(index, 3), 3);
  return low_bits(_mm512_srlv_epi32(words, shift), 0xff);
}

/// Voxels of sixteen probes.
struct Voxels {
  __m512i u, v, w;
};

/// Moves to the voxels that decide and gives their least coverages that engage: twin of surface_judge.hpp.
/// `places` are in 2^-bits voxel.
REAM_AVX512 inline __m512i move_to_ramp(const Lens& l, __m512i normals, const __m512i places[3],
                                        Voxels& voxels) {
  // Bytes x y z and the weight, as signed pairs (x, z) and (y, weight); normal_y takes the weight times 0.
  const __m512i xz = _mm512_srai_epi16(_mm512_slli_epi16(normals, 8), 8), y = _mm512_srai_epi16(normals, 8);
  const __m512i zero = _mm512_setzero_si512(), one = _mm512_set1_epi32(1), full = _mm512_set1_epi32(255);
  const __m512i half = _mm512_set1_epi32(1 << (judge_rotation_bits - 1));
  __m512i n[3], length[3], along = _mm512_set1_epi32(128), projected = half;
  for (size_t i = 0; i < 3; ++i) {
    n[i] = _mm512_srai_epi32(
        _mm512_dpwssd_epi32(_mm512_dpwssd_epi32(half, xz, l.normal_xz[i]), y, l.normal_y[i]),
        judge_rotation_bits);
    length[i] = _mm512_abs_epi32(n[i]);
    along = _mm512_add_epi32(along, n[i]);
    const __m512i fraction =
        low_bits(_mm512_srlv_epi32(places[i], l.fraction_shift), (1 << judge_fraction_bits) - 1);
    projected = _mm512_dpwssd_epi32(projected, n[i], fraction);
  }
  __m512i level = _mm512_sub_epi32(along, _mm512_srai_epi32(projected, judge_rotation_bits));
  const __m512i longest = _mm512_max_epi32(_mm512_max_epi32(length[0], length[1]), length[2]);
  const __m512i step = _mm512_slli_epi32(longest, 1);
  const __mmask16 out = _mm512_cmplt_epi32_mask(level, one);
  const __mmask16 in =
      _mm512_mask_cmpge_epi32_mask(_mm512_cmpgt_epi32_mask(level, full), _mm512_sub_epi32(level, step), one);
  level = _mm512_mask_add_epi32(level, out, level, step);
  level = _mm512_mask_sub_epi32(level, in, level, step);
  __mmask16 left = out | in;
  __m512i* const coordinates[3] = {&voxels.u, &voxels.v, &voxels.w};
  for (size_t i = 0; i < 3; ++i) {
    const __mmask16 here = _mm512_mask_cmpeq_epi32_mask(left, length[i], longest);
    left &= static_cast<__mmask16>(~here);
    const __mmask16 negative = _mm512_cmplt_epi32_mask(n[i], zero);
    const auto up = static_cast<__mmask16>(here & (out ^ negative));
    const auto down = static_cast<__mmask16>(here & ~(out ^ negative));
    *coordinates[i] = _mm512_mask_add_epi32(*coordinates[i], up, *coordinates[i], one);
    *coordinates[i] = _mm512_mask_sub_epi32(*coordinates[i], down, *coordinates[i], one);
  }
  const __m512i tolerance = _mm512_set1_epi32(judge_tolerance_levels);
  return _mm512_max_epi32(_mm512_sub_epi32(_mm512_min_epi32(level, full), tolerance), one);
}

/// Voxels that decide about sixteen probes, their cells' words, and where the cells' bits lie in them.
struct Probed {
  __m512i u, v, w, brick, words, cell;

  REAM_AVX512 __m512i voxel() const {
    const __m512i of_row = or_bits(_mm512_slli_epi32(brick, 9), u, 7);
    const __m512i of_layer = or_bits(of_row, _mm512_slli_epi32(v, 3), 7 << 3);
    return or_bits(of_layer, _mm512_slli_epi32(w, 6), 7 << 6);
  }
};

REAM_AVX512 inline __m512i brick_of(const Lens& l, __m512i u, __m512i v, __m512i w) {
  const __m512i x = _mm512_srli_epi32(u, 3), y = _mm512_srli_epi32(v, 3);
  if (l.small_grid) {
    const __m512i yz = or_bits(y, _mm512_slli_epi32(w, 16 - 3), static_cast<int>(0xffff0000u));
    return _mm512_add_epi32(x, pair_products(yz, l.brick_steps));
  }
  return _mm512_add_epi32(x, _mm512_add_epi32(_mm512_mullo_epi32(y, l.brick_row),
                                              _mm512_mullo_epi32(_mm512_srli_epi32(w, 3), l.brick_slice)));
}

/// Normals of points that look at the voxel that they lie in, whatever its level.
alignas(64) constexpr uint32_t no_normals[lanes] = {};

/// `normals` are the chunk's; `needed` takes the least coverages that engage.
REAM_AVX512 inline Probed probe(const uint32_t* places, const uint32_t* normals, const uint16_t* cells,
                                const Lens& l, const DueChunk& chunk, __m512i& needed) {
  const auto present = static_cast<__mmask16>((1u << chunk.count) - 1);
  const __m512i place = _mm512_loadu_si512(places + chunk.first);
  const __m512i xy = or_bits(low_bits(place, place_mask), _mm512_slli_epi32(place, 16 - place_bits),
                             static_cast<int>(place_mask << 16));
  const __m512i z = low_bits(_mm512_srli_epi32(place, 2 * place_bits), place_mask);
  const __m512i at[3] = {coordinate(l, 0, xy, z, chunk.base[0]), coordinate(l, 1, xy, z, chunk.base[1]),
                         coordinate(l, 2, xy, z, chunk.base[2])};
  Voxels voxels{_mm512_srav_epi32(at[0], l.bits), _mm512_srav_epi32(at[1], l.bits),
                _mm512_srav_epi32(at[2], l.bits)};
  needed = move_to_ramp(l, _mm512_loadu_si512(normals), at, voxels);
  Probed p;
  p.u = voxels.u;
  p.v = voxels.v;
  p.w = voxels.w;
  __mmask16 inside = _mm512_mask_cmplt_epu32_mask(present, p.u, l.dims[0]);
  inside = _mm512_mask_cmplt_epu32_mask(inside, p.v, l.dims[1]);
  inside = _mm512_mask_cmplt_epu32_mask(inside, p.w, l.dims[2]);
  p.brick = brick_of(l, p.u, p.v, p.w);
  const __m512i low_cell = low_bits(_mm512_srli_epi32(p.u, 2), 1);
  p.cell = or_bits(or_bits(low_cell, _mm512_srli_epi32(p.v, 1), 2), p.w, 4);
  p.words = _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), inside, p.brick, cells, 2);
  return p;
}

/// Points that lie in wholly full cells, and those whose voxel decides.
struct Decided {
  __mmask16 full, unsure;
};

REAM_AVX512 inline Decided decided(const Probed& p) {
  const __m512i state = _mm512_srlv_epi32(p.words, p.cell);
  const __mmask16 some = _mm512_test_epi32_mask(state, _mm512_set1_epi32(1));
  const __mmask16 all = _mm512_test_epi32_mask(state, _mm512_set1_epi32(0x100));
  return {all, static_cast<__mmask16>(some & ~all)};
}

/// True when any of the probes meets something of the size that the clearance is about.
REAM_AVX512 inline bool meets(const Probed& p, Clearance clearance) {
  if (clearance == Clearance::brick) return _mm512_test_epi32_mask(p.words, _mm512_set1_epi32(0xff)) != 0;
  const Decided d = decided(p);
  return (d.full | d.unsure) != 0;
}

REAM_AVX512 bool is_clear(const ContactView& view, const DueChunk& chunk, Clearance clearance) noexcept {
  const Lens lens = lens_of(view);
  for (int corner = 0; corner < 8; ++corner) {
    const DueChunk moved = shifted(view, chunk, clearance, corner);
    __m512i needed;
    if (meets(probe(view.places, no_normals, view.cells, lens, moved, needed), clearance)) return false;
  }
  return true;
}

/// Chunks are worked on together, one question at a time, so that no branch waits for an answer from memory.
constexpr size_t batch_chunks = 512;
constexpr size_t batch_points = batch_chunks * lanes;

/// A list of numbers that vectors append to; room for one vector too many.
struct List {
  alignas(64) uint32_t items[batch_points + lanes];
  size_t count = 0;

  REAM_AVX512 void append(__mmask16 mask, __m512i values) {
    _mm512_storeu_si512(items + count, _mm512_maskz_compress_epi32(mask, values));
    count += static_cast<size_t>(std::popcount(static_cast<unsigned>(mask)));
  }
  /// Lanes of the vector at `i` that hold items.
  __mmask16 present(size_t i) const {
    return static_cast<__mmask16>(count - i >= lanes ? 0xffff : (1u << (count - i)) - 1);
  }
};

/// What is known of a batch of chunks, step by step.
struct Batch {
  alignas(64) int32_t voxel[batch_points];
  __mmask16 engaged[batch_chunks], unsure[batch_chunks];
  List unsure_voxels, needed;  ///< and the coverages that they need to engage
  /// One bit for each unsure voxel, in order: it engages. Padded, as eight bytes are read at once.
  uint16_t answers[batch_chunks + 4];
  List densities, weights;  ///< voxels of engaged cutting points, and their weights
  List directions[2];       ///< of engaged points of blocks that are not wholly engaged: cutting, guiding
};

REAM_AVX512 void find_voxels(const ContactView& view, std::span<const DueChunk> chunks, Batch& batch) {
  batch.unsure_voxels.count = batch.needed.count = 0;
  // Copies, so that the compiler knows that stores do not change them.
  const Lens lens = lens_of(view);
  const uint32_t* const places = view.places;
  const uint32_t* const normals = view.normals;
  const uint16_t* const cells = view.cells;
  for (size_t i = 0; i < chunks.size(); ++i) {
    __m512i needed;
    const Probed p = probe(places, normals + chunks[i].first, cells, lens, chunks[i], needed);
    const Decided d = decided(p);
    const __m512i voxel = p.voxel();
    _mm512_store_si512(batch.voxel + i * lanes, voxel);
    batch.engaged[i] = d.full;
    batch.unsure[i] = d.unsure;
    batch.unsure_voxels.append(d.unsure, voxel);
    batch.needed.append(d.unsure, needed);
  }
}

REAM_AVX512 void ask_voxels(const ContactView& view, Batch& batch) {
  const List& list = batch.unsure_voxels;
  for (size_t i = 0; i < list.count; i += lanes) {
    const __m512i coverage = gather_bytes(list.present(i), _mm512_load_si512(list.items + i), view.coverage);
    batch.answers[i / lanes] = _mm512_cmpge_epi32_mask(coverage, _mm512_load_si512(batch.needed.items + i));
  }
}

REAM_AVX512 void take_answers(std::span<const DueChunk> chunks, Batch& batch, uint8_t* touched) {
  size_t bit = 0;
  for (size_t i = 0; i < chunks.size(); ++i) {
    uint32_t answers;
    std::memcpy(&answers, reinterpret_cast<const uint8_t*>(batch.answers) + bit / 8, sizeof answers);
    const uint32_t unsure = batch.unsure[i];
    batch.engaged[i] |= static_cast<__mmask16>(_pdep_u32(answers >> (bit % 8), unsure));
    touched[i] = batch.engaged[i] != 0;
    bit += static_cast<size_t>(std::popcount(unsure));
  }
}

REAM_AVX512 inline __m512i direction_codes(const ContactView& view, const DueChunk& chunk) {
  const __m512i place = _mm512_loadu_si512(view.places + chunk.first);
  const __m512i low = _mm512_cvtepu16_epi32(
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(view.directions + chunk.first)));
  return _mm512_or_si512(low, _mm512_slli_epi32(_mm512_srli_epi32(place, 27), 16));
}

/// The engaged point of the greatest height of a chunk, if it is deeper than what was found before.
REAM_AVX512 inline void find_deepest(const ContactView& view, const ContactBlock& block,
                                     const DueChunk& chunk, __mmask16 engaged, ContactSums& sums) {
  const __m512i place = _mm512_loadu_si512(view.places + chunk.first);
  const __m512i height = low_bits(_mm512_srli_epi32(place, 2 * place_bits), place_mask);
  const int32_t best = _mm512_mask_reduce_max_epi32(engaged, height);
  const __mmask16 highest = _mm512_mask_cmpeq_epi32_mask(engaged, height, _mm512_set1_epi32(best));
  const auto lane = static_cast<uint32_t>(std::countr_zero(static_cast<unsigned>(highest)));
  const int64_t key = ContactSums::depth_key(block.origin_units.z() + best, chunk.first + lane);
  sums.deepest = key > sums.deepest ? key : sums.deepest;
}

/// Lists what the engaged points of one block's chunks `first` to `end` add.
REAM_AVX512 void list_block(const ContactView& view, std::span<const DueChunk> chunks, size_t first,
                            size_t end, Batch& batch, ContactSums& sums) {
  const ContactBlock& block = view.blocks[chunks[first].block];
  uint32_t total = 0;
  for (size_t i = first; i < end; ++i)
    total += static_cast<uint32_t>(std::popcount(static_cast<unsigned>(batch.engaged[i])));
  if (total == 0) return;
  ContactSums::Part& part = block.guiding ? sums.guiding : sums.cutting;
  const bool whole = total == block.count;
  if (whole)
    add_products_to(part, block.whole, total);
  else
    part.points += total;
  const bool maybe_deepest =
      !block.guiding && (sums.deepest == ContactSums::no_point ||
                         block.origin_units.z() + block.height_units > sums.deepest_height_units());
  List& directions = batch.directions[block.guiding];
  for (size_t i = first; i < end; ++i) {
    const __mmask16 engaged = batch.engaged[i];
    if (!block.guiding) {
      batch.densities.append(engaged, _mm512_load_si512(batch.voxel + i * lanes));
      batch.weights.append(engaged,
                           _mm512_srli_epi32(_mm512_loadu_si512(view.normals + chunks[i].first), 24));
    }
    if (!whole) directions.append(engaged, direction_codes(view, chunks[i]));
    if (maybe_deepest && engaged != 0) find_deepest(view, block, chunks[i], engaged, sums);
  }
}

REAM_AVX512 inline int64_t sum_of_lanes(__m512i lanes_32) {
  const __m512i low = _mm512_cvtepi32_epi64(_mm512_castsi512_si256(lanes_32)),
                high = _mm512_cvtepi32_epi64(_mm512_extracti64x4_epi64(lanes_32, 1));
  return _mm512_reduce_add_epi64(_mm512_add_epi64(low, high));
}

REAM_AVX512 void add_densities(const ContactView& view, const List& voxels, const List& weights,
                               ContactSums& sums) {
  const __m512i zero = _mm512_setzero_si512();
  __m512i all = zero, density = zero, cortical_all = zero, cortical_density = zero, cartilage_all = zero,
          resistance = zero;
  for (size_t i = 0; i < voxels.count; i += lanes) {
    const __mmask16 present = voxels.present(i);
    const __m512i code = gather_bytes(present, _mm512_load_si512(voxels.items + i), view.density);
    const __mmask16 cartilage =
        _mm512_mask_cmpeq_epi32_mask(present, code, _mm512_set1_epi32(voxel::cartilage_code));
    const __mmask16 cortical =
        _mm512_mask_cmpge_epi32_mask(present, code, _mm512_set1_epi32(view.first_cortical_code)) & ~cartilage;
    const __m512i weight = _mm512_maskz_load_epi32(present, weights.items + i);
    const __m512i weighted = pair_products(weight, code);
    const __m512i resists = _mm512_mask_i32gather_epi32(zero, present, code, view.resistances, 4);
    all = _mm512_add_epi32(all, weight);
    density = _mm512_add_epi32(density, weighted);
    resistance = _mm512_dpwssd_epi32(resistance, weight, resists);
    cortical_all = _mm512_mask_add_epi32(cortical_all, cortical, cortical_all, weight);
    cortical_density = _mm512_mask_add_epi32(cortical_density, cortical, cortical_density, weighted);
    cartilage_all = _mm512_mask_add_epi32(cartilage_all, cartilage, cartilage_all, weight);
  }
  const auto cortical = static_cast<size_t>(voxel::BoneClass::cortical),
             cancellous = static_cast<size_t>(voxel::BoneClass::cancellous),
             cartilage = static_cast<size_t>(voxel::BoneClass::cartilage);
  const int64_t cortical_weight = _mm512_reduce_add_epi32(cortical_all),
                cartilage_weight = _mm512_reduce_add_epi32(cartilage_all),
                cortical_sum = _mm512_reduce_add_epi32(cortical_density),
                cartilage_sum = cartilage_weight * voxel::cartilage_code;
  sums.class_weight[cortical] += cortical_weight;
  sums.class_weight[cartilage] += cartilage_weight;
  sums.class_weight[cancellous] += _mm512_reduce_add_epi32(all) - cortical_weight - cartilage_weight;
  sums.class_density[cortical] += cortical_sum;
  sums.class_density[cartilage] += cartilage_sum;
  sums.class_density[cancellous] += _mm512_reduce_add_epi32(density) - cortical_sum - cartilage_sum;
  sums.resistance += sum_of_lanes(resistance);
}

/// Direction tables looked up and turned: the vectors of sixteen points; weight 0 where none is.
struct Vectors {
  __m512i g[5], cosine, sine, weight, area;
};

REAM_AVX512 inline __m512i low_signed(__m512i bytes, unsigned shift_left) {
  return _mm512_srai_epi32(_mm512_slli_epi32(bytes, shift_left), 24);
}

REAM_AVX512 inline __m512i turned(__m512i factor, __m512i low_factor) {
  const __m512i half = _mm512_set1_epi32(1 << (azimuth_shift - 1));
  return _mm512_srai_epi32(_mm512_add_epi32(pair_products(low_bits(factor, 0xffff), low_factor), half),
                           azimuth_shift);
}

REAM_AVX512 inline Vectors vectors_at(const ContactView& view, const List& directions, size_t i) {
  const __mmask16 present = i < directions.count ? directions.present(i) : __mmask16{0};
  const __m512i direction = _mm512_load_si512(directions.items + i), zero = _mm512_setzero_si512();
  const __m512i entry = _mm512_mask_i32gather_epi32(zero, present, _mm512_srli_epi32(direction, azimuth_bits),
                                                    view.table->meridian.data(), 4);
  const __m512i angle = _mm512_mask_i32gather_epi32(
      zero, present, low_bits(direction, static_cast<int>(azimuth_count - 1)), view.table->azimuth.data(), 4);
  const __m512i radial = low_signed(entry, 24), arm = low_signed(entry, 8);
  const __m512i sine = _mm512_srli_epi32(angle, 16), one = _mm512_set1_epi32(127);
  const __m512i area = _mm512_mask_i32gather_epi32(zero, present, _mm512_srli_epi32(direction, azimuth_bits),
                                                   view.table->areas.data(), 4);
  return {{turned(radial, angle), turned(radial, sine), low_signed(entry, 16), turned(arm, sine),
           turned(_mm512_sub_epi32(zero, arm), angle)},
          turned(one, angle),
          turned(one, sine),
          _mm512_srli_epi32(entry, 24),
          area};
}

/// Products of all listed points, 32 at a time in halves of 32 bits. Each lane takes two of every 32 points,
/// of a batch 512 at most, and stays below 2^31 with weights of a byte.
REAM_AVX512 void add_products_of(const ContactView& view, const List& directions, ContactSums::Part& part) {
  if (directions.count == 0) return;
  __m512i sums[std::tuple_size_v<ContactProducts>];
  for (auto& sum : sums) sum = _mm512_setzero_si512();
  const __m512i ones = _mm512_set1_epi16(1);
  for (size_t i = 0; i < directions.count; i += 2 * lanes) {
    const Vectors a = vectors_at(view, directions, i), b = vectors_at(view, directions, i + lanes);
    const __m512i weight = _mm512_packs_epi32(a.weight, b.weight);
    __m512i g[5], weighted[5];
    for (size_t k = 0; k < 5; ++k) {
      g[k] = _mm512_packs_epi32(a.g[k], b.g[k]);
      weighted[k] = _mm512_mullo_epi16(weight, g[k]);
    }
    size_t slot = 0;
    for (size_t m = 0; m < 5; ++m)
      for (size_t n = m; n < 5; ++n, ++slot) sums[slot] = _mm512_dpwssd_epi32(sums[slot], weighted[m], g[n]);
    for (size_t m = 0; m < 5; ++m, ++slot) sums[slot] = _mm512_dpwssd_epi32(sums[slot], weighted[m], ones);
    for (const __m512i factor :
         {_mm512_packs_epi32(a.cosine, b.cosine), _mm512_packs_epi32(a.sine, b.sine), ones})
      sums[slot] = _mm512_dpwssd_epi32(sums[slot], weight, factor), ++slot;
    sums[slot] = _mm512_add_epi32(sums[slot], _mm512_add_epi32(a.area, b.area));
  }
  std::array<int64_t, std::tuple_size_v<ContactProducts>> products;
  for (size_t k = 0; k < products.size(); ++k) products[k] = sum_of_lanes(sums[k]);
  add_products_to(part, products, 0);
}

/// As many chunks as fit a batch, cut between blocks.
size_t batch_end(std::span<const DueChunk> chunks, size_t first) {
  size_t end = std::min(chunks.size(), first + batch_chunks);
  if (end == chunks.size()) return end;
  while (chunks[end].block == chunks[end - 1].block) --end;
  return end;
}

REAM_AVX512 void look(const ContactView& view, std::span<const DueChunk> all, uint8_t* touched,
                      ContactSums& sums) noexcept {
  Batch batch;
  for (size_t start = 0, stop = 0; start < all.size(); start = stop) {
    stop = batch_end(all, start);
    const auto chunks = all.subspan(start, stop - start);
    find_voxels(view, chunks, batch);
    ask_voxels(view, batch);
    take_answers(chunks, batch, touched + start);
    batch.densities.count = batch.weights.count = batch.directions[0].count = batch.directions[1].count = 0;
    for (size_t first = 0, end = 0; first < chunks.size(); first = end) {
      while (end < chunks.size() && chunks[end].block == chunks[first].block) ++end;
      list_block(view, chunks, first, end, batch, sums);
    }
    add_densities(view, batch.densities, batch.weights, sums);
    add_products_of(view, batch.directions[0], sums.cutting);
    add_products_of(view, batch.directions[1], sums.guiding);
  }
}

}  // namespace

ContactKernels avx512_contact_kernels() noexcept {
  __builtin_cpu_init();
  const bool usable = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512vnni") && __builtin_cpu_supports("bmi2");
  return usable ? ContactKernels{look, is_clear} : ContactKernels{};
}

}  // namespace ream::collide

#else

namespace ream::collide {
ContactKernels avx512_contact_kernels() noexcept { return {}; }
}  // namespace ream::collide

#endif
