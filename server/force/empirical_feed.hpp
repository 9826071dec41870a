#pragma once
#include <memory>

#include "force/feed_model.hpp"

namespace ream::force {

/// The thesis' statistical model (eqs 5.1, 5.2): f(D, F) = (F / 52 N)(m D + b) per class, classes side by
/// side. The thesis has no torque: the arm is torque over thrust of the oblique model, for the same lips at
/// the feed that 52 N give.
std::unique_ptr<FeedModel> make_empirical_feed_model(const FeedSettings& settings, const Lip& lip);

}  // namespace ream::force
