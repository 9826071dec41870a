#pragma once
#include "record/ops.hpp"
#include "session/annotation.hpp"

namespace ream::session {

/// A remark as it is recorded, made now. It is about tick `ticks` (that many have passed) when it names no
/// time. Error invalid_input when it is about a time after that.
record::ops::Annotation annotation_op(const NewAnnotation& note, uint32_t ticks);
Annotation annotation_of(const record::ops::Annotation& op);

}  // namespace ream::session
