#include "study/validity_tables.hpp"

#include "core/json.hpp"
#include "study/validity_data.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

session::ExportTable empty_table(const char* name,
                                 const std::vector<std::pair<const char*, const char*>>& columns) {
  session::ExportTable table{name, {}, {}};
  for (const auto& [column, words] : columns) table.columns.push_back({column, "", words});
  return table;
}

}  // namespace

session::ExportTable validity_sessions_table(const ValidityInput& input) {
  session::ExportTable table =
      empty_table("sessions", {{"session", "a code of the session"},
                               {"participant", "a code of the person"},
                               {"experience", "novice, intermediate or expert"},
                               {"arm", "of a trial"},
                               {"phase", "pre, training, post or retention"},
                               {"attempt", "the participant's first is 1; 0: not known"}});
  const std::vector<std::string> measures = measures_of(input.sessions);
  for (const std::string& measure : measures) table.columns.push_back({measure, "", "a measure"});
  for (const RatedSession& session : input.sessions) {
    std::vector<json> cells = {session.session, session.participant, session.experience,
                               session.arm,     session.phase,       session.attempt};
    for (const std::string& measure : measures) cells.push_back(or_null(measure_in(session, measure)));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

session::ExportTable validity_ratings_table(const ValidityInput& input) {
  session::ExportTable table = empty_table("ratings", {{"rater", "a code of the rater"},
                                                       {"session", "a code of the session"},
                                                       {"item", "what is rated"},
                                                       {"kind", "scale (1 to 5) or check (0 or 1)"},
                                                       {"value", "the rating"}});
  std::map<std::string, ItemKind> kinds;
  for (const RatedItem& item : input.items) kinds[item.id] = item.kind;
  for (const Rating& rating : input.ratings)
    table.rows.push_back({rating.rater, rating.session, rating.item,
                          kinds[rating.item] == ItemKind::scale ? "scale" : "check", rating.value});
  return table;
}

session::ExportTable validity_numbers_table(const ValidityReport& report) {
  session::ExportTable table = empty_table("numbers", {{"result", "part of the report, and whom it is about"},
                                                       {"measure", "measure or item"},
                                                       {"statistic", "name of the number"},
                                                       {"value", "the number"}});
  for (const auto& [name, lines] : parts_of(report))
    for (const ValidityLine& line : *lines) {
      const std::string result = line.subject.empty() ? name : name + (":" + line.subject);
      for (const auto& [statistic, value] : line.values)
        table.rows.push_back({result, line.measure, statistic, value});
    }
  return table;
}

}  // namespace ream::study
