#pragma once
#include <string>
#include <vector>

#include "api/study_export.hpp"

namespace ream::api {

/// Columns of the export's tables before those of metrics and answers, in the order of their cells.
std::vector<ExportColumn> session_columns();
std::vector<ExportColumn> participant_columns();
std::vector<ExportColumn> group_columns();

/// The column of a key of metrics.json; the unit is read from the end of its name.
ExportColumn metric_column(const std::string& name);
ExportColumn answer_column(const QuestionnaireItem& item);

}  // namespace ream::api
