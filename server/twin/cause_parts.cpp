#include "twin/cause_parts.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "record/columns.hpp"

namespace ream::twin {
namespace {

using record::ops::FieldReader;
using record::ops::put_field;
using voxel::brick_voxels;

enum BrickKind : uint8_t { empty_brick = 0, whole_brick = 1, mixed_brick = 2 };

constexpr uint32_t words_of_tick = 13;
/// Of a grid's side, voxels, and of all its voxels: what a session may have that a browser can hold.
constexpr uint32_t max_side = 4096;
constexpr uint64_t max_voxels = 1u << 30;
/// Of a reamer's table: its sides, which floats count, its entries, and how far from the origin its body may
/// be.
constexpr int max_table_side = 1 << 22;
constexpr uint64_t max_table_entries = 1u << 24;
constexpr double max_body_mm = 1000.0;
constexpr double max_threshold_g_cc = 100.0;

Bytes begin(PartCode code) { return {static_cast<std::byte>(code)}; }

BrickKind kind_of(const uint8_t* coverage) {
  const uint8_t first = coverage[0];
  const bool even = std::all_of(coverage, coverage + brick_voxels, [&](uint8_t c) { return c == first; });
  return even && first == 0 ? empty_brick : even && first == 255 ? whole_brick : mixed_brick;
}

/// False when the bricks are not those that the kinds announce.
bool read_bricks(FieldReader& in, voxel::BoneModel& bone) {
  const size_t bricks = bone.grid.brick_count();
  const auto kinds = in.take_bytes(bricks);
  if (!in.fits()) return false;
  for (size_t brick = 0; brick < bricks; ++brick) {
    uint8_t* coverage = bone.coverage.data() + brick * brick_voxels;
    const auto kind = std::to_integer<uint8_t>(kinds[brick]);
    if (kind == whole_brick) std::memset(coverage, 255, brick_voxels);
    if (kind == mixed_brick) {
      const auto stored = in.take_bytes(brick_voxels);
      if (!in.fits()) return false;
      std::memcpy(coverage, stored.data(), brick_voxels);
    }
    if (kind > mixed_brick) return false;
  }
  return in.rest().empty();
}

}  // namespace

bool fits_twin(const voxel::VoxelGrid& grid) {
  uint64_t voxels = 1;  // a size_t has 32 bits in a browser
  for (const int side : {grid.dims.x(), grid.dims.y(), grid.dims.z()}) {
    if (side <= 0 || side > static_cast<int>(max_side) || side % voxel::brick_edge != 0) return false;
    voxels *= static_cast<uint64_t>(side);
  }
  return voxels <= max_voxels && grid.spacing_mm.allFinite() && (grid.spacing_mm.array() >= 0.001).all() &&
         (grid.spacing_mm.array() <= 10.0).all();
}

bool fits_twin(const shell::SweptProfile& p) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  const auto near = [](double mm) { return std::isfinite(mm) && std::abs(mm) < max_body_mm; };
  return p.z_count >= 2 && p.r2_count >= 2 && p.z_count <= max_table_side && p.r2_count <= max_table_side &&
         static_cast<uint64_t>(p.z_count) * static_cast<uint64_t>(p.r2_count) <= max_table_entries &&
         near(p.z_min_mm) && positive(p.z_step_mm) && positive(p.inverse_z_step) && positive(p.r2_step_mm2) &&
         positive(p.inverse_r2_step) && positive(p.max_radius_mm) && near(p.max_radius_mm) &&
         near(p.body_min_z_mm) && near(p.body_max_z_mm) && p.body_max_z_mm > p.body_min_z_mm &&
         positive(p.margin_mm) && near(p.margin_mm);
}

Bytes start_part(const voxel::BoneModel& bone) {
  Bytes out = begin(PartCode::start);
  for (const int side : {bone.grid.dims.x(), bone.grid.dims.y(), bone.grid.dims.z()})
    put_field(out, static_cast<uint32_t>(side));
  for (int axis = 0; axis < 3; ++axis) put_field(out, bone.grid.spacing_mm[axis]);
  put_field(out, bone.coverage_hash());
  const size_t bricks = bone.grid.brick_count();
  std::vector<BrickKind> kinds(bricks);
  for (size_t brick = 0; brick < bricks; ++brick) {
    kinds[brick] = kind_of(bone.coverage.data() + brick * brick_voxels);
    out.push_back(static_cast<std::byte>(kinds[brick]));
  }
  for (size_t brick = 0; brick < bricks; ++brick) {
    if (kinds[brick] != mixed_brick) continue;
    const auto* coverage = reinterpret_cast<const std::byte*>(bone.coverage.data() + brick * brick_voxels);
    out.insert(out.end(), coverage, coverage + brick_voxels);
  }
  return out;
}

Bytes density_part(std::span<const uint8_t> density, double cortical_threshold_g_cc) {
  Bytes out = begin(PartCode::density);
  put_field(out, cortical_threshold_g_cc);
  const size_t bricks = density.size() / brick_voxels;
  std::vector<uint8_t> is_told(bricks);
  for (size_t brick = 0; brick < bricks; ++brick) {
    const auto codes = density.subspan(brick * brick_voxels, brick_voxels);
    is_told[brick] = std::any_of(codes.begin(), codes.end(), [](uint8_t code) { return code != 0; });
    out.push_back(static_cast<std::byte>(is_told[brick]));
  }
  for (size_t brick = 0; brick < bricks; ++brick) {
    if (is_told[brick] == 0) continue;
    const auto codes = std::as_bytes(density.subspan(brick * brick_voxels, brick_voxels));
    out.insert(out.end(), codes.begin(), codes.end());
  }
  return out;
}

Bytes segment_part(uint32_t first_tick, const shell::SweptProfile& p) {
  Bytes out = begin(PartCode::segment);
  put_field(out, first_tick);
  for (const float value : {p.z_min_mm, p.z_step_mm, p.inverse_z_step, p.r2_step_mm2, p.inverse_r2_step})
    put_field(out, value);
  put_field(out, static_cast<uint32_t>(p.z_count));
  put_field(out, static_cast<uint32_t>(p.r2_count));
  for (const double value : {p.max_radius_mm, p.body_min_z_mm, p.body_max_z_mm, p.margin_mm})
    put_field(out, value);
  for (const float distance : p.distance_mm) put_field(out, distance);
  return out;
}

Bytes ticks_part(std::span<const CauseTick> ticks, uint64_t session_hash) {
  assert(!ticks.empty() && ticks.size() <= max_rows_of_part);
  Bytes out = begin(PartCode::ticks);
  put_field(out, ticks.front().tick);
  put_field(out, static_cast<uint32_t>(ticks.size()));
  put_field(out, session_hash);
  std::vector<uint32_t> words(ticks.size() * words_of_tick);
  uint32_t* next = words.data();
  for (const CauseTick& tick : ticks) {
    *next++ = tick.flags;
    for (const int32_t q : tick.grid_from_tool.rotation_q30) *next++ = static_cast<uint32_t>(q);
    for (const int32_t q : tick.grid_from_tool.translation_nm) *next++ = static_cast<uint32_t>(q);
  }
  record::put_columns(out, words, words_of_tick);
  return out;
}

Bytes end_part(uint32_t ticks, uint64_t coverage_hash, uint32_t recorded_ticks) {
  Bytes out = begin(PartCode::end);
  put_field(out, ticks);
  put_field(out, coverage_hash);
  put_field(out, recorded_ticks);
  return out;
}

std::optional<voxel::BoneModel> read_start(std::span<const std::byte> bytes) {
  FieldReader in(bytes);
  voxel::BoneModel bone;
  uint32_t sides[3] = {};
  uint64_t hash = 0;
  for (uint32_t& side : sides) in.take(side);
  for (int axis = 0; axis < 3; ++axis) in.take(bone.grid.spacing_mm[axis]);
  in.take(hash);
  for (int axis = 0; axis < 3; ++axis)
    bone.grid.dims[axis] = static_cast<int>(std::min(sides[axis], max_side + 1));
  // A byte a brick must be there before memory is asked for.
  if (!in.fits() || !fits_twin(bone.grid) || in.rest().size() < bone.grid.brick_count()) return std::nullopt;
  bone.coverage.resize(bone.grid.voxel_count());
  if (!read_bricks(in, bone) || bone.coverage_hash() != hash) return std::nullopt;
  bone.density = std::vector<uint8_t>(bone.grid.voxel_count());
  return bone;
}

std::optional<DensityPart> read_density(std::span<const std::byte> bytes, const voxel::VoxelGrid& grid) {
  FieldReader in(bytes);
  DensityPart part;
  in.take(part.cortical_threshold_g_cc);
  const auto told = in.take_bytes(grid.brick_count());
  if (!in.fits() || !std::isfinite(part.cortical_threshold_g_cc) ||
      std::abs(part.cortical_threshold_g_cc) > max_threshold_g_cc)
    return std::nullopt;
  part.codes.resize(grid.voxel_count());
  for (size_t brick = 0; brick < told.size(); ++brick) {
    const auto kind = std::to_integer<uint8_t>(told[brick]);
    if (kind > 1) return std::nullopt;
    if (kind == 0) continue;
    const auto stored = in.take_bytes(brick_voxels);
    if (!in.fits()) return std::nullopt;
    std::memcpy(part.codes.data() + brick * brick_voxels, stored.data(), brick_voxels);
  }
  if (!in.rest().empty()) return std::nullopt;
  return part;
}

std::optional<SegmentPart> read_segment(std::span<const std::byte> bytes) {
  FieldReader in(bytes);
  SegmentPart part;
  shell::SweptProfile& p = part.profile;
  uint32_t z_count = 0, r2_count = 0;
  in.take(part.first_tick);
  for (float* value : {&p.z_min_mm, &p.z_step_mm, &p.inverse_z_step, &p.r2_step_mm2, &p.inverse_r2_step})
    in.take(*value);
  in.take(z_count);
  in.take(r2_count);
  for (double* value : {&p.max_radius_mm, &p.body_min_z_mm, &p.body_max_z_mm, &p.margin_mm}) in.take(*value);
  p.z_count = static_cast<int>(std::min<uint32_t>(z_count, INT32_MAX));
  p.r2_count = static_cast<int>(std::min<uint32_t>(r2_count, INT32_MAX));
  const uint64_t entries = uint64_t{z_count} * r2_count;
  if (!in.fits() || !fits_twin(p) || in.rest().size() != entries * sizeof(float)) return std::nullopt;
  p.distance_mm.resize(entries);
  for (float& distance : p.distance_mm) {
    in.take(distance);
    if (!std::isfinite(distance)) return std::nullopt;
  }
  return part;
}

std::optional<TicksPart> read_ticks(std::span<const std::byte> bytes) {
  FieldReader in(bytes);
  uint32_t first = 0, rows = 0;
  TicksPart part;
  in.take(first);
  in.take(rows);
  in.take(part.session_hash);
  std::vector<uint32_t> words;
  if (!in.fits() || rows == 0 || rows > max_rows_of_part || first > UINT32_MAX - rows ||
      !record::take_columns(in.rest(), rows, words_of_tick, words))
    return std::nullopt;
  part.ticks.resize(rows);
  const uint32_t* next = words.data();
  for (uint32_t row = 0; row < rows; ++row) {
    CauseTick& tick = part.ticks[row];
    tick.tick = first + row;
    tick.flags = *next++;
    for (int32_t& q : tick.grid_from_tool.rotation_q30) q = static_cast<int32_t>(*next++);
    for (int32_t& q : tick.grid_from_tool.translation_nm) q = static_cast<int32_t>(*next++);
  }
  return part;
}

std::optional<EndPart> read_end(std::span<const std::byte> bytes) {
  FieldReader in(bytes);
  EndPart part;
  in.take(part.ticks);
  in.take(part.coverage_hash);
  in.take(part.recorded_ticks);
  if (!in.fits() || !in.rest().empty() || part.recorded_ticks < part.ticks) return std::nullopt;
  return part;
}

}  // namespace ream::twin
