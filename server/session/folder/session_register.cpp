#include "session/folder/session_register.hpp"

#include <algorithm>
#include <set>

#include "store/session_index.hpp"

namespace ream::session {

SessionRegister::SessionRegister(const SessionArchive& archive, store::Database& database)
    : archive_(archive), database_(database), upkeep_(archive, database) {}

/// None for a damaged folder, too.
std::optional<SessionRecord> SessionRegister::found(const std::string& id) const {
  try {
    return archive_.find(id);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Adds what the index does not tell; returns what is not to be taken from it.
std::vector<std::string> SessionRegister::add_from_folders(std::vector<SessionRecord>& here) {
  std::set<std::string> ids;
  for (const SessionRecord& record : here) ids.insert(record.request.id);
  for (const std::string& id : upkeep_.behind()) {
    if (!ids.insert(id).second) continue;
    if (auto record = found(id)) here.push_back(std::move(*record));
  }
  return {ids.begin(), ids.end()};
}

/// Returns how many there are in all.
size_t SessionRegister::add_from_index(const store::SessionQuery& query,
                                       const std::vector<std::string>& except,
                                       std::vector<RowAndRecord>& listed) {
  auto [rows, total] = store::SessionIndex(database_).find(query, except);
  for (store::SessionRow& row : rows) {
    std::optional<SessionRecord> record;
    try {
      record = record_of(row, archive_.folder_of(row.id));
    } catch (const Error&) {  // the folder knows better
      upkeep_.changed(row.id);
      record = found(row.id);
    }
    if (record) listed.emplace_back(std::move(row), std::move(*record));
  }
  return total;
}

SessionPage SessionRegister::list(const store::SessionQuery& query, std::vector<SessionRecord> held) {
  const auto place = store::place_of_cursor(query);
  const std::vector<std::string> except = add_from_folders(held);
  SessionPage page;
  std::vector<RowAndRecord> listed;
  for (SessionRecord& record : held) {
    store::SessionRow row = row_of(record);
    if (!store::matches(query, row)) continue;
    ++page.total;
    if (!place || store::behind(query, *place, row)) listed.emplace_back(std::move(row), std::move(record));
  }
  page.total += add_from_index(query, except, listed);
  std::sort(listed.begin(), listed.end(),
            [&](const auto& a, const auto& b) { return store::precedes(query, a.first, b.first); });
  if (listed.size() > query.limit) {
    listed.resize(query.limit);
    if (!listed.empty()) page.next = store::cursor_behind(query, listed.back().first);
  }
  for (auto& [row, record] : listed) page.sessions.push_back(std::move(record));
  return page;
}

}  // namespace ream::session
