#include "stream/telemetry.hpp"

#include <utility>

#include "core/clock.hpp"
#include "stream/fanout.hpp"

namespace ream::stream {

TelemetryBatcher::TelemetryBatcher(Fanout& fanout, uint32_t tick_stride, int64_t interval_ns)
    : fanout_(fanout), tick_stride_(tick_stride), interval_ns_(interval_ns) {
  batch_.tick_stride = tick_stride;
}

void TelemetryBatcher::add(const TelemetrySample& sample) {
  const uint32_t step = sample.tick - last_tick_;
  if (any_ && step != tick_stride_) {
    flush();
    if (sample.tick > last_tick_) batch_.lost_before += (step - 1) / tick_stride_;
  }
  any_ = true;
  last_tick_ = sample.tick;
  batch_.samples.push_back(sample);
}

void TelemetryBatcher::publish_if_due(int64_t now_ns) {
  if (now_ns < next_publish_ns_ || batch_.samples.empty()) return;
  next_publish_ns_ = now_ns + interval_ns_;
  flush();
}

void TelemetryBatcher::flush() {
  if (batch_.samples.empty()) return;
  batch_.stamp_us = steady_ns() / 1000;
  TelemetryBatch next;
  next.tick_stride = tick_stride_;
  fanout_.publish_telemetry(std::make_shared<const TelemetryBatch>(std::exchange(batch_, std::move(next))));
}

void TelemetryBatcher::jump() {
  flush();
  any_ = false;
}

}  // namespace ream::stream
