#pragma once
#include <string>
#include <vector>

#include "study/study_export.hpp"

namespace ream::study {

/// Columns of the export's tables before those of metrics and answers, in the order of their cells; with arm
/// and phase where the study is `designed`.
std::vector<session::ExportColumn> session_columns(bool designed);
std::vector<session::ExportColumn> participant_columns(bool designed);
std::vector<session::ExportColumn> rating_columns();
std::vector<session::ExportColumn> group_columns();

/// The column of a key of metrics.json; the unit is read from the end of its name.
session::ExportColumn metric_column(const std::string& name);
session::ExportColumn answer_column(const QuestionnaireItem& item);

}  // namespace ream::study
