#pragma once
#include "store/study_table.hpp"
#include "study/study.hpp"

namespace ream::study {

/// Between studies and what the database keeps of them.
store::StudyRow row_of(const Study& study);
Study study_of(const store::StudyRow& row);
store::ParticipantRow row_of(const std::string& study_id, const Participant& participant);
Participant participant_of(const store::ParticipantRow& row);

}  // namespace ream::study
