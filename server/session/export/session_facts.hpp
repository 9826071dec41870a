#pragma once
#include <nlohmann/json_fwd.hpp>

#include "case/case.hpp"
#include "record/recording.hpp"
#include "report/material.hpp"

namespace ream::session {

/// The session.json beside a recording; without one, what the recording's header says for people.
nlohmann::json description_of(const record::Recording& recording);

/// `session`: of description_of(). A session of a study goes by its code, not by a name.
report::SessionFacts session_facts(const record::Recording& recording, const nlohmann::json& session,
                                   const nlohmann::json& metrics);

/// "2 mm deep with ellipse 18.25,9; pilot hole 6.2 mm wide, 12 mm deep; implant radius 24 mm".
std::string plan_in_words(const case_::Plan& plan);

std::vector<report::Remark> remarks_of(const record::Recording& recording);

}  // namespace ream::session
