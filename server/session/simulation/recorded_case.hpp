#pragma once
#include <filesystem>
#include <string>

#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "record/recording.hpp"

namespace ream::session {

/// The case_as_recorded() that a recording began with. `case_name` as for find_case(), or empty for the case
/// that the header names. Errors: not_found; invalid_input for a recording of a revision that says too little
/// to be computed again; those of case_as_recorded().
case_::Case recorded_case(const record::Recording& recording, const std::string& case_name,
                          const std::filesystem::path& data);

/// What a recording's session is measured against; recordings of older revisions do not say it, so that it is
/// what `native`, their case, says now. `case_name` as above. Error invalid_input.
case_::Anatomy recorded_anatomy(const record::Recording& recording, const case_::Case& native,
                                const std::string& case_name, const std::filesystem::path& data);

}  // namespace ream::session
