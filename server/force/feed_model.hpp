#pragma once
#include <array>
#include <memory>

namespace ream::force {

/// Bone under the cutting surface in one tick, by class in the order cancellous, cortical, cartilage.
struct EngagedBone {
  std::array<double, 3> share{};  ///< of the engaged cutting points; sums to 1, or all 0 without contact
  std::array<double, 3> density_g_cc{};  ///< mean of the class

  bool any() const { return share[0] + share[1] + share[2] > 0.0; }
  double mean_density_g_cc() const {
    return share[0] * density_g_cc[0] + share[1] * density_g_cc[1] + share[2] * density_g_cc[2];
  }
};

/// How fast a spinning reamer sinks into bone. Deterministic and free of side effects: called from the tick.
class FeedModel {
 public:
  virtual ~FeedModel() = default;
  /// Resistance of full axial contact, N s/mm: thrust divided by feed rate. Needs bone.any().
  virtual double resistance_n_s_mm(const EngagedBone& bone) const noexcept = 0;
};

/// The thesis' statistical model (eqs 5.1, 5.2): f(D, F) = (F / 52 N)(m D + b) per class. The classes under
/// the reamer act side by side, so their resistances add by share.
std::unique_ptr<FeedModel> make_empirical_feed_model();

/// Feed rate of one class (0 cancellous, 1 cortical, 2 cartilage) at the reference thrust, mm/s; never below
/// slowest_feed_mm_s.
double empirical_feed_mm_s(int bone_class, double density_g_cc) noexcept;

}  // namespace ream::force
