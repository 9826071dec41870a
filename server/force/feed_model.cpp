#include "force/feed_model.hpp"

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "force/edge_load.hpp"

namespace ream::force {
namespace {

constexpr double min_feed_mm = 1e-4, max_feed_mm = 5.0;
constexpr double feed_ratio = 17.0 / 16.0;

/// `y` at `at` on the line through the two rows of the ascending `x` around it.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) noexcept {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = static_cast<size_t>(above - x.begin());
  return y[i - 1] + (at - x[i - 1]) * ((y[i] - y[i - 1]) / (x[i] - x[i - 1]));
}

/// The thesis' statistical model (eqs 5.1, 5.2): f(D, F) = (F / 52 N)(m D + b) per class, classes side by
/// side. The thesis has no torque: the arm is torque over thrust of the oblique model, for the same lips at
/// the feed that 52 N give.
class EmpiricalFeedModel final : public FeedModel {
 public:
  EmpiricalFeedModel(const FeedSettings& settings, const Lip& lip)
      : settings_(settings), table_(make_feed_table(lip, settings.cutting, settings.spindle_rad_s)) {}

  CuttingLoad load(const EngagedBone& bone, double) const noexcept override {
    const double resistance = lawful_resistance_n_s_mm(bone, settings_);
    const double feed_mm = feed_a_revolution_mm(reference_thrust_n / resistance, settings_.spindle_rad_s);
    return {resistance, table_.torque_mm3_at(feed_mm) / table_.thrust_mm2_at(feed_mm)};
  }
  uint64_t table_hash() const noexcept override { return table_.hash(); }

 private:
  FeedSettings settings_;
  FeedTable table_;
};

/// Appendix A: thrust and torque of the lips at a feed per revolution, with kc(D) such that at the reference
/// spindle speed 52 N give the feed law's f(D). Classes under the reamer act side by side: their kc add by
/// share. Thrust against feed is the table's, so resistance is the secant at the last tick's thrust (from the
/// start threshold up). Full contact is assumed, whatever the engaged area, as in the thesis' model.
class ObliqueFeedModel final : public FeedModel {
 public:
  ObliqueFeedModel(const FeedSettings& settings, const Lip& lip)
      : settings_(settings),
        calibration_(make_feed_table(lip, settings.cutting, reference_spindle_rad_s)),
        table_(make_feed_table(lip, settings.cutting, settings.spindle_rad_s)) {}

  CuttingLoad load(const EngagedBone& bone, double thrust_n) const noexcept override {
    const double thrust = std::max(thrust_n, start_threshold_n);
    const double thrust_mm2 = thrust / specific_coefficient_n_mm2(bone);
    const double feed_mm = table_.feed_mm_at(thrust_mm2);
    const double feed_mm_s = feed_mm * settings_.spindle_rad_s / (2.0 * pi);
    return {thrust / feed_mm_s, table_.torque_mm3_at(feed_mm) / thrust_mm2};
  }
  uint64_t table_hash() const noexcept override { return hash_combine(calibration_.hash(), table_.hash()); }

 private:
  /// K of the bone under the reamer: 52 N at f(D) on the reference spindle.
  double specific_coefficient_n_mm2(const EngagedBone& bone) const noexcept {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      if (bone.share[i] <= 0.0) continue;
      const double feed_mm_s = empirical_feed_mm_s(k, bone.density_g_cc[i], settings_.specimen_factor);
      const double feed_mm = feed_a_revolution_mm(feed_mm_s, reference_spindle_rad_s);
      sum += bone.share[i] * reference_thrust_n / calibration_.thrust_mm2_at(feed_mm);
    }
    return sum;
  }

  FeedSettings settings_;
  FeedTable calibration_, table_;
};

template <typename Model>
std::unique_ptr<FeedModel> make(const FeedSettings& settings, const Lip& lip) {
  return std::make_unique<Model>(settings, lip);
}

constexpr std::array models{
    FeedModelEntry{"edge", "load along the engaged cutting edge", make<EdgeFeedModel>},
    FeedModelEntry{"thesis", "the thesis' law, whatever part of the reamer touches",
                   make<EmpiricalFeedModel>},
    FeedModelEntry{"oblique", "cutting mechanics of its appendix A", make<ObliqueFeedModel>}};

std::optional<PluginFeedModel>& offered() {
  static std::optional<PluginFeedModel> model;
  return model;
}

}  // namespace

double empirical_feed_mm_s(int bone_class, double density_g_cc, double specimen_factor) noexcept {
  const FeedLaw& law = bone_class == 1 ? cortical_feed_law : cancellous_feed_law;
  const double feed_mm_s =
      bone_class == 2 ? cartilage_feed_mm_s : law.slope_mm_s_per_g_cc * density_g_cc + law.intercept_mm_s;
  return std::max(min_feed_mm_s, specimen_factor * feed_mm_s);
}

double lawful_resistance_n_s_mm(const EngagedBone& bone, const FeedSettings& settings) noexcept {
  double resistance = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    if (bone.share[i] > 0.0)
      resistance += bone.share[i] * reference_thrust_n /
                    empirical_feed_mm_s(k, bone.density_g_cc[i], settings.specimen_factor);
  }
  return resistance * (reference_spindle_rad_s / settings.spindle_rad_s);
}

double feed_a_revolution_mm(double feed_mm_s, double spindle_rad_s) noexcept {
  return feed_mm_s * (2.0 * pi) / spindle_rad_s;
}

FeedTable::FeedTable(std::vector<double> feed_mm, std::vector<double> thrust_mm2,
                     std::vector<double> torque_mm3)
    : feed_mm_(std::move(feed_mm)), thrust_mm2_(std::move(thrust_mm2)), torque_mm3_(std::move(torque_mm3)) {
  for (const std::vector<double>* column : {&feed_mm_, &thrust_mm2_, &torque_mm3_})
    for (const double value : *column) hash_ = hash_combine(hash_, std::bit_cast<uint64_t>(value));
}

double FeedTable::thrust_mm2_at(double feed_mm) const noexcept {
  return interpolated(feed_mm_, thrust_mm2_, feed_mm);
}

double FeedTable::torque_mm3_at(double feed_mm) const noexcept {
  return interpolated(feed_mm_, torque_mm3_, feed_mm);
}

double FeedTable::feed_mm_at(double thrust_mm2) const noexcept {
  return interpolated(thrust_mm2_, feed_mm_, thrust_mm2);
}

FeedTable make_feed_table(const Lip& lip, const CuttingCoefficients& coefficients, double spindle_rad_s) {
  std::vector<double> feeds{0.0}, thrusts{0.0}, torques{0.0};
  double feed_mm = min_feed_mm;
  while (feeds.back() < max_feed_mm) {
    const LipLoad load = whole_load(lip_loads(lip, coefficients, {feed_mm, spindle_rad_s, 1.0}));
    if (!(load.thrust_n > thrusts.back()))
      throw Error(ErrorKind::invalid_input,
                  "the tool's lips take no more thrust when they are fed faster; use a tool with a cutting "
                  "surface beyond a sixth of its radius, or a larger friction coefficient");
    feeds.push_back(feed_mm);
    thrusts.push_back(load.thrust_n);
    torques.push_back(load.torque_n_mm);
    feed_mm *= feed_ratio;
  }
  return {std::move(feeds), std::move(thrusts), std::move(torques)};
}

std::span<const FeedModelEntry> feed_models() { return models; }

const char* to_text(FeedKind kind) { return models[static_cast<size_t>(kind)].name; }

std::optional<FeedKind> find_feed_kind(std::string_view name) {
  for (size_t i = 0; i < models.size(); ++i)
    if (name == models[i].name) return static_cast<FeedKind>(i);
  if (name == "empirical") return FeedKind::empirical;
  return std::nullopt;
}

FeedKind feed_kind_from_text(const std::string& text) {
  if (const auto kind = find_feed_kind(text)) return *kind;
  throw Error(ErrorKind::usage, "feed model \"" + text + "\" is not known; use " + feed_model_names());
}

std::string feed_model_names(const std::string& quote) {
  std::string names;
  for (size_t i = 0; i < models.size(); ++i)
    names += (i == 0 ? "" : i + 1 < models.size() ? ", " : " or ") + quote + models[i].name + quote;
  return names;
}

std::unique_ptr<FeedModel> make_feed_model(const FeedSettings& settings, const Lip& lip) {
  if (!settings.plugin) return models[static_cast<size_t>(settings.kind)].make(settings, lip);
  if (offered_feed_model() != settings.plugin)
    throw Error(ErrorKind::conflict,
                "the session was made with " + settings.plugin->in_words() + ": give its file with --plugin" +
                    (offered() ? "; the one that was given is " + offered()->plugin.in_words() : ""));
  return offered()->make(settings);
}

void offer_feed_model(PluginFeedModel model) { offered() = std::move(model); }

std::optional<PluginIdentity> offered_feed_model() {
  return offered() ? std::optional(offered()->plugin) : std::nullopt;
}

}  // namespace ream::force
