#pragma once
#include <optional>
#include <vector>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// A sphere on the articular surface of a humeral head; world (LPS) mm.
struct HumeralHead {
  Vec3 centre_mm = Vec3::Zero();
  double radius_mm = 0.0;
  double share = 0.0;  ///< of all directions from the centre, those in which bone ends on the sphere, 0 to 1
};

/// Humeral heads have radii between these (18 to 32 mm: small women to large men, with room).
inline constexpr double min_head_radius_mm = 18.0, max_head_radius_mm = 32.0;

/// Best spheres in a CT, the best first, at most twelve and 20 mm apart. Places are voted for along the
/// gradient from where bone borders soft tissue (Ballard's generalised Hough transform, 1981), then the
/// sphere is fitted by least squares to the bone's outer surface. Vertebrae and ribs give low shares.
std::vector<HumeralHead> head_candidates(const HuVolume& volume, double threshold_hu);

/// The sphere fitted from a guess of its centre, up to about 8 mm off; empty when no bone surface lies about
/// it.
std::optional<HumeralHead> fitted_head(const HuVolume& volume, double threshold_hu, const Vec3& near_mm);

}  // namespace ream::ct
