#include "session/folder/session_row.hpp"

#include <algorithm>

namespace ream::session {
namespace {

/// JSON may hold a NUL, a database's text may not.
std::string without_nul(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '\0'), text.end());
  return text;
}

}  // namespace

store::SessionRow row_of(const SessionRecord& record) {
  store::SessionRow row;
  row.id = record.request.id;
  row.case_id = record.request.case_id;
  row.script = record.request.script;
  row.state = to_text(record.status.state);
  row.created_utc = without_nul(record.request.created_utc);
  row.duration_s = record.status.duration_s;
  row.trainee_id = without_nul(record.request.trainee_id);
  // Lists are sorted and searched by it, also by those for whom the person is hidden.
  row.trainee =
      without_nul(record.request.study.empty() ? record.request.trainee : record.request.participant);
  row.study = without_nul(record.request.study);
  row.participant = without_nul(record.request.participant);
  row.title = without_nul(record.request.title);
  if (record.mark) {
    row.points = record.mark->points;
    row.outcome = without_nul(record.mark->outcome);
  }
  return row;
}

store::SessionRow row_of(const FolderRecord& found, int64_t stamp) {
  store::SessionRow row = row_of(found.record);
  row.record = found.text;
  row.stamp = stamp;
  row.lasting = found.lasting;
  return row;
}

}  // namespace ream::session
