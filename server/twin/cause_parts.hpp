#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "record/op_fields.hpp"
#include "shell/swept_profile.hpp"
#include "twin/bone_twin.hpp"

namespace ream::twin {

using record::ops::Bytes;

/// What a session's bone follows from, in parts that are computed one after the other (TwinPlayer): the bone
/// before the first tick, perhaps what it is made of, a segment before its first tick, ticks in order, the
/// end. proto/causes.md says what bytes they are.
enum class PartCode : uint8_t { start = 1, segment = 2, ticks = 3, end = 4, density = 5 };

/// Rows of one part of ticks, at most; one hash stands for all of them.
inline constexpr uint32_t max_rows_of_part = 1000;
/// Whether the twin takes a bone of that grid: what a browser can hold.
bool fits_twin(const voxel::VoxelGrid& grid);

/// Likewise of a reamer's body.
bool fits_twin(const shell::SweptProfile& profile);

/// Of a bone whose grid fits.
Bytes start_part(const voxel::BoneModel& bone);
/// For pictures: the density of voxels, grid.voxel_count() codes; bricks of zeros are left out.
Bytes density_part(std::span<const uint8_t> density, double cortical_threshold_g_cc);
Bytes segment_part(uint32_t first_tick, const shell::SweptProfile& profile);
/// Consecutive ticks, 1 to max_rows_of_part.
Bytes ticks_part(std::span<const CauseTick> ticks, uint64_t session_hash);
/// `recorded_ticks`: of the whole recording, of which the parts may say fewer.
Bytes end_part(uint32_t ticks, uint64_t coverage_hash, uint32_t recorded_ticks);

struct DensityPart {
  double cortical_threshold_g_cc = 0.0;
  std::vector<uint8_t> codes;  ///< of all voxels; zeros where none was told
};
struct SegmentPart {
  uint32_t first_tick = 0;
  shell::SweptProfile profile;
};
struct TicksPart {
  std::vector<CauseTick> ticks;
  uint64_t session_hash = 0;
};
struct EndPart {
  uint32_t ticks = 0;
  uint64_t coverage_hash = 0;
  uint32_t recorded_ticks = 0;  ///< no fewer than `ticks`
};

/// Of parts from outside, without their code: empty when they are damaged or hold what no session has. Bone
/// whose coverage has not the hash that the part says counts as damaged. Density is zeros.
std::optional<voxel::BoneModel> read_start(std::span<const std::byte> bytes);
std::optional<DensityPart> read_density(std::span<const std::byte> bytes, const voxel::VoxelGrid& grid);
std::optional<SegmentPart> read_segment(std::span<const std::byte> bytes);
std::optional<TicksPart> read_ticks(std::span<const std::byte> bytes);
std::optional<EndPart> read_end(std::span<const std::byte> bytes);

}  // namespace ream::twin
