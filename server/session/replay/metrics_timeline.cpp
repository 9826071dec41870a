#include "session/replay/metrics_timeline.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/signal_handlers.hpp"

namespace ream::session {
namespace {

constexpr uint32_t ticks_per_second = 1000;

Error lacks_tick(const record::Recording& recording, uint32_t tick) {
  return {ErrorKind::invalid_input, recording.log().path().string() + " is damaged: it lacks tick " +
                                        std::to_string(tick) + " where it should be"};
}

}  // namespace

MetricsTimeline::MetricsTimeline(const record::Recording& recording, const Pose& world_from_grid,
                                 const score::MetricsAccumulator& start)
    : recording_(recording), world_from_grid_(world_from_grid), seconds_{start} {
  reader_ = start_thread([this] { read_all(); });
}

MetricsTimeline::~MetricsTimeline() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  reader_.join();
}

void MetricsTimeline::read_all() {
  uint32_t reached = 0;
  std::string damage;
  try {
    score::MetricsAccumulator metrics = seconds_.front();
    while (reached < recording_.tick_count()) {
      recording_.for_each_tick(reached, std::min(reached + ticks_per_second, recording_.tick_count()),
                               [&](const record::ops::Tick& tick) {
                                 if (tick.tick != reached) throw lacks_tick(recording_, reached);
                                 metrics.add(record::report_of(tick, world_from_grid_));
                                 ++reached;
                               });
      const std::lock_guard lock(mutex_);
      if (stopping_) return;
      if (reached == reached_ticks_) throw lacks_tick(recording_, reached);
      reached_ticks_ = reached;
      if (reached == seconds_.size() * ticks_per_second) seconds_.push_back(metrics);
      grown_.notify_all();
    }
  } catch (const std::exception& e) {
    damage = e.what();
  }
  const std::lock_guard lock(mutex_);
  reached_ticks_ = reached;
  damage_ = std::move(damage);
  done_ = true;
  grown_.notify_all();
}

score::MetricsAccumulator MetricsTimeline::from_second(const score::MetricsAccumulator& second,
                                                       uint32_t ticks) const {
  score::MetricsAccumulator metrics = second;
  recording_.for_each_tick(ticks - ticks % ticks_per_second, ticks, [&](const record::ops::Tick& tick) {
    metrics.add(record::report_of(tick, world_from_grid_));
  });
  return metrics;
}

std::optional<score::MetricsAccumulator> MetricsTimeline::at(uint32_t ticks) const {
  std::unique_lock lock(mutex_);
  if (ticks > reached_ticks_) return std::nullopt;
  const score::MetricsAccumulator before = seconds_.at(ticks / ticks_per_second);
  lock.unlock();
  return from_second(before, ticks);
}

score::MetricsAccumulator MetricsTimeline::wait_for(uint32_t ticks, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  grown_.wait_for(lock, timeout, [&] { return done_ || ticks <= reached_ticks_; });
  if (ticks > reached_ticks_ && !done_)
    throw Error(ErrorKind::unavailable,
                "the recording is still being read up to this moment; ask again in a few seconds");
  if (ticks > reached_ticks_) throw Error(ErrorKind::invalid_input, damage_);
  const score::MetricsAccumulator before = seconds_.at(ticks / ticks_per_second);
  lock.unlock();
  return from_second(before, ticks);
}

RecordingDamage MetricsTimeline::damage() const {
  const std::lock_guard lock(mutex_);
  return {reached_ticks_, damage_};
}

}  // namespace ream::session
