#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::session {

/// A remark as somebody sends it.
struct NewAnnotation {
  std::string words, author;
  std::optional<double> at_s;    ///< simulated time it is about; none: now, or the end
  std::optional<Vec3> place_mm;  ///< world frame
};

/// A remark as it is kept in the recording.
struct Annotation {
  std::string utc, words, author;
  double at_s = 0.0;
  std::optional<Vec3> place_mm;
};

}  // namespace ream::session
