#pragma once
#include <array>
#include <memory>

namespace ream::force {

/// Bone under the cutting surface in one tick, by class in the order cancellous, cortical, cartilage.
struct EngagedBone {
  std::array<double, 3> share{};  ///< of the engaged cutting points; sums to 1, or all 0 without contact
  std::array<double, 3> density_g_cc{};  ///< mean of the class
  double area_mm2 = 0.0;                 ///< of the cutting surface that is engaged

  bool any() const { return share[0] + share[1] + share[2] > 0.0; }
  double mean_density_g_cc() const {
    return share[0] * density_g_cc[0] + share[1] * density_g_cc[1] + share[2] * density_g_cc[2];
  }
};

/// What a spinning reamer meets in one tick.
struct CuttingLoad {
  double resistance_n_s_mm = 0.0;  ///< of full axial contact: thrust divided by feed rate
  double torque_arm_mm = 0.0;      ///< torque that turns the spindle, divided by thrust
};

/// How fast a spinning reamer sinks into bone, and what turns it. Deterministic and free of side effects:
/// called from the tick.
class FeedModel {
 public:
  virtual ~FeedModel() = default;
  /// Needs bone.any(). `thrust_n`: simulated thrust of the tick before, for laws that are not linear in it.
  virtual CuttingLoad load(const EngagedBone& bone, double thrust_n) const noexcept = 0;
};

/// The thesis' statistical model (eqs 5.1, 5.2): f(D, F) = (F / 52 N)(m D + b) per class. The classes under
/// the reamer act side by side, so their resistances add by share.
std::unique_ptr<FeedModel> make_empirical_feed_model();

/// Feed rate of one class (0 cancellous, 1 cortical, 2 cartilage) at the reference thrust, mm/s; never below
/// slowest_feed_mm_s.
double empirical_feed_mm_s(int bone_class, double density_g_cc) noexcept;

}  // namespace ream::force
