#pragma once
#include <memory>

#include "case/landmarks.hpp"
#include "score/native_glenoid.hpp"
#include "shell/tool.hpp"

namespace ream::session {

/// What sessions on a case are measured against. `native`: the case, its pilot hole not cut, with the plan of
/// the session. Takes a few tenths of a second.
std::shared_ptr<const score::NativeGlenoid> measured_glenoid(const case_::Case& native,
                                                             const case_::Anatomy& anatomy,
                                                             const shell::Tool& reamer);

}  // namespace ream::session
