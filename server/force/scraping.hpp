#pragma once
#include <memory>

#include "force/feed_model.hpp"

namespace ream::force {

/// Experimental: bone is worn off rather than cut (Archard 1953, Preston 1927; thesis 5.2 suspects scraping
/// at 156 rpm). The depth worn a second is k p v, with pressure p and sliding speed v = 2 pi r n at n
/// revolutions a second. A cap that sinks evenly at f into a footprint of radius R needs
///   p(r) = f / (2 pi k n r),   thrust F = integral of p 2 pi r dr over the footprint = f R / (k n),
///   torque M = integral of friction p r 2 pi r dr = friction f R^2 / (2 k n) = friction F R / 2.
/// So resistance grows with the square root of the engaged area A = pi R^2. k follows from the feed law: with
/// the area of the planned seating, `seated_area_mm2`, 52 N give f(D). That area takes the bone as flat:
/// where a hollow glenoid lets more of the cap touch, feed is slower than the law.
std::unique_ptr<FeedModel> make_scraping_feed_model(const FeedSettings& settings, double seated_area_mm2);

}  // namespace ream::force
