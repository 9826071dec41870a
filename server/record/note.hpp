#pragma once
#include <variant>

#include "record/ops.hpp"

namespace ream::record {

/// What a recording may hold beside its ticks; it may also follow when nobody writes ticks any more.
using Note = std::variant<ops::Event, ops::Annotation, ops::End>;

}  // namespace ream::record
