#pragma once
#include "force/feed_model.hpp"

namespace ream::force {

/// Feed rate of one class (0 cancellous, 1 cortical, 2 cartilage) at the reference thrust and spindle speed,
/// mm/s: thesis eqs 5.1 and 5.2 times the specimen's factor; never below slowest_feed_mm_s.
double empirical_feed_mm_s(int bone_class, double density_g_cc, double specimen_factor = 1.0) noexcept;

/// 52 N over the feed rate that the law and the settings' spindle speed give, N s/mm. The classes under the
/// reamer act side by side, so their resistances add by share. Needs bone.any().
double lawful_resistance_n_s_mm(const EngagedBone& bone, const FeedSettings& settings) noexcept;

/// mm advanced a revolution.
double feed_a_revolution_mm(double feed_mm_s, double spindle_rad_s) noexcept;

}  // namespace ream::force
