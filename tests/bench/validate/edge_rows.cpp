#include <algorithm>
#include <array>
#include <cmath>

#include "bench/text_table.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/validate_parts.hpp"
#include "core/clock.hpp"
#include "support/bone_post.hpp"
#include "support/small_run.hpp"

namespace ream::bench {
namespace {

constexpr double edge_goal_percent = 2.0, torque_goal_percent = 3.0, threshold_goal_n = 0.03;
constexpr size_t edge_specimens = 6, last_second_ticks = 1000;
constexpr double pressing_s = 3.0;

/// What the model takes from elsewhere than the thesis, typed in: five lips (thesis, appendix A), 70.5 mm of
/// them engaged, load along the lips as large as across (MacAvelia 2012: 1.0 to 1.2 in human bone), lips that
/// rub below a newton (ours).
constexpr double lips = 5.0, engaged_edge_mm = 70.5, tangential_ratio = 1.0, rubbing_n = 1.0;
/// Ours: nobody reamed cartilage. At 52 N, mm/s.
constexpr double cartilage_mm_s = 0.40;

/// Of the last second of a reaming.
struct Reaming {
  double feed_mm_s = 0.0, torque_n_mm = 0.0;
  bool cut = false;
};

Reaming ream(voxel::BoneModel bone, const char* tool, double force_n, force::FeedKind kind,
             double rpm = published_spindle_rpm) {
  device::Script script = test::steady_push(force_n, pressing_s);
  script.spindle_rpm = rpm;
  script.stiffness_n_mm = 400.0;
  const case_::Plan plan = test::slab_plan(bone, test::post_top_mm);
  test::SmallRun run(std::move(bone), plan, tool, script, "cpu", sim::RemovalLaw::profile, kind);
  const auto reports = run.run();
  const auto &from = reports[reports.size() - 1 - last_second_ticks], &to = reports.back();
  Reaming reaming;
  reaming.feed_mm_s =
      (to.world_from_tool.translation_mm - from.world_from_tool.translation_mm).dot(plan.axis_direction) /
      (tick_s * static_cast<double>(last_second_ticks));
  for (size_t i = reports.size() - last_second_ticks; i < reports.size(); ++i) {
    reaming.torque_n_mm += reports[i].spindle_torque_n_mm / static_cast<double>(last_second_ticks);
    reaming.cut = reaming.cut || reports[i].cutting;
  }
  return reaming;
}

/// The thesis' reamer wholly in bone of its shape: what its experiments are taken for.
Reaming seated(double density_g_cc, double force_n, double rpm = published_spindle_rpm) {
  return ream(test::seated_face(density_g_cc), "thesis-appendix-a", force_n, force::FeedKind::edge, rpm);
}

/// Feed at 52 N on every density, and on two of them with half the thrust and with two thirds of the speed.
void add_specimens(const PublishedBone& bone, const Options& options, std::vector<Row>& rows) {
  constexpr double gentle_n = 26.0, slow_rpm = 104.0;
  constexpr std::array<size_t, 2> compared{0, 2};
  std::array<double, edge_specimens> feed;
  std::array<double, compared.size()> gentle, slow;
  const auto density = [&](size_t s) { return bone.specimens[s].density_g_cc; };
  in_parallel(edge_specimens + 2 * compared.size(), [&](size_t i) {
    if (i < edge_specimens) {
      feed[i] = seated(density(i), published_thrust_n).feed_mm_s;
      return;
    }
    const size_t k = (i - edge_specimens) / 2;
    if (i % 2 == 0)
      gentle[k] = seated(density(compared[k]), gentle_n).feed_mm_s;
    else
      slow[k] = seated(density(compared[k]), published_thrust_n, slow_rpm).feed_mm_s;
  });
  TextTable table;
  table.title = "Model edge, the thesis' reamer seated in " + std::string(bone.name) + " bone: feed, mm/s";
  table.corner = "specimen";
  table.columns = {"D g/cc", "law", "ours"};
  double worst = 0.0, worst_gentle = 0.0, worst_slow = 0.0;
  for (size_t s = 0; s < edge_specimens; ++s) {
    const double law = law_mm_s(bone, density(s));
    worst = std::max(worst, percent_off(feed[s], law));
    table.lines.push_back({std::to_string(s + 1), {density(s), law, feed[s]}});
  }
  for (size_t k = 0; k < compared.size(); ++k) {
    const double law = law_mm_s(bone, density(compared[k]));
    worst_gentle = std::max(worst_gentle, percent_off(gentle[k], law * gentle_n / published_thrust_n));
    worst_slow = std::max(worst_slow, percent_off(slow[k], law * slow_rpm / published_spindle_rpm));
  }
  table.print(options.tables, 4);
  const std::string name = std::string("model edge, 36.5 mm reamer seated, ") + bone.name;
  const auto row = [&](const char* what, double percent) {
    rows.push_back({"validate", name + what, percent, 0.0, "%", edge_goal_percent});
  };
  row(", worst of six at 52 N, off the law", worst);
  row(", at 26 N, off half the law (linear in thrust: 5.2)", worst_gentle);
  row(", at 104 rpm, off two thirds of it (same chip: ours)", worst_slow);
}

/// A flat punch: edge and torque have formulas.
void add_punch(std::vector<Row>& rows) {
  constexpr double area_mm2 = 300.0, density_g_cc = 1.5;
  const Reaming punch = ream(test::round_post(area_mm2, 0.0, density_g_cc), "ellipse 30,0.2",
                             published_thrust_n, force::FeedKind::edge);
  const double edge_mm = lips * std::sqrt(area_mm2 / pi);
  const double feed_mm_s = law_mm_s(published_cortical, density_g_cc) * engaged_edge_mm / edge_mm;
  const double torque_n_mm = tangential_ratio * published_thrust_n / edge_mm * lips / (2.0 * pi) * area_mm2;
  rows.push_back({"validate", "model edge, flat punch of 300 mm2, feed off the integral",
                  percent_off(punch.feed_mm_s, feed_mm_s), 0.0, "%", torque_goal_percent});
  rows.push_back({"validate", "model edge, flat punch of 300 mm2, torque off the integral",
                  percent_off(punch.torque_n_mm, torque_n_mm), 0.0, "%", torque_goal_percent});
}

void add_cartilage(std::vector<Row>& rows) {
  voxel::BoneModel bone = test::slab({96, 96, 96}, 0.15, test::post_top_mm, 0.5);
  for (uint8_t& density : bone.density.writable()) density = voxel::cartilage_code;
  const Reaming reaming = ream(std::move(bone), "sphere 8,5", published_thrust_n, force::FeedKind::empirical);
  rows.push_back({"validate", "cartilage feed at 52 N, off what is said (ours)",
                  percent_off(reaming.feed_mm_s, cartilage_mm_s), 0.0, "%", edge_goal_percent});
}

void add_threshold(std::vector<Row>& rows) {
  constexpr double step_n = 0.02;
  std::array<bool, 11> cut{};
  in_parallel(cut.size(), [&](size_t i) {
    const double force_n = rubbing_n + step_n * (static_cast<double>(i) - 5.0);
    cut[i] = ream(test::round_post(100.0, 0.0, 0.6), "ellipse 30,0.2", force_n, force::FeedKind::edge).cut;
  });
  const auto first = static_cast<double>(std::find(cut.begin(), cut.end(), true) - cut.begin());
  rows.push_back({"validate", "least thrust that cuts, off what is said (ours)",
                  std::abs(step_n * (first - 5.0)), 0.0, "N", threshold_goal_n});
}

}  // namespace

std::vector<Row> edge_rows(const Options& options) {
  std::vector<Row> rows;
  for (const PublishedBone* bone : published_bones) add_specimens(*bone, options, rows);
  add_punch(rows);
  add_cartilage(rows);
  add_threshold(rows);
  return rows;
}

}  // namespace ream::bench
