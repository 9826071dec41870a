#include "force/edge_load.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/hash.hpp"

namespace ream::force {
namespace {

struct FittedRange {
  double low_g_cc, high_g_cc;
};
constexpr FittedRange cancellous{0.41, 0.72}, cortical{1.30, 1.61};  ///< thesis table 5.1

constexpr double line(const FeedLaw& law, double density_g_cc) {
  return law.slope_mm_s_per_g_cc * density_g_cc + law.intercept_mm_s;
}

/// Chips are no thicker than a lip is high, mm. Engineering choice.
constexpr double max_chip_mm = 0.4;
/// What blocks: N s/mm.
constexpr double blocked_n_s_mm = 1e7;

double power(double feed_mm_s, double ratio, double exponent) {
  return feed_mm_s * std::pow(ratio, exponent);
}

}  // namespace

double reference_feed_mm_s(double density_g_cc) noexcept {
  const double at_low = line(cancellous_feed_law, cancellous.low_g_cc),
               at_high = line(cancellous_feed_law, cancellous.high_g_cc),
               at_hard = line(cortical_feed_law, cortical.low_g_cc),
               at_hardest = line(cortical_feed_law, cortical.high_g_cc);
  // No bone is lighter; 0.7 mm/s.
  const double density = std::max(density_g_cc, 0.25);
  if (density < cancellous.low_g_cc) return power(at_low, density / cancellous.low_g_cc, -1.86);
  if (density <= cancellous.high_g_cc) return line(cancellous_feed_law, density);
  if (density < cortical.low_g_cc) {
    const double exponent = std::log(at_hard / at_high) / std::log(cortical.low_g_cc / cancellous.high_g_cc);
    return power(at_high, density / cancellous.high_g_cc, exponent);
  }
  if (density <= cortical.high_g_cc) return line(cortical_feed_law, density);
  return power(at_hardest, density / cortical.high_g_cc, -2.3);
}

bool is_fitted_density(double density_g_cc) noexcept {
  for (const FittedRange& range : {cancellous, cortical})
    if (density_g_cc >= range.low_g_cc && density_g_cc <= range.high_g_cc) return true;
  return false;
}

std::array<uint32_t, 256> edge_resistances(double density_step_g_cc, size_t cartilage_code) {
  std::array<uint32_t, 256> table;
  for (size_t code = 0; code < table.size(); ++code) {
    const double feed_mm_s = code == cartilage_code
                                 ? cartilage_feed_mm_s
                                 : reference_feed_mm_s(static_cast<double>(code) * density_step_g_cc);
    table[code] =
        static_cast<uint32_t>(std::clamp(std::lround(edge_resistance_codes_s_mm / feed_mm_s), 1L, 4095L));
  }
  return table;
}

CuttingCoefficients cutting_from_json(JsonReader reader) {
  CuttingCoefficients c;
  c.edge_reference_mm = reader.number_or("edge_reference_mm", c.edge_reference_mm, 5.0, 100.0);
  c.edge_threshold_share = reader.number_or("edge_threshold_share", c.edge_threshold_share, 0.0, 0.95);
  c.tangential_ratio = reader.number_or("tangential_ratio", c.tangential_ratio, 0.1, 3.0);
  reader.finish();
  return c;
}

nlohmann::json to_json(const CuttingCoefficients& cutting) {
  return {{"edge_reference_mm", cutting.edge_reference_mm},
          {"edge_threshold_share", cutting.edge_threshold_share},
          {"tangential_ratio", cutting.tangential_ratio}};
}

EdgeFeedModel::EdgeFeedModel(const FeedSettings& settings, const Lip&)
    : settings_(settings),
      load_n_mm_(reference_thrust_n / settings.cutting.edge_reference_mm),
      max_feed_mm_s_(max_chip_mm * lip_count * settings.spindle_rad_s / (2.0 * pi)) {}

CuttingLoad EdgeFeedModel::load(const EngagedBone& bone, double thrust_n) const noexcept {
  const double threshold_share = settings_.cutting.edge_threshold_share;
  const double thrust = std::max(thrust_n, start_threshold_n);
  const double left_n = thrust - threshold_share * load_n_mm_ * bone.edge_mm;
  CuttingLoad load;
  load.tangential_ratio = settings_.cutting.tangential_ratio;
  if (left_n <= 0.0) {
    load.resistance_n_s_mm = blocked_n_s_mm;
    return load;
  }
  const double slower = reference_spindle_rad_s / (settings_.spindle_rad_s * settings_.specimen_factor);
  const double resistance = load_n_mm_ * bone.edge_mm * bone.resistance_s_mm * slower;
  load.resistance_n_s_mm = std::min(blocked_n_s_mm, resistance * (1.0 - threshold_share) * thrust / left_n);
  load.resistance_n_s_mm = std::max(load.resistance_n_s_mm, thrust / max_feed_mm_s_);
  return load;
}

uint64_t EdgeFeedModel::table_hash() const noexcept {
  uint64_t hash = 0;
  for (const uint32_t code : edge_resistances(0.01, 255)) hash = hash_combine(hash, code);
  return hash;
}

}  // namespace ream::force
