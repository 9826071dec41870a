#include "core/json.hpp"
#include "study/study_export.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

json codebook_of(const session::ExportTable& table) {
  json columns = json::array();
  for (const session::ExportColumn& column : table.columns)
    columns.push_back({{"name", column.name}, {"unit", or_null(column.unit)}, {"words", column.words}});
  return columns;
}

}  // namespace

json codebook_of(const Study& study, const StudyExport& all) {
  return {
      {"study", study.id},
      {"name", study.name},
      {"questionnaire", study.questionnaire ? json(study.questionnaire->id) : json(nullptr)},
      {"about",
       "No names, no ids of persons or sessions, no dates. Texts are UTF-8; 1 and 0 in CSV are yes and no; "
       "an empty cell is a value that is not known, or an answer that was not given."},
      {"sessions", codebook_of(all.sessions)},
      {"answers", codebook_of(all.answers)},
      {"groups", codebook_of(all.groups)},
      {"ratings", codebook_of(all.ratings)}};
}

}  // namespace ream::study
