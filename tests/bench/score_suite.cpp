#include <algorithm>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/pecking.hpp"
#include "bench/scored_reaming.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "session/scoring/rescoring.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

constexpr double long_s = 600.0, short_s = 10.0;
constexpr int many = 100;
constexpr double live_goal_percent = 2.0, final_goal_ms = 5000.0, cancel_goal_ms = 1000.0;

/// Times between calls of a progress, any of which may end the work.
class Calls {
 public:
  Progress progress() {
    last_ = SteadyClock::now();
    return [this](double, std::string_view) {
      const auto now = SteadyClock::now();
      longest_ms_ = std::max(longest_ms_, elapsed_us(last_) * 1e-3);
      last_ = now;
      ++count_;
    };
  }
  double longest_ms() const { return longest_ms_; }
  int count() const { return count_; }

 private:
  SteadyClock::time_point last_;
  double longest_ms_ = 0.0;
  int count_ = 0;
};

void add_rescoring(const std::string& what, const std::vector<std::string>& names,
                   const std::filesystem::path& data, double goal_ms, std::vector<Row>& rows) {
  Calls calls;
  const auto begun = SteadyClock::now();
  const std::vector<session::Rescored> all = session::rescore(names, {}, data, calls.progress());
  const double ms = elapsed_us(begun) * 1e-3;
  const auto unscored =
      std::count_if(all.begin(), all.end(), [](const auto& one) { return !one.error.empty(); });
  rows.push_back({"score", what, ms, 0.0, "ms", goal_ms});
  rows.push_back({"score", what + ", longest wait until it could be cancelled", calls.longest_ms(), 0.0, "ms",
                  cancel_goal_ms});
  rows.push_back({"score", what + ", reports of progress", static_cast<double>(calls.count()), 0.0, "reports",
                  static_cast<double>(names.size()), Goal::at_least});
  if (unscored > 0)
    rows.push_back({"score", what + ", sessions that could not be scored", static_cast<double>(unscored), 0.0,
                    "sessions", 0.5});
}

}  // namespace

std::vector<Row> score_suite(const Options&) {
  const test::TemporaryFolder folder;
  const std::filesystem::path& data = folder.path();
  keep_thesis_case(data);
  std::vector<Row> rows;
  const ScoredReaming one = ream_and_score(data, "long", long_s);
  const std::string name = "thesis-5-4-2, ten minutes of pecking, ";
  rows.push_back({"score", name + "removed", one.removed_mm3, 0.0, "mm3", 0.0});
  rows.push_back({"score", name + "depth", one.depth_mm, 0.0, "mm", 0.0});
  rows.push_back({"score", name + "live score, share of a core", 100.0 * one.live_cpu_s / one.duration_s, 0.0,
                  "%", live_goal_percent});
  rows.push_back(
      {"score", name + "live score, one measurement of the bone", one.measurement_ms, 0.0, "ms", 0.0});
  rows.push_back({"score", name + "live score, measurements of the bone a second",
                  one.measurements / one.duration_s, 0.0, "1/s", 1.0, Goal::at_least});
  rows.push_back({"score", name + "untouched bone, before the first tick", one.native_ms, 0.0, "ms", 0.0});
  rows.push_back({"score", name + "final score", one.final_ms, 0.0, "ms", final_goal_ms});
  add_rescoring(name + "scored anew from its recording", {"long"}, data, final_goal_ms, rows);

  ream_and_score(data, "short", short_s);
  std::vector<std::string> names;
  for (int i = 0; i < many; ++i) {
    names.push_back("short-" + std::to_string(i));
    std::filesystem::copy(sessions_folder(data) / "short", sessions_folder(data) / names.back());
  }
  add_rescoring("thesis-5-4-2, 100 sessions of ten seconds scored anew", names, data, 0.0, rows);
  return rows;
}

}  // namespace ream::bench
