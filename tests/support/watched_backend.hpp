#pragma once
#include <utility>

#include "collide/narrow_phase.hpp"

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

}  // namespace ream::test
