#include <sstream>

#include "bench/validate/parallel.hpp"
#include "bench/validate/steady_reaming.hpp"
#include "bench/validate/validate_parts.hpp"

namespace ream::bench {
namespace {

constexpr double agreement_goal_percent = 1.0, ripple_goal_percent = 2.0;
constexpr std::array densities_g_cc{1.52, 0.55};  ///< the first specimen's

}  // namespace

std::vector<Row> steady_rows(const Options&) {
  SteadyReaming impedance[densities_g_cc.size()], admittance[densities_g_cc.size()];
  in_parallel(2 * densities_g_cc.size(), [&](size_t i) {
    const double density = densities_g_cc[i / 2];
    if (i % 2 == 0)
      impedance[i / 2] = steady_reaming(density, published_thrust_n);
    else
      admittance[i / 2] = steady_reaming(density, published_thrust_n, 1.0, "ideal-admittance");
  });
  std::vector<Row> rows;
  for (size_t i = 0; i < densities_g_cc.size(); ++i) {
    std::ostringstream where;
    where << " at " << densities_g_cc[i] << " g/cc and 52 N";
    rows.push_back({"validate", "feed, admittance off impedance," + where.str(),
                    percent_off(admittance[i].feed_mm_s, impedance[i].feed_mm_s), 0.0, "%",
                    agreement_goal_percent});
    rows.push_back({"validate", "thrust, admittance off impedance," + where.str(),
                    percent_off(admittance[i].thrust_n, impedance[i].thrust_n), 0.0, "%",
                    agreement_goal_percent});
    rows.push_back({"validate", "hand force ripple, peak to peak of a second," + where.str(),
                    impedance[i].ripple_percent, 0.0, "%", ripple_goal_percent});
  }
  return rows;
}

}  // namespace ream::bench
