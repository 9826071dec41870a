#pragma once
#include "geometry/vec.hpp"
#include "score/strokes.hpp"

namespace ream::score {

/// The way of the tool's apex in the bone's frame: its length in contact and in the air, and its strokes.
/// While a session is paused nothing is added; a step of more than 1 mm in one tick is no movement but a
/// session that goes on elsewhere.
class ToolPath {
 public:
  static constexpr double longest_step_mm = 1.0;

  /// Once a tick.
  void add(const Vec3& apex_mm, bool engaged, bool paused);
  double in_contact_mm() const { return in_contact_mm_; }
  double in_the_air_mm() const { return in_the_air_mm_; }
  const Strokes& strokes() const { return strokes_; }

 private:
  void forget();

  bool has_before_ = false;
  Vec3 before_mm_ = Vec3::Zero();
  double in_contact_mm_ = 0.0, in_the_air_mm_ = 0.0;
  Strokes strokes_;
};

}  // namespace ream::score
