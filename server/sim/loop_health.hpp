#pragma once
#include <cstdint>
#include <string>

#include "core/timing_histogram.hpp"
#include "device/haptic_device.hpp"
#include "sim/realtime.hpp"

namespace ream::sim {

enum class LoopEnd : uint8_t {
  running,
  finished,          ///< the device's script came to its end
  stopped,           ///< stop() was called
  device_fault,      ///< the device could not be read or written
  collision_failed,  ///< the OpenCL device failed
  not_finite,        ///< a pose or force was not a number
  stood_still,       ///< the loop did not tick for too long, and the force was taken away meanwhile
  followers_late,    ///< the recording could not keep up; nothing may be lost, so the session ends
};

/// One sentence for people; empty while running, finished or stopped.
std::string message_of(LoopEnd end);

/// One sentence for people about a device that failed while the session went on.
std::string failover_message(int64_t tick);

/// Health of the loop as others may read it at any time.
struct LoopHealth {
  LoopEnd end = LoopEnd::running;
  uint32_t tick = 0;
  uint64_t missed = 0;            ///< ticks that began more than a millisecond late
  int64_t failed_over_tick = -1;  ///< the tick in which the OpenCL device failed and the C++ form took over
  TimingSummary tick_us, lateness_us;
  TimingSummary read_us, step_us, write_us;  ///< the parts of a tick
  RealtimeGrant realtime;
  device::LinkState link = device::LinkState::lost;  ///< of the device
  uint64_t losses = 0;                               ///< how often the device was lost
  int64_t lost_tick = -1;                            ///< when last; -1: never
};

}  // namespace ream::sim
