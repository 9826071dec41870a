#pragma once
#include "core/progress.hpp"
#include "report/report.hpp"
#include "session/export/export_formats.hpp"

namespace ream::session {

/// The session.json beside a recording; without one, what the recording's header says for people.
nlohmann::json description_of(const record::Recording& recording);

/// Reads a session once more and says all that it says. What cannot be had (the case, its bone) is said in
/// the report instead. Errors: those of the recording and the rubric; io; cancelled.
report::Report session_report(const ExportRequest& request, const Progress& progress);

}  // namespace ream::session
