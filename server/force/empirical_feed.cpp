#include "force/empirical_feed.hpp"

#include "force/feed_law.hpp"
#include "force/feed_table.hpp"

namespace ream::force {
namespace {

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

}  // namespace

std::unique_ptr<FeedModel> make_empirical_feed_model(const FeedSettings& settings, const Lip& lip) {
  return std::make_unique<EmpiricalFeedModel>(settings, lip);
}

}  // namespace ream::force
