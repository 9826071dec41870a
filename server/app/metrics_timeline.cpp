#include "app/metrics_timeline.hpp"

#include "core/error.hpp"

namespace ream::app {
namespace {

constexpr uint32_t ticks_per_second = 1000;

}  // namespace

MetricsTimeline::MetricsTimeline(const record::Recording& recording, const Pose& world_from_grid,
                                 const score::MetricsAccumulator& start)
    : recording_(recording), world_from_grid_(world_from_grid), seconds_{start} {
  reader_ = std::thread([this] { read_all(); });
}

MetricsTimeline::~MetricsTimeline() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  reader_.join();
}

void MetricsTimeline::read_all() {
  std::string damage;
  try {
    score::MetricsAccumulator metrics = seconds_.front();
    const uint32_t whole_seconds = recording_.tick_count() / ticks_per_second;
    for (uint32_t second = 0; second < whole_seconds; ++second) {
      recording_.for_each_tick(
          second * ticks_per_second, (second + 1) * ticks_per_second,
          [&](const record::ops::Tick& tick) { metrics.add(record::report_of(tick, world_from_grid_)); });
      {
        const std::lock_guard lock(mutex_);
        if (leaving_) return;
        seconds_.push_back(metrics);
      }
      grown_.notify_all();
    }
  } catch (const Error& e) {
    damage = e.what();
  }
  {
    const std::lock_guard lock(mutex_);
    damage_ = damage;
    done_ = true;
  }
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
  const size_t second = ticks / ticks_per_second;
  if (second >= seconds_.size()) return std::nullopt;
  const score::MetricsAccumulator before = seconds_[second];
  lock.unlock();
  return from_second(before, ticks);
}

score::MetricsAccumulator MetricsTimeline::wait_for(uint32_t ticks) const {
  std::unique_lock lock(mutex_);
  const size_t second = ticks / ticks_per_second;
  grown_.wait(lock, [&] { return done_ || second < seconds_.size(); });
  if (second >= seconds_.size()) throw Error(ErrorKind::invalid_input, damage_);
  const score::MetricsAccumulator before = seconds_[second];
  lock.unlock();
  return from_second(before, ticks);
}

}  // namespace ream::app
