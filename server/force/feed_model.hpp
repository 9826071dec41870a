#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin_identity.hpp"
#include "force/coefficients.hpp"
#include "force/oblique_cutting.hpp"

namespace ream::force {

/// Bone under the cutting surface in one tick, by class in the order cancellous, cortical, cartilage.
struct EngagedBone {
  std::array<double, 3> share{};         ///< of the engaged cutting edge; sums to 1, or all 0 without contact
  std::array<double, 3> density_g_cc{};  ///< mean of the class
  double area_mm2 = 0.0;                 ///< of the cutting surface that is engaged
  /// Cutting edge that resists motion along the axis (or across it, where that is more): its length times the
  /// squared cosine between normal and motion.
  double edge_mm = 0.0;
  double resistance_s_mm = 0.0;  ///< mean of 1 / reference_feed_mm_s over the engaged edge

  bool any() const { return share[0] + share[1] + share[2] > 0.0; }
  double mean_density_g_cc() const {
    return share[0] * density_g_cc[0] + share[1] * density_g_cc[1] + share[2] * density_g_cc[2];
  }
};

/// What a spinning reamer meets in one tick.
struct CuttingLoad {
  double resistance_n_s_mm = 0.0;  ///< of full axial contact: thrust divided by feed rate
  double torque_arm_mm = 0.0;      ///< torque that turns the spindle, divided by thrust
  /// Load along the lips' path over that along the normal, wherever edge is engaged: gives torque and
  /// sideways force by place. 0: the model knows only torque_arm_mm.
  double tangential_ratio = 0.0;
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

enum class FeedKind { edge, empirical, oblique };

struct FeedSettings {
  FeedKind kind = FeedKind::empirical;  ///< recordings from before there was a choice
  /// Above 0. Every model keeps the feed per revolution at a given thrust (what machining assumes;
  /// engineering choice), so that the feed rate is proportional to it; at reference_spindle_rad_s it is the
  /// thesis' law.
  double spindle_rad_s = reference_spindle_rad_s;
  /// Feed of this specimen over the law's, above 0: specimens of one density differ. Those of table 5.1 range
  /// from 0.71 to 1.09 in cortical and from 0.91 to 1.10 in cancellous bone. Scales every class alike.
  double specimen_factor = 1.0;
  CuttingCoefficients cutting;
  std::optional<PluginIdentity> plugin = std::nullopt;  ///< whose model it is, in place of one of `kind`
};

/// A feed model as command line, scripts and recordings name it.
struct FeedModelEntry {
  const char* name;
  const char* description;  ///< a few words for people
  std::unique_ptr<FeedModel> (*make)(const FeedSettings& settings, const Lip& lip);
};
/// All there are, in the order of FeedKind. A new model is a FeedKind, a row of this table, and its name in
/// proto/script.schema.json.
std::span<const FeedModelEntry> feed_models();

const char* to_text(FeedKind kind);
/// The model of that name, or of its earlier name; empty for any other.
std::optional<FeedKind> find_feed_kind(std::string_view name);
/// The same; Error usage naming all models for any other.
FeedKind feed_kind_from_text(const std::string& text);
/// All names for messages, each between `quote`s: "edge, thesis or oblique".
std::string feed_model_names(const std::string& quote = "");

/// Errors: invalid_input when the lip cuts nothing, or its thrust does not rise with the feed; conflict when
/// the model is that of another plug-in than the one that was offered.
std::unique_ptr<FeedModel> make_feed_model(const FeedSettings& settings, const Lip& lip);

/// The feed model of a plug-in that has been loaded.
struct PluginFeedModel {
  PluginIdentity plugin;
  std::function<std::unique_ptr<FeedModel>(const FeedSettings& settings)> make;
};
/// From now on make_feed_model() makes it where settings name it; one a process, the last one. To be called
/// before there are sessions.
void offer_feed_model(PluginFeedModel model);
/// Whose model new sessions have; empty: none was offered.
std::optional<PluginIdentity> offered_feed_model();

/// Feed rate of one class (0 cancellous, 1 cortical, 2 cartilage) at the reference thrust and spindle speed,
/// mm/s: thesis eqs 5.1 and 5.2 times the specimen's factor; never below min_feed_mm_s.
double empirical_feed_mm_s(int bone_class, double density_g_cc, double specimen_factor = 1.0) noexcept;

/// 52 N over the feed rate that the law and the settings' spindle speed give, N s/mm. The classes under the
/// reamer act side by side, so their resistances add by share. Needs bone.any().
double lawful_resistance_n_s_mm(const EngagedBone& bone, const FeedSettings& settings) noexcept;

/// mm advanced a revolution.
double feed_a_revolution_mm(double feed_mm_s, double spindle_rad_s) noexcept;

/// Thrust and torque of all lips against the feed per revolution, for a specific cutting coefficient of 1
/// N/mm^2: thrust in N per N/mm^2 (mm^2), torque in N mm per N/mm^2 (mm^3). Linear between its rows and
/// beyond the last one; the first is all zero. Reading it takes comparison and + - x / only.
class FeedTable {
 public:
  /// Feeds and thrusts ascend strictly from 0; at least two rows.
  FeedTable(std::vector<double> feed_mm, std::vector<double> thrust_mm2, std::vector<double> torque_mm3);

  double thrust_mm2_at(double feed_mm) const noexcept;
  double torque_mm3_at(double feed_mm) const noexcept;
  /// The feed per revolution that takes this thrust.
  double feed_mm_at(double thrust_mm2) const noexcept;
  /// Of every bit in the table.
  uint64_t hash() const noexcept { return hash_; }

 private:
  std::vector<double> feed_mm_, thrust_mm2_, torque_mm3_;
  uint64_t hash_ = 0;
};

/// From 0 and 0.1 um a revolution to more than 5 mm in steps of a sixteenth, so that power laws are as true
/// at small feeds as at large ones. Error invalid_input when the lip is empty or thrust does not rise with
/// feed.
FeedTable make_feed_table(const Lip& lip, const CuttingCoefficients& coefficients, double spindle_rad_s);

}  // namespace ream::force
