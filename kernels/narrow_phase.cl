#include "common.h"
#include "layout.h"
#include "bone_parts.h"

// Contact sums of the shell's due chunks: whole numbers only. Twin of server/collide/contact/contact_kernel.cpp and
// surface_judge.hpp.
// LANES work-items a group: 1 where work-items are loops (CPU), and one takes a share of the chunks in a row, each as
// vectors; elsewhere a multiple of the warp, a group takes every G-th chunk and its lanes one point at a time.

#define NO_POINT LONG_MIN
#define PLACE_MASK ((1 << REAM_PLACE_BITS) - 1)

// What both forms of the kernel take: the shell and its due chunks, the bone's cells, the answer, and the bone.
#define CONTACT_PARAMETERS                                                                                      \
  global const uint *places, global const ushort *directions, global const uint *normals,                       \
      global const struct ContactBlockLayout *blocks,                                                            \
      global const struct DueChunkLayout *due, global const uint *meridian, global const uint *areas,           \
      global const uint *azimuth, global const uint *resistances, global const ushort *cells,                    \
      struct ContactArguments arguments, global long *partial,                      \
      global uchar *touched, BONE_PARTS(global const uchar, coverage), BONE_PARTS(global const uchar, density)

#if LANES > 1

static int turned(int product) {
  return (product + (1 << (REAM_AZIMUTH_SHIFT - 1))) >> REAM_AZIMUTH_SHIFT;
}

// Adds ContactProducts of one point.
static void add_products(uint place, uint low_direction, global const uint* meridian, global const uint* areas,
                         global const uint* azimuth, int* products) {
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
  products[k++] += weight * turned(127 * cosine);
  products[k++] += weight * turned(127 * sine);
  products[k++] += weight;
  products[k] += (int)areas[direction >> REAM_AZIMUTH_BITS];
}

static long depth_key(int origin_z_units, uint place, uint point) {
  const int height = origin_z_units + (int)(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK);
  return ((long)height << 32) | (long)(0xffffffffu - point);
}

static int class_of(int code, int first_cortical_code) {
  return code == REAM_CARTILAGE_CODE ? 2 : code >= first_cortical_code ? 1 : 0;
}

#endif

// Points between two additions to the 64-bit sums; 4,112,895 a point stay below 2^31.
#define POINTS_A_FLUSH 512

#if LANES == 1

static int sum16(int16 v) {
  const int8 a = v.lo + v.hi;
  const int4 b = a.lo + a.hi;
  const int2 c = b.lo + b.hi;
  return c.x + c.y;
}

// Moves places, in 2^-bits voxel, to the voxels that decide; returns the least coverages that engage.
static int16 move_to_ramp(uint16 normal, const struct ContactArguments* a, int16* u, int16* v, int16* w) {
  const int16 packed = as_int16(normal), x = (packed << 24) >> 24, y = (packed << 16) >> 24, z = (packed << 8) >> 24;
  const int halfway = 1 << (REAM_JUDGE_ROTATION_BITS - 1), shift = a->bits - REAM_JUDGE_FRACTION_BITS;
  const int mask = (1 << REAM_JUDGE_FRACTION_BITS) - 1;
  const int* r = a->normal_rotation;
  const int16 n0 = (r[0] * x + r[1] * y + r[2] * z + halfway) >> REAM_JUDGE_ROTATION_BITS;
  const int16 n1 = (r[3] * x + r[4] * y + r[5] * z + halfway) >> REAM_JUDGE_ROTATION_BITS;
  const int16 n2 = (r[6] * x + r[7] * y + r[8] * z + halfway) >> REAM_JUDGE_ROTATION_BITS;
  const int16 projected = n0 * ((*u >> shift) & mask) + n1 * ((*v >> shift) & mask) + n2 * ((*w >> shift) & mask) + halfway;
  int16 level = 128 + n0 + n1 + n2 - (projected >> REAM_JUDGE_ROTATION_BITS);
  const int16 l0 = as_int16(abs(n0)), l1 = as_int16(abs(n1)), l2 = as_int16(abs(n2)), longest = max(max(l0, l1), l2);
  const int16 step = 2 * longest, out = level < 1, in = (level > 255) & (level - step >= 1);
  level += (step & out) - (step & in);
  // 1 outwards, -1 inwards, and the other way where the normal leads down the axis.
  const int16 moves = in - out;
  const int16 axis0 = l0 == longest, axis1 = ~axis0 & (l1 == longest), axis2 = ~axis0 & ~axis1;
  *u = (*u >> a->bits) + (select(moves, -moves, n0 < 0) & axis0);
  *v = (*v >> a->bits) + (select(moves, -moves, n1 < 0) & axis1);
  *w = (*w >> a->bits) + (select(moves, -moves, n2 < 0) & axis2);
  return max(min(level, 255) - REAM_JUDGE_TOLERANCE, 1);
}

// The voxels that decide about sixteen probes, the coverages that they need and their cells' state: 0x101 in full
// bone, 1 where the voxel decides, 0 elsewhere.
static int16 probe(uint16 place, uint16 normal, int16 present, global const struct DueChunkLayout* at,
                   const struct ContactArguments* a, global const ushort* cells, int16* voxel, int16* needed) {
  const int* m = a->per_unit;
  const int16 x = convert_int16(place & PLACE_MASK), y = convert_int16(place >> REAM_PLACE_BITS & PLACE_MASK),
              z = convert_int16(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK);
  int16 u = m[0] * x + m[1] * y + m[2] * z + at->base[0];
  int16 v = m[3] * x + m[4] * y + m[5] * z + at->base[1];
  int16 w = m[6] * x + m[7] * y + m[8] * z + at->base[2];
  *needed = move_to_ramp(normal, a, &u, &v, &w);
  const int16 inside = present & (as_uint16(u) < (uint)a->dims[0]) & (as_uint16(v) < (uint)a->dims[1]) &
                       (as_uint16(w) < (uint)a->dims[2]);
  const int16 brick = ((u >> 3) + (v >> 3) * a->brick_row + (w >> 3) * a->brick_slice) & inside;
  int bricks[16], words[16];
  vstore16(brick, 0, bricks);
  for (int k = 0; k < 16; ++k) words[k] = cells[bricks[k]];
  const int16 cell = ((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4);
  *voxel = (brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6;
  return (vload16(0, words) >> cell) & inside & 0x101;
}

// Bytes of the wanted lanes; the others read the first.
static int16 bytes_at(BONE_PARTS(global const uchar, bytes), int16 at, int16 wanted) {
  int index[16], found[16];
  vstore16(at & wanted, 0, index);
  for (int k = 0; k < 16; ++k) found[k] = *AT_VOXEL(bytes, index[k]);
  return vload16(0, found);
}

static int16 words_at(global const uint* words, int16 at) {
  int index[16], found[16];
  vstore16(at, 0, index);
  for (int k = 0; k < 16; ++k) found[k] = (int)words[index[k]];
  return vload16(0, found);
}

static int16 turned16(int16 product) {
  return (product + (1 << (REAM_AZIMUTH_SHIFT - 1))) >> REAM_AZIMUTH_SHIFT;
}

// What a group has summed of one side, lane by lane, since it was added to the 64-bit sums.
typedef struct {
  int16 products[REAM_CONTACT_PRODUCTS];
  int chunks;
} SideSums;

static void clear(SideSums* side) {
  for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) side->products[k] = 0;
  side->chunks = 0;
}

static void flush(SideSums* side, global long* sums) {
  if (side->chunks == 0) return;
  for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) {
    int lanes[16];
    vstore16(side->products[k], 0, lanes);
    long sum = 0;
    for (int i = 0; i < 16; ++i) sum += lanes[i];
    sums[k] += sum;
  }
  clear(side);
}

static void add_chunk(uint16 place, uint16 low_direction, int16 engaged, global const uint* meridian,
                      global const uint* areas, global const uint* azimuth, SideSums* side) {
  const int16 direction = convert_int16(low_direction | (place >> 27) << 16) & engaged;
  const int16 m = words_at(meridian, direction >> REAM_AZIMUTH_BITS);
  const int16 a = words_at(azimuth, direction & ((1 << REAM_AZIMUTH_BITS) - 1));
  const int16 radial = (m << 24) >> 24, arm = (m << 8) >> 24, weight = convert_int16(as_uint16(m) >> 24) & engaged;
  const int16 cosine = (a << 16) >> 16, sine = a >> 16;
  const int16 g[5] = {turned16(radial * cosine), turned16(radial * sine), (m << 16) >> 24, turned16(arm * sine),
                      turned16(-arm * cosine)};
  int k = 0;
  for (int i = 0; i < 5; ++i) {
    const int16 weighted = weight * g[i];
    for (int j = i; j < 5; ++j) side->products[k++] += weighted * g[j];
  }
  for (int i = 0; i < 5; ++i) side->products[k++] += weight * g[i];
  side->products[k++] += weight * turned16(127 * cosine);
  side->products[k++] += weight * turned16(127 * sine);
  side->products[k++] += weight;
  side->products[k] += words_at(areas, direction >> REAM_AZIMUTH_BITS) & engaged;
  ++side->chunks;
}

// Sums over cutting points, lane by lane.
typedef struct {
  int16 weight, cortical_weight, cartilage_weight, density, cortical_density;
  long16 resistance;
} ClassSums;

// `weight` and `code` are 0 where nothing is engaged.
static void add_density(int16 code, int16 weight, int first_cortical_code, global const uint* resistances,
                        ClassSums* sums) {
  const int16 cartilage = code == REAM_CARTILAGE_CODE, cortical = ~cartilage & (code >= first_cortical_code);
  sums->weight += weight;
  sums->density += weight * code;
  sums->cortical_density += weight * code & cortical;
  sums->cortical_weight += weight & cortical;
  sums->cartilage_weight += weight & cartilage;
  sums->resistance += convert_long16(weight * words_at(resistances, code));
}

static void write_classes(const ClassSums* s, global long* sums) {
  const long cortical = sum16(s->cortical_weight), cartilage = sum16(s->cartilage_weight);
  const long cortical_codes = sum16(s->cortical_density), cartilage_codes = cartilage * REAM_CARTILAGE_CODE;
  sums[REAM_CONTACT_CLASS_WEIGHT] = sum16(s->weight) - cortical - cartilage;
  sums[REAM_CONTACT_CLASS_WEIGHT + 1] = cortical;
  sums[REAM_CONTACT_CLASS_WEIGHT + 2] = cartilage;
  long resistances[16], resistance = 0;
  vstore16(s->resistance, 0, resistances);
  for (int i = 0; i < 16; ++i) resistance += resistances[i];
  sums[REAM_CONTACT_RESISTANCE] = resistance;
  sums[REAM_CONTACT_CLASS_DENSITY] = sum16(s->density) - cortical_codes - cartilage_codes;
  sums[REAM_CONTACT_CLASS_DENSITY + 1] = cortical_codes;
  sums[REAM_CONTACT_CLASS_DENSITY + 2] = cartilage_codes;
}

// The deepest of `deepest` and the engaged points of a chunk.
static long deeper(long deepest, int origin_z_units, uint16 place, int16 engaged, uint first) {
  const int16 height = select((int16)(-1), convert_int16(place >> (2 * REAM_PLACE_BITS) & PLACE_MASK), engaged);
  int heights[16];
  vstore16(height, 0, heights);
  for (uint k = 0; k < 16; ++k)
    if (heights[k] >= 0)
      deepest = max(deepest, ((long)(origin_z_units + heights[k]) << 32) | (long)(0xffffffffu - (first + k)));
  return deepest;
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void contact_sums(CONTACT_PARAMETERS) {
  global long* sums = partial + (size_t)get_group_id(0) * REAM_CONTACT_SUMS;
  for (int k = 0; k < REAM_CONTACT_DEEPEST; ++k) sums[k] = 0;
  long deepest = NO_POINT;
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  SideSums side;
  clear(&side);
  ClassSums classes = {0, 0, 0, 0, 0, 0};
  uint guiding = 0;
  const uint share = (arguments.chunks + get_num_groups(0) - 1) / get_num_groups(0);
  const uint last = min(arguments.chunks, ((uint)get_group_id(0) + 1) * share);

  // One block's chunks after another: a block that is wholly engaged has its sums ready.
  for (uint first = get_group_id(0) * share, end = first; first < last; first = end) {
    global const struct ContactBlockLayout* block = blocks + due[first].block;
    int16 engaged_of[REAM_CONTACT_BLOCK_CHUNKS], points = 0;
    for (; end < last && due[end].block == due[first].block; ++end) {
      global const struct DueChunkLayout* chunk = due + end;
      const uint16 place = vload16(0, places + chunk->first), normal = vload16(0, normals + chunk->first);
      int16 voxel, needed;
      const int16 state =
          probe(place, normal, lane < (int)chunk->count, chunk, &arguments, cells, &voxel, &needed);
      int16 engaged = state == 0x101;
      const int16 unsure = state == 1;
      if (any(unsure))
        engaged |= unsure & (bytes_at(PASS_PARTS(coverage), voxel, unsure) >= needed);
      engaged_of[end - first] = engaged;
      touched[end] = any(engaged) != 0;
      if (!any(engaged)) continue;
      points -= engaged;
      if (block->guiding) continue;
      add_density(bytes_at(PASS_PARTS(density), voxel, engaged) & engaged, convert_int16(normal >> 24) & engaged,
                  arguments.first_cortical_code, resistances, &classes);
      if (deepest == NO_POINT || block->origin_z_units + block->height_units > (int)(deepest >> 32))
        deepest = deeper(deepest, block->origin_z_units, place, engaged, chunk->first);
    }
    const uint total = sum16(points);
    if (total == 0) continue;
    if (block->guiding != guiding || side.chunks >= POINTS_A_FLUSH) {
      flush(&side, sums + guiding * REAM_CONTACT_PART_SUMS);
      guiding = block->guiding;
    }
    global long* part = sums + guiding * REAM_CONTACT_PART_SUMS;
    part[REAM_CONTACT_PRODUCTS] += total;
    if (total == block->count) {
      for (int k = 0; k < REAM_CONTACT_PRODUCTS; ++k) part[k] += block->whole[k];
      continue;
    }
    for (uint s = first; s < end; ++s)
      if (any(engaged_of[s - first]))
        add_chunk(vload16(0, places + due[s].first), convert_uint16(vload16(0, directions + due[s].first)),
                  engaged_of[s - first], meridian, areas, azimuth, &side);
  }
  flush(&side, sums + guiding * REAM_CONTACT_PART_SUMS);
  write_classes(&classes, sums);
  sums[REAM_CONTACT_DEEPEST] = deepest;
}

#else

// Moves a place, in 2^-bits voxel, to the voxel that decides; returns the least coverage that engages.
static int move_to_ramp(uint normal, const struct ContactArguments* a, int* at) {
  const int x = (char)normal, y = (char)(normal >> 8), z = (char)(normal >> 16);
  const int halfway = 1 << (REAM_JUDGE_ROTATION_BITS - 1);
  int level = 128, projected = halfway, step = 0, axis = 0, outwards = 1;
  for (int i = 0; i < 3; ++i) {
    const int* r = a->normal_rotation + 3 * i;
    const int n = (r[0] * x + r[1] * y + r[2] * z + halfway) >> REAM_JUDGE_ROTATION_BITS;
    level += n;
    projected += n * ((at[i] >> (a->bits - REAM_JUDGE_FRACTION_BITS)) & ((1 << REAM_JUDGE_FRACTION_BITS) - 1));
    at[i] >>= a->bits;
    if (2 * abs(n) <= (uint)step) continue;
    step = 2 * abs(n);
    axis = i;
    outwards = n < 0 ? -1 : 1;
  }
  level -= projected >> REAM_JUDGE_ROTATION_BITS;
  const int moves = level < 1 ? 1 : (level > 255 && level - step >= 1 ? -1 : 0);
  at[axis] += moves * outwards;
  return max(min(level + moves * step, 255) - REAM_JUDGE_TOLERANCE, 1);
}

static bool is_engaged(uint place, uint normal, global const struct DueChunkLayout* at,
                       const struct ContactArguments* a, global const ushort* cells,
                       BONE_PARTS(global const uchar, coverage), int* voxel) {
  const int* m = a->per_unit;
  const int x = place & PLACE_MASK, y = place >> REAM_PLACE_BITS & PLACE_MASK,
            z = place >> (2 * REAM_PLACE_BITS) & PLACE_MASK;
  int c[3];
  for (int i = 0; i < 3; ++i) c[i] = m[3 * i] * x + m[3 * i + 1] * y + m[3 * i + 2] * z + at->base[i];
  const int needed = move_to_ramp(normal, a, c), u = c[0], v = c[1], w = c[2];
  if ((uint)u >= (uint)a->dims[0] || (uint)v >= (uint)a->dims[1] || (uint)w >= (uint)a->dims[2]) return false;
  const int brick = (u >> 3) + (v >> 3) * a->brick_row + (w >> 3) * a->brick_slice;
  const int state = cells[brick] >> (((u >> 2) & 1) | ((v >> 1) & 2) | (w & 4)) & 0x101;
  *voxel = (brick << 9) | (u & 7) | (v & 7) << 3 | (w & 7) << 6;
  return state == 0x101 || (state == 1 && *AT_VOXEL(coverage, *voxel) >= needed);
}

// Adds every lane's value k to sums[k], and clears the lane's own values.
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

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void contact_sums(CONTACT_PARAMETERS) {
  local int scratch[REAM_CONTACT_PART_SUMS * LANES];
  local long deepest_of[LANES];
  const uint lane = get_local_id(0), group = get_group_id(0), groups = get_num_groups(0);
  global long* sums = partial + (size_t)group * REAM_CONTACT_SUMS;
  for (uint k = lane; k < REAM_CONTACT_DEEPEST; k += LANES) sums[k] = 0;
  for (uint s = group + lane * groups; s < arguments.chunks; s += LANES * groups) touched[s] = 0;
  barrier(CLK_GLOBAL_MEM_FENCE);
  int cut[REAM_CONTACT_PART_SUMS], guided[REAM_CONTACT_PART_SUMS], classes[7];
  for (int k = 0; k < REAM_CONTACT_PART_SUMS; ++k) cut[k] = guided[k] = 0;
  for (int k = 0; k < 7; ++k) classes[k] = 0;
  long deepest = NO_POINT;

  // The group's points in a row, LANES at a time; every lane takes as many turns, so that all flush together.
  const uint own_chunks = arguments.chunks > group ? (arguments.chunks - group + groups - 1) / groups : 0;
  const uint turns = (own_chunks * REAM_CONTACT_CHUNK + LANES - 1) / LANES;
  for (uint turn = 0; turn < turns; ++turn) {
    if (turn % POINTS_A_FLUSH == POINTS_A_FLUSH - 1) {
      flush(cut, REAM_CONTACT_PART_SUMS, scratch, sums);
      flush(guided, REAM_CONTACT_PART_SUMS, scratch, sums + REAM_CONTACT_PART_SUMS);
      flush(classes, 7, scratch, sums + REAM_CONTACT_CLASS_WEIGHT);
    }
    const uint item = turn * LANES + lane, own = item / REAM_CONTACT_CHUNK, i = item % REAM_CONTACT_CHUNK;
    if (own >= own_chunks) continue;
    const uint s = group + own * groups;
    global const struct DueChunkLayout* chunk = due + s;
    if (i >= chunk->count) continue;
    const uint point = chunk->first + i, place = places[point];
    int voxel;
    if (!is_engaged(place, normals[point], chunk, &arguments, cells, PASS_PARTS(coverage), &voxel)) continue;
    touched[s] = 1;
    const struct ContactBlockLayout block = blocks[chunk->block];
    if (block.guiding) {
      add_products(place, directions[point], meridian, areas, azimuth, guided);
      ++guided[REAM_CONTACT_PRODUCTS];
      continue;
    }
    add_products(place, directions[point], meridian, areas, azimuth, cut);
    ++cut[REAM_CONTACT_PRODUCTS];
    const int code = *AT_VOXEL(density, voxel), bone_class = class_of(code, arguments.first_cortical_code);
    const int weight = (int)(normals[point] >> 24);
    for (int k = 0; k < 3; ++k) {
      classes[k] += k == bone_class ? weight : 0;
      classes[3 + k] += k == bone_class ? weight * code : 0;
    }
    classes[6] += weight * (int)resistances[code];
    deepest = max(deepest, depth_key(block.origin_z_units, place, point));
  }
  flush(cut, REAM_CONTACT_PART_SUMS, scratch, sums);
  flush(guided, REAM_CONTACT_PART_SUMS, scratch, sums + REAM_CONTACT_PART_SUMS);
  flush(classes, 7, scratch, sums + REAM_CONTACT_CLASS_WEIGHT);
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
