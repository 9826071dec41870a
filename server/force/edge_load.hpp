#pragma once
#include "core/json_reader.hpp"
#include "force/feed_model.hpp"

namespace ream::force {

/// Feed rate at the reference thrust and spindle speed of the thesis' reamer, fully seated, mm/s: eqs 5.1 and
/// 5.2 where they were fitted, and power laws that join them elsewhere (one such law, D^-1.86, fits all
/// twelve specimens of table 5.1 with R^2 0.965). Falls with density and never reaches zero.
double reference_feed_mm_s(double density_g_cc) noexcept;

/// True where reference_feed_mm_s was fitted.
bool is_fitted_density(double density_g_cc) noexcept;

/// 1 / reference_feed_mm_s by density code, code 0 first, `density_step_g_cc` apart; at `cartilage_code` that
/// of cartilage. In 1/edge_resistance_codes_s_mm, 1 to 4095.
std::array<uint32_t, 256> edge_resistances(double density_step_g_cc, size_t cartilage_code);
inline constexpr double edge_resistance_codes_s_mm = 32.0;

/// The key "cutting" of scripts and cases (proto/script.schema.json): what of EdgeFeedModel's
/// coefficients it says. Consumes the reader.
CuttingCoefficients cutting_from_json(JsonReader reader);
nlohmann::json to_json(const CuttingCoefficients& cutting);

/// Feed by the cutting edge that is engaged, anchored at the thesis. At a place at radius r pass lip_count
/// lips a turn, so edge per area is lip_count / (2 pi r). Every lip takes a chip as thick as the surface
/// sinks in between, h = f cos(theta) / (n lip_count), and a load along its edge
///   q = q_ref [phi + (1 - phi) h / h_ref(D)],   q_ref = 52 N / edge_reference_mm,   h_ref(D) at f(D), 52 N
/// along the surface's normal. Thrust is the sum over the engaged edge. So twice the edge feeds half as fast,
/// a rim cuts at once, and what a removed volume costs is the same for every contact.
class EdgeFeedModel final : public FeedModel {
 public:
  EdgeFeedModel(const FeedSettings& settings, const Lip& lip);
  CuttingLoad load(const EngagedBone& bone, double thrust_n) const noexcept override;
  uint64_t table_hash() const noexcept override;

 private:
  FeedSettings settings_;
  double load_n_mm_;      ///< q_ref
  double max_feed_mm_s_;  ///< lips are only so high
};

}  // namespace ream::force
