#pragma once
#include <cstdint>
#include <optional>

#include "record/tick_report.hpp"

namespace ream::score {

/// Under this thrust a hand no longer presses (science 2.2).
inline constexpr double pressing_n = 5.0;
/// Share of the engaged points from which on a kind of bone is reached (engineering judgement).
inline constexpr double reached_share = 0.1;

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

}  // namespace ream::score
