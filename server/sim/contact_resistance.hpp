#pragma once
#include "force/coupling.hpp"
#include "force/feed_model.hpp"
#include "sim/state.hpp"

namespace ream::sim {

/// Shares, mean densities and area of what the cutting surface engages.
force::EngagedBone engaged_bone(const Model& model, const collide::ContactSums& sums) noexcept;

/// The 6x6 resistance of DESIGN 3 from the contact sums: scaled so that full axial contact has the feed
/// model's resistance, whatever the engaged area. A standing spindle (or thrust too small to cut) makes
/// cutting contact block like guiding contact.
force::Resistance contact_resistance(const Model& model, const collide::ContactSums& sums,
                                     double resistance_n_s_mm, bool cuts) noexcept;

}  // namespace ream::sim
