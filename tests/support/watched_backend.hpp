#pragma once
#include <utility>

#include "collide/contact/narrow_phase.hpp"
#include "collide/removal/removal.hpp"

namespace ream::test {

/// Counts how often a narrow phase is asked.
class CountingNarrowPhase final : public collide::NarrowPhase {
 public:
  CountingNarrowPhase(std::unique_ptr<collide::NarrowPhase> inner, int& calls)
      : inner_(std::move(inner)), calls_(calls) {}
  bool contact(const QuantisedPose& grid_from_tool, const collide::Voi& voi,
               collide::ContactSums& sums) noexcept override {
    ++calls_;
    return inner_->contact(grid_from_tool, voi, sums);
  }

 private:
  std::unique_ptr<collide::NarrowPhase> inner_;
  int& calls_;
};

/// Works until its device fails at a call, and never again.
class FailingNarrowPhase final : public collide::NarrowPhase {
 public:
  FailingNarrowPhase(std::unique_ptr<collide::NarrowPhase> inner, int good_calls,
                     bool fails_when_told = false)
      : inner_(std::move(inner)), good_calls_(good_calls), fails_when_told_(fails_when_told) {}
  bool contact(const QuantisedPose& grid_from_tool, const collide::Voi& voi,
               collide::ContactSums& sums) noexcept override {
    const bool fails = !fails_when_told_ && good_calls_-- <= 0;
    const bool ok = inner_->contact(grid_from_tool, voi, sums);
    if (fails) sums.cutting.points += 1000;
    return ok && !fails;
  }
  bool bricks_changed(std::span<const uint32_t>) noexcept override {
    return !fails_when_told_ || good_calls_-- > 0;
  }

 private:
  std::unique_ptr<collide::NarrowPhase> inner_;
  int good_calls_;
  bool fails_when_told_;
};

/// Works until its device fails at a call, with half of the bricks cut and nothing true in the answer.
class FailingRemoval final : public collide::Removal {
 public:
  FailingRemoval(std::unique_ptr<collide::Removal> inner, int good_calls)
      : inner_(std::move(inner)), good_calls_(good_calls) {}
  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<collide::BrickOutcome> outcomes, collide::RemovalSums& sums) noexcept override {
    if (good_calls_-- > 0) return inner_->cut(grid_from_tool, bricks, outcomes, sums);
    inner_->cut(grid_from_tool, bricks.first((bricks.size() + 1) / 2), outcomes, sums);
    for (auto& outcome : outcomes) outcome = {true, true, 0.0f};
    sums.change_hash = 12345;
    return false;
  }

 private:
  std::unique_ptr<collide::Removal> inner_;
  int good_calls_;
};

}  // namespace ream::test
