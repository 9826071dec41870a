#pragma once
#include <cstdint>

#include "core/hash.hpp"
#include "record/tick_report.hpp"

namespace ream::record {

/// Of the flags of ops::Tick, what was asked for; the others follow from it.
inline uint32_t cause_flags(const TickReport& report) noexcept {
  return (report.spindle_on ? spindle_on_flag : 0u) | (report.paused ? paused_flag : 0u) |
         (report.stale ? stale_flag : 0u) | drive_flags(report.drive);
}

/// The session's rolling hash after a tick. `rolling`: with what the tick changed of the bone. `flags`: of
/// ops::Tick, those of no cause are passed over.
inline uint64_t hash_after(uint64_t rolling, uint32_t tick, uint32_t flags,
                           const QuantisedPose& grid_from_tool) noexcept {
  constexpr uint32_t drive_bits = reversed_flag | irrigating_flag | 255u << trigger_slack_shift;
  uint64_t h = hash_combine(tick, static_cast<uint64_t>((flags & spindle_on_flag) != 0) |
                                      static_cast<uint64_t>((flags & paused_flag) != 0) << 1 |
                                      static_cast<uint64_t>((flags & stale_flag) != 0) << 2 |
                                      static_cast<uint64_t>(flags & drive_bits) << 8);
  for (const int32_t q : grid_from_tool.rotation_q30) h = hash_combine(h, static_cast<uint32_t>(q));
  for (const int32_t q : grid_from_tool.translation_nm) h = hash_combine(h, static_cast<uint32_t>(q));
  return hash_combine(rolling, h);
}

}  // namespace ream::record
