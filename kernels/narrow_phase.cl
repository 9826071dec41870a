#include "common.h"
#include "layout.h"

// Contact sums of the shell's surviving blocks: whole numbers only. Twin of server/collide/contact_blocks_portable.cpp.
// A group takes every G-th block. LANES work-items a group: 1 where work-items are loops (CPU) and one takes sixteen points
// at a time as vectors, a multiple of the warp elsewhere and each takes one point at a time.

#define NO_POINT LONG_MIN
#define PLACE_MASK ((1 << REAM_PLACE_BITS) - 1)

// What all points share, by address space: constant inputs and the bone.
#define BONE                                                                                                        \
  global const uint *places, global const ushort *directions, global const struct ContactBlockLayout *blocks,       \
      global const struct SurvivingBlockLayout *survivors, global const uint *meridian, global const uint *azimuth, \
      global const ushort *cells, global const uchar *coverage, global const uchar *density

static int turned(int product) {
  return (product + (1 << (REAM_AZIMUTH_SHIFT - 1))) >> REAM_AZIMUTH_SHIFT;
}

// Adds w g_i g_j, w g_i and w of one point.
static void add_products(uint place, uint low_direction, global const uint* meridian, global const uint* azimuth,
                         int* products) {
  const uint direction = low_direction | (place >> 27) << 16;
  const uint m = meridian[direction >> REAM_AZIMUTH_BITS];
  const uint a = azimuth[direction & ((1u << REAM_AZIMUTH_BITS) - 1)];
  const int radial = (int)(m << 24) >> 24, axial = (int)(m << 16) >> 24, arm = (int)(m << 8) >> 24;
  const int weight = (int)(m >> 24), cosine = (int)(a << 16) >> 16, sine = (int)a >> 16;
  const int g[5] = {turned(radial * cosine), turned(radial * sine), axial, turned(arm * sine), turned(-arm * cosine)};
  int k = 0;
  for (int i = 0; i < 5; ++i)
    for (int j = i; j < 5; ++j) products[k++] += weight * g[i] * g[j];
  for (int i = 0; i < 5; ++i) products[k++] += weight * g[i];
  products[k] += weight;
}

static long depth_key(int origin_z_units, uint place, uint point) {
  const int height = origin_z_units + (int)(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK);
  return ((long)height << 32) | (long)(0xffffffffu - point);
}

static int class_of(int code, int first_cortical_code) {
  return code == REAM_CARTILAGE_CODE ? 2 : code >= first_cortical_code ? 1 : 0;
}

#if LANES == 1

static int sum16(int16 v) {
  const int8 a = v.lo + v.hi;
  const int4 b = a.lo + a.hi;
  const int2 c = b.lo + b.hi;
  return c.x + c.y;
}

// Voxels of sixteen probes and their cells' state: 0x101 in solid bone, 1 where the voxel decides, 0 elsewhere.
static int16 probe(uint16 place, int16 present, global const struct SurvivingBlockLayout* at,
                   const struct ContactArguments* a, global const ushort* cells, int* voxels) {
  const int* m = a->per_unit;
  const int16 x = convert_int16(place & PLACE_MASK), y = convert_int16(place >> REAM_PLACE_BITS & PLACE_MASK),
              z = convert_int16(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK);
  const int16 u = (m[0] * x + m[1] * y + m[2] * z + at->base[0]) >> a->bits;
  const int16 v = (m[3] * x + m[4] * y + m[5] * z + at->base[1]) >> a->bits;
  const int16 w = (m[6] * x + m[7] * y + m[8] * z + at->base[2]) >> a->bits;
  const int16 inside = present & (u >= 0) & (v >= 0) & (w >= 0) & (u < a->dims[0]) & (v < a->dims[1]) & (w < a->dims[2]);
  const int16 brick = ((u >> 3) + (v >> 3) * a->brick_row + (w >> 3) * a->brick_slice) & inside;
  int bricks[16], words[16];
  vstore16(brick, 0, bricks);
  for (int k = 0; k < 16; ++k) words[k] = cells[bricks[k]];
  const int16 cell = ((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4);
  vstore16((brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6, 0, voxels);
  return (vload16(0, words) >> cell) & inside & 0x101;
}

static int16 bytes_at(global const uchar* bytes, const int* voxels, int16 wanted) {
  int index[16], found[16];
  vstore16(vload16(0, voxels) & wanted, 0, index);
  for (int k = 0; k < 16; ++k) found[k] = bytes[index[k]];
  return vload16(0, found);
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void contact_sums(BONE, struct ContactArguments arguments,
                                                                        global long* partial) {
  global long* sums = partial + (size_t)get_group_id(0) * REAM_CONTACT_SUMS;
  for (int k = 0; k < REAM_CONTACT_DEEPEST; ++k) sums[k] = 0;
  long deepest = NO_POINT;
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);

  for (uint s = get_group_id(0); s < arguments.survivors; s += get_num_groups(0)) {
    global const struct ContactBlockLayout* block = blocks + survivors[s].block;
    const int guiding = block->guiding, count = block->count;
    int engaged_in_chunk[REAM_CONTACT_BLOCK_POINTS];
    int16 points = 0, cortical_points = 0, cartilage_points = 0, all_density = 0, cortical_density = 0;
    int16 height = -1;
    for (int i = 0; i < count; i += REAM_CONTACT_CHUNK) {
      const uint16 place = vload16(0, places + block->first + i);
      int voxels[16];
      const int16 state = probe(place, lane < count - i, survivors + s, &arguments, cells, voxels);
      int16 engaged = state == 0x101;
      const int16 unsure = state == 1;
      if (any(unsure)) engaged |= unsure & (bytes_at(coverage, voxels, unsure) >= REAM_SOLID_COVERAGE);
      vstore16(engaged, 0, engaged_in_chunk + i);
      if (!any(engaged)) continue;
      points -= engaged;
      if (guiding) continue;
      const int16 code = bytes_at(density, voxels, engaged);
      const int16 cartilage = engaged & (code == REAM_CARTILAGE_CODE);
      const int16 cortical = engaged & ~cartilage & (code >= arguments.first_cortical_code);
      all_density += code & engaged;
      cortical_density += code & cortical;
      cortical_points -= cortical;
      cartilage_points -= cartilage;
      height = max(height, select((int16)(-1), convert_int16(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK), engaged));
    }
    const int total = sum16(points);
    if (total == 0) continue;
    global long* part = sums + guiding * REAM_CONTACT_PART_SUMS;
    part[REAM_CONTACT_PRODUCTS] += total;
    if (total == count) {
      for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) part[k] += block->whole[k];
    } else {
      int products[REAM_CONTACT_PRODUCTS];
      for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) products[k] = 0;
      for (int i = 0; i < count; ++i)
        if (engaged_in_chunk[i])
          add_products(places[block->first + i], directions[block->first + i], meridian, azimuth, products);
      for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) part[k] += products[k];
    }
    if (guiding) continue;
    const int cortical = sum16(cortical_points), cartilage = sum16(cartilage_points);
    const int cortical_codes = sum16(cortical_density), cartilage_codes = cartilage * REAM_CARTILAGE_CODE;
    sums[REAM_CONTACT_CLASS_POINTS] += total - cortical - cartilage;
    sums[REAM_CONTACT_CLASS_POINTS + 1] += cortical;
    sums[REAM_CONTACT_CLASS_POINTS + 2] += cartilage;
    sums[REAM_CONTACT_CLASS_DENSITY] += sum16(all_density) - cortical_codes - cartilage_codes;
    sums[REAM_CONTACT_CLASS_DENSITY + 1] += cortical_codes;
    sums[REAM_CONTACT_CLASS_DENSITY + 2] += cartilage_codes;
    int heights[16], highest = -1;
    vstore16(height, 0, heights);
    for (int k = 0; k < 16; ++k) highest = max(highest, heights[k]);
    if (deepest != NO_POINT && block->origin_z_units + highest < (int)(deepest >> 32)) continue;
    for (int i = 0; i < count; ++i)
      if (engaged_in_chunk[i])
        deepest = max(deepest, depth_key(block->origin_z_units, places[block->first + i], block->first + i));
  }
  sums[REAM_CONTACT_DEEPEST] = deepest;
}

#else

// Blocks between two additions to the 64-bit sums: 512 / LANES points a block and lane, 451,612 a point, stay below 2^31.
#define BLOCKS_A_FLUSH (8 * LANES)

static bool is_engaged(uint place, global const struct SurvivingBlockLayout* at, const struct ContactArguments* a,
                       global const ushort* cells, global const uchar* coverage, int* voxel) {
  const int* m = a->per_unit;
  const int x = place & PLACE_MASK, y = place >> REAM_PLACE_BITS & PLACE_MASK,
            z = place >> (2 * REAM_PLACE_BITS) & PLACE_MASK;
  const int u = (m[0] * x + m[1] * y + m[2] * z + at->base[0]) >> a->bits;
  const int v = (m[3] * x + m[4] * y + m[5] * z + at->base[1]) >> a->bits;
  const int w = (m[6] * x + m[7] * y + m[8] * z + at->base[2]) >> a->bits;
  if ((uint)u >= (uint)a->dims[0] || (uint)v >= (uint)a->dims[1] || (uint)w >= (uint)a->dims[2]) return false;
  const int brick = (u >> 3) + (v >> 3) * a->brick_row + (w >> 3) * a->brick_slice;
  const int state = cells[brick] >> (((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4)) & 0x101;
  *voxel = (brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6;
  return state == 0x101 || (state == 1 && coverage[*voxel] >= REAM_SOLID_COVERAGE);
}

// Adds every lane's value k of `scratch` to sums[k], and clears the lane's own values.
static void flush(int* values, int count, local int* scratch, global long* sums) {
  const int lane = get_local_id(0);
  for (int k = 0; k < count; ++k) {
    scratch[k * LANES + lane] = values[k];
    values[k] = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int k = lane; k < count; k += LANES) {
    long sum = 0;
    for (int i = 0; i < LANES; ++i) sum += scratch[k * LANES + i];
    sums[k] += sum;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
}

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void contact_sums(BONE, struct ContactArguments arguments,
                                                                            global long* partial) {
  local int scratch[REAM_CONTACT_PART_SUMS * LANES];
  local long deepest_of[LANES];
  const int lane = get_local_id(0);
  global long* sums = partial + (size_t)get_group_id(0) * REAM_CONTACT_SUMS;
  for (int k = lane; k < REAM_CONTACT_DEEPEST; k += LANES) sums[k] = 0;
  barrier(CLK_GLOBAL_MEM_FENCE);
  int products[REAM_CONTACT_PART_SUMS], classes[6];
  for (int k = 0; k < REAM_CONTACT_PART_SUMS; ++k) products[k] = 0;
  for (int k = 0; k < 6; ++k) classes[k] = 0;
  long deepest = NO_POINT;
  uint guiding = 0;
  int blocks_since_flush = 0;

  for (uint s = get_group_id(0); s < arguments.survivors; s += get_num_groups(0)) {
    global const struct ContactBlockLayout* block = blocks + survivors[s].block;
    // The same for all lanes, so all of them flush together.
    if (block->guiding != guiding || ++blocks_since_flush == BLOCKS_A_FLUSH) {
      flush(products, REAM_CONTACT_PART_SUMS, scratch, sums + guiding * REAM_CONTACT_PART_SUMS);
      flush(classes, 6, scratch, sums + REAM_CONTACT_CLASS_POINTS);
      guiding = block->guiding;
      blocks_since_flush = 0;
    }
    for (uint i = lane; i < block->count; i += LANES) {
      const uint point = block->first + i, place = places[point];
      int voxel;
      if (!is_engaged(place, survivors + s, &arguments, cells, coverage, &voxel)) continue;
      add_products(place, directions[point], meridian, azimuth, products);
      ++products[REAM_CONTACT_PRODUCTS];
      if (guiding) continue;
      const int code = density[voxel], bone_class = class_of(code, arguments.first_cortical_code);
      for (int k = 0; k < 3; ++k) {
        classes[k] += k == bone_class;
        classes[3 + k] += k == bone_class ? code : 0;
      }
      deepest = max(deepest, depth_key(block->origin_z_units, place, point));
    }
  }
  flush(products, REAM_CONTACT_PART_SUMS, scratch, sums + guiding * REAM_CONTACT_PART_SUMS);
  flush(classes, 6, scratch, sums + REAM_CONTACT_CLASS_POINTS);
  deepest_of[lane] = deepest;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane == 0) {
    for (int i = 1; i < LANES; ++i) deepest = max(deepest, deepest_of[i]);
    sums[REAM_CONTACT_DEEPEST] = deepest;
  }
}

#endif

// Brings a device's own copy of the cells up to date.
kernel void patch_cells(global const struct CellPatch* patches, uint count, global ushort* cells) {
  const uint i = get_global_id(0);
  if (i < count) cells[patches[i].brick] = (ushort)patches[i].word;
}
