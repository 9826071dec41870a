#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "collide/removal/removal.hpp"

namespace ream::test {

/// What a removal did to a list of bricks of any length, cut in as few calls as the interface allows.
struct CutAnswer {
  std::vector<collide::BrickOutcome> outcomes;
  collide::RemovalSums sums;
};

inline CutAnswer cut_bricks(collide::Removal& removal, const QuantisedPose& pose,
                            std::span<const uint32_t> bricks) {
  CutAnswer answer;
  answer.outcomes.resize(bricks.size());
  for (size_t done = 0; done < bricks.size(); done += collide::max_bricks_per_cut) {
    const size_t count = std::min(collide::max_bricks_per_cut, bricks.size() - done);
    collide::RemovalSums sums;
    EXPECT_TRUE(removal.cut(pose, bricks.subspan(done, count),
                            std::span(answer.outcomes).subspan(done, count), sums));
    answer.sums.change_hash += sums.change_hash;
    answer.sums.changed_bricks += sums.changed_bricks;
    for (size_t k = 0; k < sums.coverage_removed.size(); ++k)
      answer.sums.coverage_removed[k] += sums.coverage_removed[k];
  }
  return answer;
}

}  // namespace ream::test
