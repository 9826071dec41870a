#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "force/coefficients.hpp"
#include "force/oblique_cutting.hpp"

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
  /// Of every number that was computed ahead and that load() reads; 0 when there is none.
  virtual uint64_t table_hash() const noexcept { return 0; }
};

enum class FeedKind {
  empirical,  ///< the thesis' statistical law, eqs 5.1 and 5.2
  oblique,    ///< the mechanics of appendix A, calibrated with the law
  scraping,   ///< experimental: wear under pressure, calibrated with the law
};

const char* to_text(FeedKind kind);
/// The words of to_text; Error usage for others.
FeedKind feed_kind_from_text(const std::string& text);

struct FeedSettings {
  FeedKind kind = FeedKind::empirical;
  /// Above 0. Every model keeps the feed per revolution at a given thrust (what machining assumes;
  /// engineering choice), so that the feed rate is proportional to it; at reference_spindle_rad_s it is the
  /// thesis' law.
  double spindle_rad_s = reference_spindle_rad_s;
  /// Feed of this specimen over the law's, above 0: specimens of one density differ. Those of table 5.1 range
  /// from 0.71 to 1.09 in cortical and from 0.91 to 1.10 in cancellous bone. Scales every class alike.
  double specimen_factor = 1.0;
  CuttingCoefficients cutting;
};

/// What a feed model knows of the tool.
struct CuttingTool {
  Lip lip;
  double seated_area_mm2 = 1.0;  ///< of the cutting surface in bone at the planned seating, above 0
};

/// Errors: invalid_input when the lip cuts nothing, or its thrust does not rise with the feed.
std::unique_ptr<FeedModel> make_feed_model(const FeedSettings& settings, const CuttingTool& tool);

}  // namespace ream::force
