#pragma once
#include <memory>

#include "force/feed_model.hpp"

namespace ream::force {

/// Appendix A: thrust and torque of the lips at a feed per revolution, with kc(D) such that at the reference
/// spindle speed 52 N give the feed law's f(D). Classes under the reamer act side by side: their kc add by
/// share. Thrust against feed is the table's, so resistance is the secant at the last tick's thrust (from the
/// start threshold up). Full contact is assumed, whatever the engaged area, as in the empirical model.
std::unique_ptr<FeedModel> make_oblique_feed_model(const FeedSettings& settings, const Lip& lip);

}  // namespace ream::force
