#pragma once
#include <optional>
#include <string>

#include "geometry/vec.hpp"
#include "record/ops.hpp"

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

/// A remark as it is recorded, made now. It is about tick `ticks` (that many have passed) when it names no
/// time. Error invalid_input when it is about a time after that.
record::ops::Annotation annotation_op(const NewAnnotation& note, uint32_t ticks);
Annotation annotation_of(const record::ops::Annotation& op);

}  // namespace ream::session
