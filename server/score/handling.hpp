#pragma once
#include <cstdint>
#include <optional>

#include "record/tick_report.hpp"
#include "score/contact_spread.hpp"
#include "score/metric_results.hpp"
#include "score/path_economy.hpp"
#include "score/spindle_use.hpp"
#include "score/thrust_rate.hpp"
#include "score/tool_path.hpp"

namespace ream::score {

/// Share of the engaged points from which on a kind of bone is reached (engineering judgement).
inline constexpr double reached_share = 0.1;
/// Apparent stiffness is measured from the thrust at which lips begin to cut to 90 % of the experiments' 52
/// N.
inline constexpr double stiffness_from_n = 1.0, stiffness_to_n = 0.9 * 52.0;
/// Thrust beyond this is excess: 1.5 times the experiments' 52 N.
inline constexpr double excess_from_n = 78.0;

/// Thrust along the tool's axis, simulated newtons: mean and deviation over pressed cutting, peak and excess
/// over the ticks in contact with the spindle on.
class Thrust {
 public:
  void add(const record::TickReport& report, double axial_mm);
  void write(MetricResults& results) const;

 private:
  void follow_rise(const record::TickReport& report, double axial_mm);

  int64_t cutting_ticks_ = 0, overload_ticks_ = 0;
  double sum_n_ = 0.0, sum_n2_ = 0.0, peak_n_ = 0.0, excess_n_s_ = 0.0;
  bool rising_ = false;  ///< thrust is over stiffness_from_n since rise_thrust_n_ at rise_mm_
  double rise_thrust_n_ = 0.0, rise_mm_ = 0.0;
  bool risen_ = false;
  /// Thrust gained a mm of advance while thrust rises for the first time from stiffness_from_n to
  /// stiffness_to_n (thesis 5.2: apparent machining stiffness); empty when it has not, or without advance.
  std::optional<double> apparent_stiffness_n_mm_;
};

/// How far and how long a tool goes on.
struct Advance {
  double mm = 0.0, s = 0.0;
};

/// How far a tool's apex advances from some moment until thrust falls below pressing_n. `axial_mm` is that of
/// the apex along the planned axis, in the bone.
class AdvanceUntilRelease {
 public:
  void begin(double axial_mm);
  void add(const record::TickReport& report, double axial_mm);
  bool begun() const { return begun_; }
  /// Empty until thrust has fallen.
  const std::optional<Advance>& advance() const { return advance_; }

 private:
  bool begun_ = false;
  int64_t ticks_ = 0;
  double from_mm_ = 0.0, deepest_mm_ = 0.0;
  std::optional<Advance> advance_;
};

/// From first pressing on cancellous bone; how experts differ from novices (Nigam 2022). A plunge in one
/// tick cannot happen: at 104 N the tool feeds at most 0.084 mm in 100 ms.
class Breakthrough {
 public:
  /// Once a tick.
  void add(const record::TickReport& report, double axial_mm);
  const AdvanceUntilRelease& inside() const { return inside_; }

 private:
  AdvanceUntilRelease inside_;
};

/// From where the reamer has gone through cartilage to the plate: whether the hand knows cartilage from bone
/// (Strelzow 2023). Only where it pressed on cartilage before.
class PlateStop {
 public:
  void add(const record::TickReport& report, double axial_mm);
  bool touched_cartilage() const { return cartilage_; }
  const AdvanceUntilRelease& beyond() const { return beyond_; }

 private:
  bool cartilage_ = false;
  AdvanceUntilRelease beyond_;
};

/// Counts episodes of contact with over 5 N; gaps of up to half a second do not part them.
class ContactPasses {
 public:
  /// Once a tick.
  void add(const record::TickReport& report);
  int count() const { return count_; }

 private:
  static constexpr int64_t gap_ticks = 500;

  int count_ = 0;
  int64_t ticks_since_ = gap_ticks + 1;  ///< with less force
};

/// How a tool is handled: what the ticks tell beside the bone that is gone.
class Handling {
 public:
  /// Once a tick, in order. `in_bone_mm`: the tool's apex in the frame of the bone at rest; `axial_mm`: the
  /// same along the planned axis.
  void add(const record::TickReport& report, const Vec3& in_bone_mm, double axial_mm);
  double duration_s() const;
  void write(MetricResults& results) const;

 private:
  void write_advances(MetricResults& results) const;

  int64_t ticks_ = 0, contact_ticks_ = 0, weakened_ticks_ = 0, extrapolated_ticks_ = 0;
  int stalls_ = 0;
  bool stalled_ = false;
  Thrust thrust_;
  Breakthrough breakthrough_;
  PlateStop plate_stop_;
  ContactPasses passes_;
  SpindleUse spindle_use_;
  ToolPath path_;
  PathEconomy economy_;
  ContactSpread contact_spread_;
  ThrustRate thrust_rate_;
};

}  // namespace ream::score
