#include "bench/timed_backend.hpp"

#include <utility>

#include "core/clock.hpp"

namespace ream::bench {
namespace {

constexpr double us_per_ns = 1e-3;

class TimedPhase final : public collide::NarrowPhase {
 public:
  TimedPhase(std::unique_ptr<collide::NarrowPhase> phase, TimingHistogram& times)
      : phase_(std::move(phase)), times_(times) {}
  bool contact(const QuantisedPose& grid_from_tool, const collide::Voi& voi,
               collide::ContactSums& sums) noexcept override {
    const int64_t begin_ns = steady_ns();
    const bool ok = phase_->contact(grid_from_tool, voi, sums);
    times_.add(static_cast<double>(steady_ns() - begin_ns) * us_per_ns);
    return ok;
  }
  bool bricks_changed(std::span<const uint32_t> bricks) noexcept override {
    return phase_->bricks_changed(bricks);
  }

 private:
  std::unique_ptr<collide::NarrowPhase> phase_;
  TimingHistogram& times_;
};

class TimedRemoval final : public collide::Removal {
 public:
  TimedRemoval(std::unique_ptr<collide::Removal> removal, TimingHistogram& times)
      : removal_(std::move(removal)), times_(times) {}
  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<collide::BrickOutcome> outcomes, collide::RemovalSums& sums) noexcept override {
    const int64_t begin_ns = steady_ns();
    const bool ok = removal_->cut(grid_from_tool, bricks, outcomes, sums);
    times_.add(static_cast<double>(steady_ns() - begin_ns) * us_per_ns);
    return ok;
  }

 private:
  std::unique_ptr<collide::Removal> removal_;
  TimingHistogram& times_;
};

}  // namespace

void time_stages(sim::Backend& backend, StageTimes& times) {
  backend.narrow_phase = std::make_unique<TimedPhase>(std::move(backend.narrow_phase), times.contact);
  if (backend.removal)
    backend.removal = std::make_unique<TimedRemoval>(std::move(backend.removal), times.removal);
}

}  // namespace ream::bench
