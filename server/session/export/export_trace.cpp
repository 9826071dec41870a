#include "session/export/export_trace.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "record/trace_csv.hpp"

namespace ream::session {
namespace {

constexpr uint32_t ticks_between_looks = 10'000;

uint32_t tick_at(double time_s) {
  return static_cast<uint32_t>(std::clamp(std::ceil(time_s / tick_s - 0.5), 0.0, 4.0e9));
}

}  // namespace

void export_trace(const record::Recording& recording, const std::filesystem::path& csv, const TracePart& part,
                  const Progress& progress) {
  const voxel::VoxelGrid grid = recording.grid();
  const uint32_t first = tick_at(part.from_s);
  const uint32_t end = std::min(part.to_s ? tick_at(*part.to_s) : UINT32_MAX, recording.tick_count());
  record::TraceCsv trace(csv, grid.voxel_volume_mm3());
  recording.for_each_tick(0, end, [&](const record::ops::Tick& tick) {
    if (tick.tick % ticks_between_looks == 0)
      progress(static_cast<double>(tick.tick) / std::max(end, 1u), "writing rows");
    const record::TickReport report = record::report_of(tick, grid.world_from_grid);
    if (tick.tick >= first && (tick.tick - first) % static_cast<uint32_t>(part.stride) == 0)
      trace.add(report);
    else
      trace.pass(report);
  });
  trace.finish();
}

}  // namespace ream::session
