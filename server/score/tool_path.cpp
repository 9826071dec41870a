#include "score/tool_path.hpp"

namespace ream::score {

void ToolPath::forget() {
  has_before_ = false;
  strokes_.interrupt();
}

void ToolPath::add(const Vec3& apex_mm, bool engaged, bool paused) {
  if (paused) return forget();
  if (has_before_) {
    const double step_mm = (apex_mm - before_mm_).norm();
    if (step_mm > longest_step_mm)
      forget();
    else
      (engaged ? in_contact_mm_ : in_the_air_mm_) += step_mm;
  }
  before_mm_ = apex_mm;
  has_before_ = true;
  strokes_.add(apex_mm);
}

}  // namespace ream::score
