#pragma once
#include <filesystem>
#include <string>

#include "case/case.hpp"
#include "case/landmarks.hpp"

namespace ream::session {

/// The case that a name means: `demo`, which is made on first use, an id in the data folder, or the path of a
/// case folder. Errors: those of load_case.
case_::Case find_case(const std::string& name, const std::filesystem::path& data);

/// Its side, landmarks and glenoid frame as they are now. Error invalid_input for its landmarks.
case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const std::filesystem::path& data);

}  // namespace ream::session
