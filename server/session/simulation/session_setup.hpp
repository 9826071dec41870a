#pragma once
#include <filesystem>

#include "session/simulation/simulation.hpp"

namespace ream::session {

/// The parts of a new session. Errors: not_found and invalid_input of case, script and reamer; conflict when
/// the case has no plan. `data` is where cases are looked up; the demo case is made there on first use.
SimulationSetup build_setup(const RunRequest& request, const std::filesystem::path& data);

/// The script that a request means, its force scale the request's. Errors: those of load_script.
device::Script find_script(const RunRequest& request);

/// What sessions on a case are measured against. `native`: the case, its pilot hole not cut, with the plan of
/// the session. Takes a few tenths of a second.
std::shared_ptr<const score::NativeGlenoid> measured_glenoid(const case_::Case& native,
                                                             const case_::Anatomy& anatomy,
                                                             const shell::Tool& reamer);

}  // namespace ream::session
