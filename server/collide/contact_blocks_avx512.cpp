#include "collide/contact_blocks.hpp"

#if defined(__x86_64__) && !defined(REAM_NO_AVX512)
#include <immintrin.h>

#include <bit>

#define REAM_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))

namespace ream::collide {
namespace {

constexpr int lanes = 16;

/// What one look at a block's points found: a mask of engaged points for every sixteen.
struct Engaged {
  __mmask16 masks[most_block_points / lanes];
  size_t count = 0;
};

/// Multiplies the low 16 bits, signed, of `a` (whose high 16 bits are the second factor pair's) pairwise with
/// those of `b` and adds: exactly what 32-bit products of such numbers give, in one instruction.
REAM_AVX512 inline __m512i pair_products(__m512i a, __m512i b) { return _mm512_madd_epi16(a, b); }

/// Two signed 16-bit factors side by side.
inline int pair(int32_t low, int32_t high) {
  return static_cast<int>((static_cast<uint32_t>(low) & 0xffff) | static_cast<uint32_t>(high) << 16);
}

/// The numbers of a look at one block, in registers.
struct Axes {
  __m512i xy[3], z[3], base[3];
};

REAM_AVX512 inline Axes axes_of(const ContactView& view, const SurvivingBlock& at) {
  Axes a;
  for (size_t i = 0; i < 3; ++i) {
    a.xy[i] = _mm512_set1_epi32(pair(view.per_unit[3 * i], view.per_unit[3 * i + 1]));
    a.z[i] = _mm512_set1_epi32(pair(view.per_unit[3 * i + 2], 0));
    a.base[i] = _mm512_set1_epi32(at.base[i]);
  }
  return a;
}

REAM_AVX512 inline __m512i coordinate(const Axes& a, size_t i, __m512i xy, __m512i z, __m128i bits) {
  const __m512i sum =
      _mm512_add_epi32(_mm512_add_epi32(pair_products(xy, a.xy[i]), pair_products(z, a.z[i])), a.base[i]);
  return _mm512_sra_epi32(sum, bits);
}

REAM_AVX512 inline __m512i low_bits(__m512i value, int mask) {
  return _mm512_and_si512(value, _mm512_set1_epi32(mask));
}

/// Bytes at `index` for the lanes of `mask`, 0 elsewhere; reads whole words, so never past an array whose
/// size is a multiple of four.
REAM_AVX512 inline __m512i gather_bytes(__mmask16 mask, __m512i index, const uint8_t* bytes) {
  const __m512i words =
      _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), mask, _mm512_srli_epi32(index, 2), bytes, 4);
  const __m512i shift = _mm512_slli_epi32(low_bits(index, 3), 3);
  return low_bits(_mm512_srlv_epi32(words, shift), 0xff);
}

/// Sums of densities by class and the greatest height, lane by lane.
struct CuttingLanes {
  __m512i all, cortical, height;
  int cortical_points, cartilage_points;
};

REAM_AVX512 inline void add_cutting(const ContactView& view, __mmask16 engaged, __m512i voxel, __m512i height,
                                    CuttingLanes& cutting) {
  const __m512i code = gather_bytes(engaged, voxel, view.density);
  const __mmask16 cartilage =
      _mm512_mask_cmpeq_epi32_mask(engaged, code, _mm512_set1_epi32(voxel::cartilage_code));
  const __mmask16 cortical =
      _mm512_mask_cmpge_epi32_mask(engaged, code, _mm512_set1_epi32(view.first_cortical_code)) & ~cartilage;
  cutting.all = _mm512_add_epi32(cutting.all, code);
  cutting.cortical = _mm512_mask_add_epi32(cutting.cortical, cortical, cutting.cortical, code);
  cutting.cortical_points += std::popcount(static_cast<unsigned>(cortical));
  cutting.cartilage_points += std::popcount(static_cast<unsigned>(cartilage));
  cutting.height = _mm512_mask_max_epi32(cutting.height, engaged, cutting.height, height);
}

REAM_AVX512 void look(const ContactView& view, const SurvivingBlock& at, const ContactBlock& block,
                      Engaged& engaged, CuttingLanes& cutting) {
  const Axes axes = axes_of(view, at);
  const __m128i bits = _mm_cvtsi32_si128(view.bits);
  const __m512i dx = _mm512_set1_epi32(view.dims[0]), dy = _mm512_set1_epi32(view.dims[1]),
                dz = _mm512_set1_epi32(view.dims[2]);
  const __m512i brick_row = _mm512_set1_epi32(view.brick_row),
                brick_slice = _mm512_set1_epi32(view.brick_slice);
  for (int i = 0; i < block.count; i += lanes) {
    const int left = block.count - i;
    const auto present = static_cast<__mmask16>(left >= lanes ? 0xffff : (1 << left) - 1);
    const __m512i place = _mm512_maskz_loadu_epi32(present, view.places + block.first + i);
    const __m512i x = low_bits(place, place_mask),
                  y = low_bits(_mm512_slli_epi32(place, 16 - place_bits), static_cast<int>(place_mask << 16)),
                  z = low_bits(_mm512_srli_epi32(place, 2 * place_bits), place_mask);
    const __m512i xy = _mm512_or_si512(x, y);
    const __m512i u = coordinate(axes, 0, xy, z, bits), v = coordinate(axes, 1, xy, z, bits),
                  w = coordinate(axes, 2, xy, z, bits);
    __mmask16 inside = _mm512_mask_cmplt_epu32_mask(present, u, dx);
    inside = _mm512_mask_cmplt_epu32_mask(inside, v, dy);
    inside = _mm512_mask_cmplt_epu32_mask(inside, w, dz);
    const __m512i brick = _mm512_add_epi32(
        _mm512_srli_epi32(u, 3), _mm512_add_epi32(_mm512_mullo_epi32(_mm512_srli_epi32(v, 3), brick_row),
                                                  _mm512_mullo_epi32(_mm512_srli_epi32(w, 3), brick_slice)));
    const __m512i cell = _mm512_or_si512(
        _mm512_or_si512(low_bits(_mm512_srli_epi32(u, 2), 1), low_bits(_mm512_srli_epi32(v, 1), 2)),
        low_bits(w, 4));
    const __m512i words = _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), inside, brick, view.cells, 2);
    const __m512i state = _mm512_srlv_epi32(words, cell);
    const __mmask16 some = _mm512_test_epi32_mask(state, _mm512_set1_epi32(1));
    __mmask16 solid = _mm512_test_epi32_mask(state, _mm512_set1_epi32(0x100));
    const auto unsure = static_cast<__mmask16>(some & ~solid);
    const __m512i voxel = _mm512_or_si512(
        _mm512_or_si512(_mm512_slli_epi32(brick, 9), low_bits(u, 7)),
        _mm512_or_si512(_mm512_slli_epi32(low_bits(v, 7), 3), _mm512_slli_epi32(low_bits(w, 7), 6)));
    if (unsure != 0)
      solid |= _mm512_mask_test_epi32_mask(unsure, gather_bytes(unsure, voxel, view.coverage),
                                           _mm512_set1_epi32(voxel::solid_coverage));
    engaged.masks[i / lanes] = solid;
    if (solid == 0) continue;
    engaged.count += static_cast<size_t>(std::popcount(static_cast<unsigned>(solid)));
    if (!block.guiding) add_cutting(view, solid, voxel, z, cutting);
  }
}

/// Direction tables looked up and turned: the vectors of sixteen points.
struct Vectors {
  __m512i g[5], weight;
};

REAM_AVX512 inline __m512i low_signed(__m512i bytes, int shift_left) {
  return _mm512_srai_epi32(_mm512_slli_epi32(bytes, static_cast<unsigned>(shift_left)), 24);
}

REAM_AVX512 inline __m512i turned(__m512i factor, __m512i low_factor) {
  const __m512i half = _mm512_set1_epi32(1 << (azimuth_shift - 1));
  return _mm512_srai_epi32(_mm512_add_epi32(pair_products(low_bits(factor, 0xffff), low_factor), half),
                           azimuth_shift);
}

REAM_AVX512 inline Vectors vectors_of(const ContactView& view, __mmask16 mask, size_t first) {
  const __m512i place = _mm512_maskz_loadu_epi32(mask, view.places + first);
  const __m512i low = _mm512_cvtepu16_epi32(_mm256_maskz_loadu_epi16(mask, view.directions + first));
  const __m512i direction = _mm512_or_si512(low, _mm512_slli_epi32(_mm512_srli_epi32(place, 27), 16));
  const __m512i zero = _mm512_setzero_si512();
  const __m512i entry = _mm512_mask_i32gather_epi32(zero, mask, _mm512_srli_epi32(direction, azimuth_bits),
                                                    view.table->meridian.data(), 4);
  const __m512i angle = _mm512_mask_i32gather_epi32(
      zero, mask, low_bits(direction, static_cast<int>(azimuth_count - 1)), view.table->azimuth.data(), 4);
  const __m512i radial = low_signed(entry, 24), arm = low_signed(entry, 8);
  const __m512i sine = _mm512_srli_epi32(angle, 16);
  return {{turned(radial, angle), turned(radial, sine), low_signed(entry, 16), turned(arm, sine),
           turned(_mm512_sub_epi32(zero, arm), angle)},
          _mm512_srli_epi32(entry, 24)};
}

REAM_AVX512 void add_mixed(const ContactView& view, const ContactBlock& block, const Engaged& engaged,
                           ContactProducts& products) {
  __m512i sums[21];
  for (auto& sum : sums) sum = _mm512_setzero_si512();
  for (size_t i = 0; i < block.count; i += lanes) {
    const __mmask16 mask = engaged.masks[i / lanes];
    if (mask == 0) continue;
    const Vectors v = vectors_of(view, mask, block.first + i);
    __m512i low[5], weighted[5];
    for (size_t k = 0; k < 5; ++k) {
      low[k] = low_bits(v.g[k], 0xffff);
      weighted[k] = pair_products(v.weight, low[k]);
    }
    size_t slot = 0;
    for (size_t a = 0; a < 5; ++a)
      for (size_t b = a; b < 5; ++b, ++slot)
        sums[slot] = _mm512_add_epi32(sums[slot], pair_products(weighted[a], low[b]));
    for (size_t a = 0; a < 5; ++a, ++slot) sums[slot] = _mm512_add_epi32(sums[slot], weighted[a]);
    sums[slot] = _mm512_add_epi32(sums[slot], v.weight);
  }
  for (size_t k = 0; k < products.size(); ++k) products[k] = _mm512_reduce_add_epi32(sums[k]);
}

/// The first engaged point of the greatest height, if it is deeper than what was found before.
REAM_AVX512 void take_deepest(const ContactView& view, const ContactBlock& block, const Engaged& engaged,
                              int32_t height, ContactSums& sums) {
  const int32_t above = block.origin_units.z() + height;
  if (sums.deepest != ContactSums::no_point && above <= sums.deepest_height_units()) return;
  for (uint32_t i = 0; i < block.count; ++i) {
    const uint32_t point = block.first + i;
    if (!(engaged.masks[i / lanes] >> (i % lanes) & 1) ||
        static_cast<int32_t>(view.places[point] >> (2 * place_bits) & place_mask) != height)
      continue;
    sums.deepest = ContactSums::depth_key(above, point);
    return;
  }
}

REAM_AVX512 void add_block(const ContactView& view, const SurvivingBlock& at, ContactSums& sums) noexcept {
  const ContactBlock& block = view.blocks[at.block];
  Engaged engaged;
  const __m512i zero = _mm512_setzero_si512();
  CuttingLanes cutting{zero, zero, _mm512_set1_epi32(-1), 0, 0};
  look(view, at, block, engaged, cutting);
  if (engaged.count == 0) return;

  const auto points = static_cast<int64_t>(engaged.count);
  ContactSums::Part& part = block.guiding ? sums.guiding : sums.cutting;
  if (engaged.count == block.count) {
    add_products_to(part, block.whole, points);
  } else {
    ContactProducts products;
    add_mixed(view, block, engaged, products);
    add_products_to(part, products, points);
  }
  if (block.guiding) return;
  const auto cortical = static_cast<size_t>(voxel::BoneClass::cortical),
             cancellous = static_cast<size_t>(voxel::BoneClass::cancellous),
             cartilage = static_cast<size_t>(voxel::BoneClass::cartilage);
  const int64_t cortical_density = _mm512_reduce_add_epi32(cutting.cortical);
  const int64_t cartilage_density = int64_t{cutting.cartilage_points} * voxel::cartilage_code;
  sums.class_points[cortical] += cutting.cortical_points;
  sums.class_points[cartilage] += cutting.cartilage_points;
  sums.class_points[cancellous] += points - cutting.cortical_points - cutting.cartilage_points;
  sums.class_density[cortical] += cortical_density;
  sums.class_density[cartilage] += cartilage_density;
  sums.class_density[cancellous] +=
      _mm512_reduce_add_epi32(cutting.all) - cortical_density - cartilage_density;
  take_deepest(view, block, engaged, _mm512_reduce_max_epi32(cutting.height), sums);
}

}  // namespace

AddBlock add_block_avx512() noexcept {
  __builtin_cpu_init();
  const bool usable = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return usable ? add_block : nullptr;
}

}  // namespace ream::collide

#else

namespace ream::collide {
AddBlock add_block_avx512() noexcept { return nullptr; }
}  // namespace ream::collide

#endif
