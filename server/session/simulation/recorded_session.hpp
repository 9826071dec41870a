#pragma once
#include <filesystem>
#include <string>

#include "case/case.hpp"
#include "core/progress.hpp"
#include "record/recording.hpp"
#include "score/metrics.hpp"
#include "score/native_glenoid.hpp"

namespace ream::session {

/// The recording that a name means: an id of the data folder's sessions, a folder that holds recording.ream,
/// or such a file. Error not_found says where was looked.
std::filesystem::path recording_path(const std::string& name, const std::filesystem::path& data);

/// All ticks of a recording, added up as a live session does: by this build's definitions the same to the
/// bit. Error invalid_input at damage that opening did not show.
score::MetricsAccumulator accumulated(const record::Recording& recording,
                                      const Progress& progress = no_progress);

/// The case of a recording as it was before tick 0: loaded from the data folder, compared with the
/// recording's hash, its pilot hole cut as the recording's plan has it. `case_name`: where the case is, as
/// for find_case(); empty: under the name that the recording gives. Errors: not_found; conflict when the case
/// has changed since.
case_::Case case_of(const record::Recording& recording, const std::string& case_name,
                    const std::filesystem::path& data);

/// The recorded_case() as it was before tick 0: its pilot hole cut. Error conflict as above.
case_::Case as_before_tick_0(const record::Recording& recording, case_::Case native);

/// What a recording's session is measured against, with the last reamer that it used. `native`: the
/// recorded_case(); `case_name` as above. Errors: invalid_input.
std::shared_ptr<const score::NativeGlenoid> recorded_glenoid(const record::Recording& recording,
                                                             const case_::Case& native,
                                                             const std::string& case_name,
                                                             const std::filesystem::path& data);
/// The same, or null and a warning in the log where an old recording does not tell enough.
std::shared_ptr<const score::NativeGlenoid> glenoid_if_known(const record::Recording& recording,
                                                             const case_::Case& native,
                                                             const std::string& case_name,
                                                             const std::filesystem::path& data);

}  // namespace ream::session
