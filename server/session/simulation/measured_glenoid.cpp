#include "session/simulation/measured_glenoid.hpp"

namespace ream::session {

std::shared_ptr<const score::NativeGlenoid> measured_glenoid(const case_::Case& native,
                                                             const case_::Anatomy& anatomy,
                                                             const shell::Tool& reamer) {
  return std::make_shared<const score::NativeGlenoid>(score::Task{anatomy, native.plan, reamer.profile},
                                                      native.bone);
}

}  // namespace ream::session
